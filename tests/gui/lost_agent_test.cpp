// SPDX-License-Identifier: Apache-2.0
// What the window knows of agents that are not heard any longer, or not yet.
#include "cortex/explorer/view.hpp"

#include "gui/made_agent.hpp"
#include "model/item_model.hpp"

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

MadeAgent readingAgent() {
    return {"robot",
            [](SimplexTree& tree) {
                Simplex& reading = tree.add("/reading", "Reading");
                reading.set("a", 1.5);
                reading.set("origin", Value{std::vector<double>{1, 2, 3}});
            },
            "command-types.xml"};
}

TEST(LostAgent, AViewOfOnesOwnKnowsConstantsBeforeAnyValueCame) {
    MadeAgent robot = readingAgent();
    AgentFrame silent = robot.now();
    silent.image = nullptr;
    const auto frame = frameOf({silent});
    const explorer::SimplexNow now{*frame, "/reading"};
    EXPECT_EQ(now.number("origin", 1), 2.0);
    EXPECT_EQ(now.text("origin", 2), "3");
    EXPECT_FALSE(now.number("a"));
    EXPECT_EQ(now.text("a"), "—");
}

TEST(LostAgent, AViewOfOnesOwnHasItsLastValuesInBracketsAndItsConstantsAsTheyAre) {
    MadeAgent robot = readingAgent();
    const auto frame = frameOf({robot.now("lost")});
    const explorer::SimplexNow now{*frame, "/reading"};
    EXPECT_EQ(now.number("a"), 1.5);
    EXPECT_EQ(now.text("a"), "[1.5]");
    EXPECT_EQ(now.text("origin", 0), "1");
    EXPECT_TRUE(now.age());
}

TEST(LostAgent, TheTableOfDataHasConstantsOfWhatNeverCame) {
    MadeAgent robot = readingAgent();
    AgentFrame silent = robot.now("lost");
    silent.image = nullptr;
    ItemModel items;
    items.show("/reading");
    items.update(frameOf({silent}));
    const QModelIndex group = items.index(0, 0);
    for (int row = 0; row < items.rowCount(group); ++row) {
        const QString name = items.index(row, ItemModel::Name, group).data().toString();
        const QString value = items.index(row, ItemModel::Value, group).data().toString();
        EXPECT_EQ(value, name == "origin" ? "3 values" : "—") << name.toStdString();
    }
}

// The row of an item of a simplex or of what it is related to: its value and its remark.
std::pair<QString, QString> rowOf(const std::string& path, const std::shared_ptr<Frame>& frame,
                                  const QString& item) {
    ItemModel items;
    items.show(path);
    items.update(frame);
    for (int group = 0; group < items.rowCount(); ++group) {
        const QModelIndex above = items.index(group, 0);
        for (int row = 0; row < items.rowCount(above); ++row) {
            if (items.index(row, ItemModel::Name, above).data() != item) continue;
            return {items.index(row, ItemModel::Value, above).data().toString(),
                    items.index(row, ItemModel::Remark, above).data().toString()};
        }
    }
    return {};
}

std::pair<QString, QString> orderRow(const AgentFrame& agent, const QString& item) {
    return rowOf("/order", frameOf({agent}), item);
}

TEST(LostAgent, ValuesOfARelatedSimplexAreThoseOfItsAgentWhateverBecameOfIt) {
    MadeAgent desk{"desk", [](SimplexTree& tree) {
                       Simplex& reader = tree.add("/reader", "Probe");
                       tree.relateRemote(reader, "in", "/order", "Order", false);
                   }};
    MadeAgent source{"source", [](SimplexTree& tree) { tree.add("/order", "Order"); }};
    source.put("/order", "level", 3.0);
    using Row = std::pair<QString, QString>;
    const auto related = [&](std::vector<AgentFrame> agents, std::vector<GoneAgent> gone = {}) {
        auto frame = frameOf(std::move(agents));
        frame->complete = true;
        frame->gone = std::move(gone);
        return rowOf("/reader", frame, "level");
    };
    EXPECT_EQ(related({desk.now(), source.now()}).first, "3");
    EXPECT_EQ(related({desk.now(), source.now("lost")}), (Row{"[3]", "lost"}));
    AgentFrame ended = source.now("lost");
    ended.status.ended = true;
    const GoneAgent gone{"source", true, 1, source.structure};
    EXPECT_EQ(related({desk.now(), ended}, {gone}), (Row{"[3]", "ended"}));
    EXPECT_EQ(related({desk.now()}, {gone}), (Row{"—", "ended"}));
    EXPECT_EQ(related({desk.now()}), (Row{"—", "lost"})) << "nobody has it";
    EXPECT_EQ(rowOf("/reader", frameOf({desk.now()}), "level").first, "…") << "it may still come";
}

TEST(LostAgent, ATextThatFillsItsItemIsNotShownAsAWholeOne) {
    MadeAgent robot{"robot", [](SimplexTree& tree) { tree.add("/probe", "Probe"); }};
    const auto shown = [&](const std::string& text) {
        robot.put("/probe", "faultText", text);
        return rowOf("/probe", frameOf({robot.now()}), "faultText").first.toStdString();
    };
    const std::string accents = "é" + std::string(45, 'x');
    EXPECT_EQ(shown(std::string(60, 'x')), std::string(48, 'x') + "…");
    EXPECT_EQ(shown(accents + "é"), accents + "…") << "no character is cut in two";
    EXPECT_EQ(shown(std::string(47, 'x')), std::string(47, 'x'));
}

TEST(Resting, AValueIsInBracketsAndItsMarkIsThatOfStandby) {
    MadeAgent robot{"robot", [](SimplexTree& tree) {
                        Simplex& probe = tree.add("/probe", "Probe");
                        tree.relate(probe, "out", tree.add("/order", "Order"));
                        tree.add("/seen", "Seen");
                    }};
    const std::pair<QString, QString> good{"0", "safe 0"}, rests{"[0]", "Standby"},
        stale{"[0]", "stale"};
    const auto seenRow = [&] { return rowOf("/seen", frameOf({robot.now()}), "level"); };
    EXPECT_EQ(orderRow(robot.now(), "value"), good) << "a demand says what its safe value is";
    robot.degrade("/order", Quality::Stale, "/probe");
    robot.degrade("/seen", Quality::Stale, "/probe");
    robot.put("/probe", "state", std::int64_t{0});
    EXPECT_EQ(orderRow(robot.now(), "value"), good) << "a safe demand is the present value";
    EXPECT_EQ(seenRow(), rests);
    robot.put("/probe", "state", std::int64_t{2});
    EXPECT_EQ(orderRow(robot.now(), "value"), stale) << "it should be live and is not";
    EXPECT_EQ(seenRow(), stale);
    AgentFrame ended = robot.now("lost");
    ended.status.ended = true;
    const std::pair<QString, QString> over{"[0]", "ended"};
    EXPECT_EQ(orderRow(ended, "value"), over) << "an orderly end is no loss";
}

}  // namespace
}  // namespace cortex::test
