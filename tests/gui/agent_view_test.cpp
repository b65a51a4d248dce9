// SPDX-License-Identifier: Apache-2.0
// The page of agents, by agents made by hand.
#include "views/agent_view.hpp"

#include "cortex/explorer/small_plot.hpp"

#include "core/model_folder.hpp"
#include "gui/measured_agent.hpp"
#include "gui/waiting.hpp"
#include "style/look.hpp"
#include "views/agent_table.hpp"
#include "views/agreement_table.hpp"
#include "views/counter_table.hpp"
#include "views/loop_table.hpp"
#include "widgets/rows.hpp"
#include "widgets/text_label.hpp"

#include <QApplication>
#include <QFontMetrics>
#include <QPushButton>
#include <QTabBar>
#include <algorithm>
#include <memory>

#include <QtTest/QTest>
#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

class Agents : public testing::Test {
protected:
    Agents() {
        view.resize(900, 600);
        view.show();
    }
    bool says(const QString& text) {
        const auto labels = view.findChildren<TextLabel*>();
        return std::ranges::any_of(labels, [&](const auto* each) {
            return each->isVisible() && each->text().contains(text);
        });
    }
    // One row of a table as its cells.
    template <class Table>
    QStringList row(int index) {
        QStringList cells;
        const QTreeWidget& table = *view.findChild<Table*>();
        for (int column = 0; column < table.columnCount(); ++column)
            cells << table.topLevelItem(index)->text(column);
        return cells;
    }
    QString tab(int index) { return view.findChild<QTabBar*>()->tabText(index); }

    AgentView view;
};

TEST_F(Agents, ARowIsOpenedByKeyAndBelowItStandsItsLoop) {
    MadeAgent operatorAgent = clusterNamed("operator"), robot = clusterNamed("robot");
    measure(robot, "/robot");
    const auto frame = frameOf({operatorAgent.now(), robot.now()});
    view.refresh(*frame);
    EXPECT_EQ(row<LoopTable>(0)[5], QString::fromUtf8("—"));
    auto* table = view.findChild<AgentTable*>();
    table->setFocus();
    QTest::keyClick(table, Qt::Key_Down);
    view.refresh(*frame);
    EXPECT_EQ(row<LoopTable>(0).mid(0, 7),
              (QStringList{"Duty cycle", "12.00", "10.00", "20.00", "40.00", "90.00", "%"}));
    EXPECT_TRUE(says("robot"));
    EXPECT_EQ(view.saved()["agent"], "robot");
}

TEST_F(Agents, NumbersOfTheLoopAreWholeHoweverGreat) {
    MadeAgent robot = clusterNamed("robot");
    measure(robot, "/robot");
    robot.put("/robot", "latenessMax", 123'456'789.0);
    view.refresh(*frameOf({robot.now()}));
    auto& table = *view.findChild<LoopTable*>();
    for (int row = 0; row < table.topLevelItemCount(); ++row) {
        for (int column = 1; column < 7; ++column) {
            const QString text = table.topLevelItem(row)->text(column);
            EXPECT_LE(textWidth(text) + Look::units(4), table.columnWidth(column))
                << text.toStdString();
        }
    }
}

TEST_F(Agents, TheRowThatWasChosenStaysChosenWhenOthersCome) {
    MadeAgent robot = clusterNamed("robot"), arm = clusterNamed("arm");
    view.refresh(*frameOf({robot.now()}));
    view.refresh(*frameOf({arm.now(), robot.now()}));
    const auto* row = view.findChild<AgentTable*>()->currentItem();
    ASSERT_NE(row, nullptr);
    EXPECT_EQ(row->text(0), "robot");
    EXPECT_EQ(view.saved()["agent"], "robot");
    view.refresh(*frameOf({arm.now()}));
    EXPECT_EQ(view.saved()["agent"], "robot") << "nothing else is shown in its place";
    EXPECT_TRUE(says("It is not heard."));
}

TEST_F(Agents, HaveTheirStartStateAndRateInSightInASmallWindowWithLargeText) {
    Look::apply(Theme::Light, 1.5, QStringLiteral("Open Sans"));
    view.resize(800, 460);
    MadeAgent robot = clusterNamed("ds402_dual_axis"), arm = clusterNamed("arm");
    AgentFrame today = robot.now("running"), later = arm.now("running");
    today.status.rate = 50;
    today.status.epoch = 5'000'000;
    later.status.epoch = 90'000'000'000;
    view.refresh(*frameOf({today, later}));
    QApplication::processEvents();
    EXPECT_EQ(row<AgentTable>(0)[4], "00:00:05");
    EXPECT_EQ(row<AgentTable>(1)[4], "1970-01-02 01:00:00") << "another day is said";
    AgentView other;
    other.resize(800, 460);
    other.show();
    other.refresh(*frameOf({today}));
    QApplication::processEvents();
    const auto& table = *other.findChild<AgentTable*>();
    EXPECT_LE(table.columnViewportPosition(4) + table.columnWidth(4), table.viewport()->width());
    int known = 0;
    for (const auto* each : other.findChildren<TextLabel*>()) {
        if (!each->isVisible() || !each->text().startsWith(QString::fromUtf8("running · ")))
            continue;
        ++known;
        EXPECT_GE(each->width(), QFontMetrics{each->font()}.horizontalAdvance(each->text()));
    }
    EXPECT_EQ(known, 1);
    Look::apply(Theme::Light, 1, QStringLiteral("Open Sans"));
}

