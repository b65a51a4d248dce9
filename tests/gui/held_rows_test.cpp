// SPDX-License-Identifier: Apache-2.0
// Rows of tables keep their places while somebody uses them.
#include "gui/measured_agent.hpp"
#include "model/held_order.hpp"
#include "views/agent_details.hpp"
#include "views/agent_table.hpp"
#include "views/agent_view.hpp"
#include "views/relation_table.hpp"
#include "widgets/tab_row.hpp"
#include "window/pane.hpp"

#include <QApplication>
#include <QScrollBar>

#include <QtTest/QTest>
#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

using Rows = std::vector<int>;

TEST(HeldOrder, WhatComesStandsAtTheEndAndWhatGoesLeavesItsRowWhileItIsHeld) {
    HeldOrder order;
    EXPECT_EQ(order.update({"b", "c"}, false), (Rows{0, 1}));
    EXPECT_EQ(order.update({"a", "b", "c"}, true), (Rows{1, 2, 0}));
    EXPECT_EQ(order.update({"a", "c"}, true), (Rows{HeldOrder::gone, 1, 0}));
    EXPECT_EQ(order.key(0), "b");
    EXPECT_EQ(order.update({"a", "c"}, false), (Rows{0, 1}));
    EXPECT_EQ(order.update({"a", "a", "c"}, true), (Rows{0, 2, 1})) << "two of one name";
}

class HeldAgents : public testing::Test {
protected:
    HeldAgents() {
        view.resize(900, 600);
        view.show();
    }
    void show(std::vector<AgentFrame> agents) {
        view.refresh(*frameOf(std::move(agents)));
        QApplication::processEvents();
    }
    QStringList names() {
        QStringList all;
        for (int row = 0; row < table().topLevelItemCount(); ++row)
            all << table().topLevelItem(row)->text(0);
        return all;
    }
    AgentTable& table() { return *view.findChild<AgentTable*>(); }
    QRect place(const QWidget& widget) { return {widget.mapTo(&view, QPoint{}), widget.size()}; }

    MadeAgent arm = clusterNamed("arm"), mill = clusterNamed("mill"), robot = clusterNamed("robot");
    AgentView view;
};

TEST_F(HeldAgents, StandWhereTheyStoodWhileTheTableHasTheKeyboard) {
    show({mill.now(), robot.now()});
    QApplication::setActiveWindow(&view);
    table().setFocus();
    show({arm.now(), mill.now(), robot.now()});
    EXPECT_EQ(names(), (QStringList{"mill", "robot", "arm"}));
    show({arm.now(), robot.now()});
    EXPECT_EQ(names(), (QStringList{"mill", "robot", "arm"}));
    EXPECT_EQ(table().topLevelItem(0)->text(11), "It is not heard.");
    table().clearFocus();
    show({arm.now(), robot.now()});
    EXPECT_EQ(names(), (QStringList{"arm", "robot"}));
}

TEST_F(HeldAgents, NothingBelowThemMovesUnderThePointer) {
    show({mill.now(), robot.now()});
    const auto& below = *view.findChild<TabRow*>();
    const QRect before = place(below);
    view.setAttribute(Qt::WA_UnderMouse);
    show({arm.now(), mill.now(), robot.now()});
    EXPECT_EQ(place(below), before);
    view.setAttribute(Qt::WA_UnderMouse, false);
    show({arm.now(), mill.now(), robot.now()});
    EXPECT_GT(place(below).y(), before.y());
}

TEST_F(HeldAgents, ATroubleOfOneMovesNothing) {
    show({mill.now(), robot.now()});
    const auto& below = *view.findChild<TabRow*>();
    const QRect before = place(below);
    show({mill.now("lost"), robot.now()});
    EXPECT_EQ(place(below), before);
}

// A reader of /order, in each of two agents.
MadeAgent readerNamed(const std::string& name) {
    return {name, [&](SimplexTree& tree) {
                auto& reader = tree.add("/" + name + "/reader", "Probe");
                tree.relateRemote(reader, "in", "/order", "Order", false);
            }};
}

TEST(HeldRelations, StayAsTheyAreWhenAnotherAgentComesAndChangesNoneOfThem) {
    MadeAgent orders{"orders", [](SimplexTree& tree) { tree.add("/order", "Order"); }};
    MadeAgent first = readerNamed("first"), other = clusterNamed("another");
    RelationTable table;
    const auto show = [&](std::vector<AgentFrame> agents) {
        const auto frame = frameOf(std::move(agents));
        table.show(*frame, *frame->find("/order"));
        table.refresh(*frame);
    };
    show({first.now(), orders.now()});
    ASSERT_EQ(table.count(), 1);
    auto* group = table.topLevelItem(0);
    QTreeWidgetItem* row = group->child(0);
    group->setExpanded(false);
    table.setCurrentItem(group);
    show({other.now(), first.now(), orders.now()});
    ASSERT_EQ(table.topLevelItem(0), group) << "it was not made anew";
    EXPECT_FALSE(group->isExpanded());
    EXPECT_EQ(table.currentItem(), group);
    EXPECT_EQ(group->child(0), row);
    EXPECT_NE(row->text(4), "") << "its state is that of its agent, wherever that stands now";
    MadeAgent third = readerNamed("third");
    show({other.now(), first.now(), orders.now(), third.now()});
    EXPECT_EQ(table.count(), 2);
}

}  // namespace
}  // namespace cortex::test
