// SPDX-License-Identifier: Apache-2.0
// The page of agents with a real agent over DDS.
#include "gui/audit.hpp"
#include "gui/controlling.hpp"
#include "plots/plot_view.hpp"
#include "views/agent_view.hpp"
#include "views/counter_table.hpp"
#include "views/lease_table.hpp"
#include "views/loop_table.hpp"
#include "widgets/link.hpp"
#include "window/workspace.hpp"

#include <QAccessible>
#include <QTabBar>
#include <csignal>

#include <QtTest/QTest>

namespace cortex::test {
namespace {

class LiveAgents : public Window {
protected:
    AgentView& page() {
        window.openKind("agents");
        return *qobject_cast<AgentView*>(window.current());
    }
    template <class Table>
    QString cell(int row, int column) {
        const auto* table = window.findChild<Table*>();
        return row < table->topLevelItemCount() ? table->topLevelItem(row)->text(column)
                                                : QString{};
    }
};

TEST_F(LiveAgents, TheLoopOfARealAgentIsMeasured) {
    ASSERT_TRUE(everythingComes());
    page();
    for (const int figure : {0, 2, 3, 4}) {  // duty, cycle, jitter, lateness
        for (int column = 1; column <= 5; ++column) {
            EXPECT_TRUE(comes([&] { return cell<LoopTable>(figure, column).toDouble() > 0; }))
                << cell<LoopTable>(figure, 0).toStdString() << ' ' << column;
        }
    }
    ASSERT_TRUE(comes([&] { return cell<CounterTable>(1, 2).startsWith("0 in"); }));
    ASSERT_EQ(live({"call", "/mixer", "startup"}).exit, 0);
    EXPECT_TRUE(comes([&] { return cell<CounterTable>(1, 1).toInt() > 0; })) << "commands";
    EXPECT_TRUE(comes([&] { return cell<CounterTable>(1, 2).startsWith('+'); }))
        << cell<CounterTable>(1, 2).toStdString();
}

TEST_F(LiveAgents, WhoHoldsControlStandsAmongTheLeases) {
    ASSERT_TRUE(everythingComes());
    auto* tabs = page().findChild<QTabBar*>();
    tabs->setCurrentIndex(2);
    EXPECT_TRUE(comes([&] { return tabs->tabText(2) == "Leases  0"; }));
    Colleague colleague;
    ASSERT_TRUE(comes([&] { return colleague.sees("/drive"); }));
    ASSERT_TRUE(comes([&] {
        if (colleague.control().prefix.empty()) colleague.session.takeControl("/drive");
        return colleague.control().prefix == "/drive";
    }));
    const QString holder = QString::fromStdString(colleague.control().self);
    EXPECT_TRUE(comes([&] { return cell<LeaseTable>(0, 1).contains(holder); }))
        << cell<LeaseTable>(0, 1).toStdString();
    EXPECT_EQ(cell<LeaseTable>(0, 0), "/drive");
    EXPECT_EQ(tabs->tabText(2), "Leases  1");
    const auto refresh = [&] { colleague.control(), window.refresh(); };
    EXPECT_EQ(unreadableInEverySize(window, refresh), "") << "who holds it is never cut";
}

TEST_F(LiveAgents, DutyAndJitterGoToAPlotByKey) {
    ASSERT_TRUE(everythingComes());
    auto* plot = page().findChild<QPushButton*>();
    ASSERT_TRUE(plot->isEnabled());
    plot->setFocus();
    QTest::keyClick(plot, Qt::Key_Space);
    const auto* view = qobject_cast<PlotView*>(window.current());
    ASSERT_NE(view, nullptr);
    EXPECT_TRUE(comes([&] { return view->drawn().size() == 2; }));
}

TEST_F(LiveAgents, ItsSimplexIsOpenedFromItsName) {
    ASSERT_TRUE(everythingComes());
    auto* open = page().findChild<Link*>();
    open->setFocus();
    QTest::keyClick(open, Qt::Key_Return);
    const auto frame = session.frame();
    EXPECT_EQ(window.workspace().path(), '/' + frame->agents.front().status.name);
}

TEST_F(LiveAgents, WhatALostAgentMeasuredIsInBrackets) {
    ASSERT_TRUE(everythingComes());
    page();
    ASSERT_TRUE(comes([&] { return cell<LoopTable>(2, 1).toDouble() > 0; }));
    agent->end(SIGKILL);
    EXPECT_TRUE(comes([&] { return cell<LoopTable>(2, 1).startsWith('['); }))
        << cell<LoopTable>(2, 1).toStdString();
}

// Every cell of a chart says in words what its marks show.
TEST_F(LiveAgents, MarksHaveAccessibleNames) {
    ASSERT_TRUE(everythingComes());
    page();
    ASSERT_TRUE(comes([&] { return cell<LoopTable>(2, 5).toDouble() > 0; }));
    QApplication::processEvents();  // rows are laid out
    auto* table = window.findChild<LoopTable*>();
    QAccessibleInterface* all = QAccessible::queryAccessibleInterface(table);
    ASSERT_NE(all, nullptr);
    EXPECT_EQ(all->text(QAccessible::Name), "What the loop measures of itself");
    ASSERT_NE(all->tableInterface(), nullptr);
    QAccessibleInterface* cellOfCycle = all->tableInterface()->cellAt(2, 7);
    ASSERT_NE(cellOfCycle, nullptr);
    const QString words = cellOfCycle->text(QAccessible::Name);
    EXPECT_TRUE(words.contains("p50 ") && words.contains("max ")) << words.toStdString();
}

}  // namespace
}  // namespace cortex::test