TEST_F(Agents, WhatIsMissingOfAnIncompleteAgentIsSaid) {
    MadeAgent robot = clusterNamed("robot");
    AgentFrame part = robot.now("incomplete");
    part.structure = nullptr;
    part.image = nullptr;
    part.status.types = 40;
    part.status.simplexes = 4;
    part.status.missing = 6;
    part.status.missingTypes = 3;
    part.status.missingNames = {"Axis", "Drive"};
    view.refresh(*frameOf({part}));
    EXPECT_TRUE(says("37 of 40 types and 1 of 4 simplexes have come; lacking: Axis, Drive, " +
                     QString::fromUtf8("…")));
    view.findChild<QTabBar*>()->setCurrentIndex(2);
    EXPECT_TRUE(says("Not known who holds a part of it."));
    EXPECT_EQ(row<LoopTable>(0).back(), "not known: its types have not all come");
    EXPECT_FALSE(view.findChild<QPushButton*>()->isEnabled()) << "there is nothing to plot";
}

// Two agents that mean different things by one type.
MadeAgent withThing(const std::string& name, const std::string& items) {
    const ModelFolder folder;
    const auto file =
        folder.write("things.xml",
                     "<ontology name='things' version='1.0'><include file='base.xml'/>"
                     "<type name='Thing' extends='Concept'>" +
                         items + "</type></ontology>");
    return {name, [&](SimplexTree& tree) { tree.add("/" + name, "Cluster"); },
            TypeModel::load(file)};
}

TEST_F(Agents, AnItemThatContradictsOrDiffersHasARow) {
    MadeAgent robot = withThing("robot", "<data name='at' kind='float' unit='rad' max='3'/>");
    MadeAgent other = withThing("other", "<data name='at' kind='float' unit='deg' max='4'/>");
    view.choose("robot");
    const auto frame = frameOf({other.now(), robot.now()});
    auto* table = view.findChild<AgreementTable*>();
    ASSERT_TRUE(comes([&] {
        view.refresh(*frame);
        return table->count().has_value();
    }));
    ASSERT_EQ(table->count(), 2);
    EXPECT_EQ(row<AgreementTable>(0),
              (QStringList{"contradiction", "other", "Thing", "at", "unit=rad", "unit=deg"}));
    EXPECT_EQ(row<AgreementTable>(1),
              (QStringList{"difference", "other", "Thing", "at", "max=3", "max=4"}));
}

TEST_F(Agents, TypesThatAgreeAreSaidToAgree) {
    MadeAgent robot = clusterNamed("robot"), other = clusterNamed("other");
    const auto frame = frameOf({other.now(), robot.now()});
    view.findChild<QTabBar*>()->setCurrentIndex(3);
    EXPECT_TRUE(comes([&] {
        view.refresh(*frame);
        return says("Compared with 1 other agent: all types that both have agree.");
    }));
    EXPECT_EQ(tab(3), "Agreement with others  0");
}

TEST_F(Agents, TheTrendHasWhatWasSeenAlsoOfAnAgentThatIsChosenLater) {
    MadeAgent operatorAgent = clusterNamed("operator"), robot = clusterNamed("robot");
    measure(robot, "/robot");
    std::shared_ptr<Frame> frame;
    for (int i = 0; i < 400; ++i) {
        robot.put("/robot", "dutyCycleLast", 20.0 + i % 40);
        frame = frameOf({operatorAgent.now(), robot.now()});
        frame->seconds = i * 0.25;
        view.refresh(*frame);
    }
    const auto trend = [&](const char* name) {
        for (const auto* each : view.findChildren<explorer::SmallPlot*>()) {
            if (each->accessibleName() == name) return each->accessibleDescription();
        }
        return QString{};
    };
    view.choose("operator");
    view.refresh(*frame);
    EXPECT_EQ(trend("Plot of Duty cycle"), "last cycle no data");
    view.choose("robot");
    view.refresh(*frame);
    EXPECT_EQ(trend("Plot of Duty cycle"), "last cycle 59 %");
    EXPECT_EQ(trend("Plot of Jitter"), QString::fromUtf8("p99 2 µs"));
}

TEST_F(Agents, ACounterSaysHowMuchItGrewAndSinceWhen) {
    MadeAgent robot = clusterNamed("robot");
    robot.put("/robot", "overflowCount", std::int64_t{1'204});
    auto frame = frameOf({robot.now()});
    view.refresh(*frame);
    EXPECT_EQ(row<CounterTable>(0).mid(0, 3),
              (QStringList{"Missed ticks", "1,204", QString::fromUtf8("—")}));
    robot.put("/robot", "overflowCount", std::int64_t{1'207});
    frame = frameOf({robot.now()});
    frame->seconds = 12;
    EXPECT_TRUE(comes([&] {
        view.refresh(*frame);
        return row<CounterTable>(0)[2] == "+3 in 12 s";
    })) << row<CounterTable>(0)[2].toStdString();
    EXPECT_EQ(row<CounterTable>(1)[2], "0 in 12 s") << "what stands still says so";
}

}  // namespace
}  // namespace cortex::test
