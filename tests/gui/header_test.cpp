// SPDX-License-Identifier: Apache-2.0
// What stands above the tabs of a simplex, and in the line at the bottom, of agents made by hand.
#include "gui/made_agent.hpp"
#include "gui/window_fixture.hpp"
#include "views/agent_table.hpp"
#include "views/relation_table.hpp"
#include "views/simplex_header.hpp"
#include "widgets/link.hpp"
#include "widgets/text_label.hpp"
#include "window/status_bar.hpp"

#include <QFontInfo>

#include <QtTest/QTest>

namespace cortex::test {
namespace {

class Header : public testing::Test {
protected:
    Header() {
        window.resize(1280, 800);
        header.resize(1000, 200);
        QObject::connect(&header, &SimplexHeader::typeWanted,
                         [this](const std::string& type) { wanted = type; });
    }
    void show(const std::string& path, std::vector<AgentFrame> agents,
              std::vector<comms::Contested> contested = {}) {
        Frame frame = *frameOf(std::move(agents));
        frame.contested = std::move(contested);
        header.show(frame, *frame.find(path));
    }
    // Of /probe, at this second.
    void addEvent(const std::string& kind, const std::string& text, std::int64_t when) {
        comms::AgentEvent event;
        event.agent = "robot";
        event.epoch = robot.structure->epoch;
        event.path = "/probe";
        event.kind = kind;
        event.text = text;
        event.wallClock = when * 1'000'000'000;
        times.add({event});
    }
    bool says(const QString& text) {
        for (const auto* label : header.findChildren<TextLabel*>()) {
            if (!label->isHidden() && label->text().contains(text)) return true;
        }
        return false;
    }

    MadeAgent robot{"robot", [](SimplexTree& tree) {
                        Simplex& probe = tree.add("/probe", "Probe");
                        Simplex& order = tree.add("/order", "Order");
                        tree.relate(probe, "out", order);
                        tree.add("/signal", "Signal");
                    }};
    StateTimes times;
    QWidget window;
    SimplexHeader& header = *new SimplexHeader{new QWidget, times, &window};
    std::string wanted;
};

TEST_F(Header, HasCodeAndWholeTextOfAFault) {
    robot.put("/probe", "state", std::int64_t{4});
    robot.put("/probe", "faultCode", std::int64_t{-8});
    robot.put("/probe", "faultText",
              std::string{"<b>axis</b> 4 does not follow: 0.052 rad, 0.050"});
    for (const int width : {1000, 500, 320}) {
        header.resize(width, 200);
        show("/probe", {robot.now()});
        EXPECT_TRUE(says("Fault −8"));
        EXPECT_TRUE(says("<b>axis</b> 4 does not follow: 0.052 rad, 0.050"));
    }
    for (const auto* label : header.findChildren<TextLabel*>()) {
        const bool isFault = label->text().contains("does not follow");
        EXPECT_TRUE(!isFault || label->wordWrap());
    }
    robot.put("/probe", "state", std::int64_t{2});
    show("/probe", {robot.now()});
    EXPECT_FALSE(says("does not follow"));
}

const std::string longFault =
    "axis 4 does not follow: 0.052 rad behind, at most 0.050 rad are allowed";

TEST_F(Header, HasTheWholeTextOfAFaultFromItsEvent) {
    robot.put("/probe", "state", std::int64_t{4});
    robot.put("/probe", "faultCode", std::int64_t{-8});
    robot.put("/probe", "faultText", longFault);
    addEvent("fault", "fault -8: " + longFault, 1);
    show("/probe", {robot.now()});
    EXPECT_TRUE(says(QString::fromStdString(longFault)));
    EXPECT_FALSE(says("…"));
    addEvent("state change", "Fault -> Standby", 2);
    show("/probe", {robot.now()});
    EXPECT_TRUE(says(QString::fromStdString(longFault.substr(0, 48)) + "…"))
        << "that was a fault before";
    addEvent("fault", "fault -8: another one", 3);
    show("/probe", {robot.now()});
    EXPECT_TRUE(says(QString::fromStdString(longFault.substr(0, 48)) + "…"));
}

TEST_F(Header, ATextOfAFaultThatMayBeCutSaysSo) {
    robot.put("/probe", "state", std::int64_t{4});
    robot.put("/probe", "faultText", longFault);
    show("/probe", {robot.now()});
    const auto labels = header.findChildren<TextLabel*>();
    const auto cut = std::ranges::find_if(
        labels, [](const auto* each) { return each->text().startsWith("axis 4"); });
    ASSERT_NE(cut, labels.end());
    EXPECT_TRUE((*cut)->text().endsWith("…"));
    EXPECT_EQ((*cut)->toolTip(), "The rest stands in the events.");
    robot.put("/probe", "faultText", std::string{"axis 4 does not follow"});
    show("/probe", {robot.now()});
    EXPECT_EQ((*cut)->text(), "axis 4 does not follow");
    EXPECT_EQ((*cut)->toolTip(), "");
}

TEST_F(Header, SaysWhenTheAgentOfAnInputHasEndedAsLongAsItIsGone) {
    MadeAgent desk{"desk", [](SimplexTree& tree) {
                       Simplex& reader = tree.add("/reader", "Probe");
                       tree.relateRemote(reader, "in", "/order", "Order", false);
                   }};
    desk.put("/reader", "state", std::int64_t{2});
    desk.degrade("/reader", Quality::Lost, "/order");
    const GoneAgent gone{"robot", true, 3'600'000'000'000, robot.structure};
    AgentFrame ended = robot.now("lost");
    ended.status.ended = true;
    for (const auto& agents : {std::vector{desk.now(), ended}, std::vector{desk.now()}}) {
        Frame frame = *frameOf(agents);
        frame.gone = {gone};
        header.show(frame, *frame.find("/reader"));
        EXPECT_TRUE(says("The input /order is gone: robot ended at 01:00:00 UTC."));
        EXPECT_FALSE(says("at rest")) << "it is Active";
        EXPECT_TRUE(says("input lost"));
        EXPECT_FALSE(says("Input lost: ")) << "the other sentence says more";
    }
    Frame frame = *frameOf({desk.now(), robot.now()});
    header.show(frame, *frame.find("/reader"));
    EXPECT_FALSE(says("is gone"));
    header.show(*frameOf({desk.now()}), {0, desk.at("/reader")});
    EXPECT_TRUE(says("Input lost: /order, which is not heard."));
}

TEST_F(Header, OfALostAgentNothingIsYoungerThanItsNewestCycle) {
    AgentFrame lost = robot.now("lost");
    lost.status.age = 12.1;
    show("/probe", {lost});
    EXPECT_TRUE(says("robot is not heard for 12.1 s."));
    EXPECT_TRUE(says("agent robot, 12.1 s old"));
}

TEST_F(Header, WhatRestsHasNoAge) {
    robot.put("/probe", "state", std::int64_t{0});
    robot.degrade("/probe", Quality::Stale, "/probe");
    show("/probe", {robot.now()});
    EXPECT_TRUE(says("at rest: writes nothing"));
    EXPECT_FALSE(says("stale"));
    EXPECT_TRUE(says("agent robot"));
    EXPECT_FALSE(says("ago"));
    EXPECT_FALSE(says("100 ms"));
}

TEST_F(Header, SaysWhoseValuesAreShownWhereTwoAgentsClaimThePath) {
    MadeAgent spare{"spare", [](SimplexTree& tree) { tree.add("/probe", "Probe"); }};
    const comms::Contested contest{"/probe",
                                   {"robot", "spare"},
                                   "spare",
                                   "which was there first",
                                   "agents robot, spare both have /probe; commands go to spare, "
                                   "which was there first"};
    AgentFrame first = robot.now(), second = spare.now();
    show("/probe", {first, second}, {contest});
    EXPECT_TRUE(
        says("Agents robot, spare both have /probe; commands go to spare, which was there "
             "first."));
    EXPECT_TRUE(says("agent spare"));
    second.status.state = "lost";
    show("/probe", {first, second});
    EXPECT_FALSE(says("both have"));
    EXPECT_TRUE(says("agent robot")) << "who is heard owns it";
}

TEST_F(Header, SaysTheFaultOfAnAgentWhoseValuesAreNotShown) {
    MadeAgent spare{"spare", [](SimplexTree& tree) { tree.add("/probe", "Probe"); }};
    const comms::Contested contest{
        "/probe", {"robot", "spare"}, "robot", "", "agents robot, spare both have /probe"};
    spare.put("/probe", "state", std::int64_t{4});
    spare.put("/probe", "faultCode", std::int64_t{-7});
    spare.put("/probe", "faultText", std::string{"50 %1 of the torque"});
    show("/probe", {robot.now(), spare.now()}, {contest});
    EXPECT_TRUE(says("agent robot"));
    EXPECT_TRUE(says("both have /probe. spare has it in Fault −7: 50 %1 of the torque."));
    show("/probe", {robot.now(), spare.now("lost")}, {contest});
    EXPECT_FALSE(says("spare has it")) << "its last state may be over";
    spare.put("/probe", "state", std::int64_t{2});
    show("/probe", {robot.now(), spare.now()}, {contest});
    EXPECT_FALSE(says("spare has it"));
}

TEST_F(Header, HasLinksToTheAncestorsOfTheType) {
    show("/order", {robot.now()});
    std::vector<QString> texts;
    std::vector<Link*> links;
    for (auto* each : header.findChildren<Link*>()) {
        if (each->text().isEmpty()) continue;  // of messages that have no room: none
        links.push_back(each);
        texts.push_back(each->text());
    }
    EXPECT_EQ(texts, (std::vector<QString>{"Signal", "Concept", "Simplex"}));
    QTest::mouseClick(links.at(0), Qt::LeftButton);
    EXPECT_EQ(wanted, "Signal");
    QTest::keyClick(links.at(1), Qt::Key_Return);
    EXPECT_EQ(wanted, "Concept");
}

TEST_F(Header, SaysSinceWhenItIsInItsState) {
    show("/probe", {robot.now()});
    EXPECT_TRUE(says("since before "));
    comms::AgentEvent event;
    event.agent = "robot";
    event.epoch = robot.structure->epoch;
    event.path = "/probe";
    event.kind = "state change";
    event.wallClock = 3'600'000'000'000;
    times.add({event});
    show("/probe", {robot.now()});
    EXPECT_TRUE(says("since 01:00:00 UTC, "));
}

TEST_F(Header, SaysWhoWritesADemandAndWhyItIsSafe) {
    robot.put("/probe", "state", std::int64_t{0});
    robot.degrade("/order", Quality::Stale);
    robot.tables->live(robot.at("/order")).state->cause = robot.at("/probe");
    show("/order", {robot.now()});
    EXPECT_TRUE(says("Written by /probe (Standby)."));
    EXPECT_TRUE(says("Safe values, as /probe is in Standby."));
    EXPECT_TRUE(says("at rest: not written"));
}

TEST_F(Header, OfDataSaysWhatTheyAreAndNotInTheSizeOfAState) {
    const auto said = [this](const QString& text) -> const TextLabel& {
        for (const auto* each : header.findChildren<TextLabel*>()) {
            if (each->text() == text) return *each;
        }
        throw std::runtime_error{"it does not say " + text.toStdString()};
    };
    show("/probe", {robot.now()});
    const int ofAState = QFontInfo{said("Standby").font()}.pixelSize();
    show("/order", {robot.now()});
    const TextLabel& role = said("modification: data of the plant as it is wished to be");
    EXPECT_LT(QFontInfo{role.font()}.pixelSize(), ofAState);
    EXPECT_FALSE(role.font().bold());
    EXPECT_EQ(role.accessibleDescription(),
              "modification: data of the plant as it is wished to be. It has no state and no task "
              "of its own.");
    header.resize(200, 300);
    show("/order", {robot.now()});
    EXPECT_TRUE(says("modification")) << "where it has no room";
    EXPECT_FALSE(says("modification: "));
}

TEST_F(Header, SaysWhatPartOfThePeriodItsTaskTakes) {
    robot.put("/probe", "taskTime", 2.34);
    show("/probe", {robot.now()});
    EXPECT_TRUE(says("task 2.3 µs of 1 ms"));
}

TEST_F(Header, HasNoAgeWhereNothingChangesByItself) {
    show("/signal", {robot.now()});
    EXPECT_FALSE(says(" old"));
    show("/probe", {robot.now()});
    EXPECT_TRUE(says("100 ms old"));
}

TEST_F(Header, OfALostAgentHasItsLastStateInBrackets) {
    robot.put("/probe", "state", std::int64_t{2});
    show("/probe", {robot.now("lost")});
    EXPECT_TRUE(says("[Active]"));
    EXPECT_TRUE(says("quality lost"));
    EXPECT_TRUE(says("Values are the last ones, in brackets."));
}

TEST_F(Header, RelationshipsCountReadersInOtherAgents) {
    MadeAgent other{"other", [](SimplexTree& tree) {
                        Simplex& reader = tree.add("/reader", "Probe");
                        tree.relateRemote(reader, "in", "/order", "Order", false);
                    }};
    const auto frame = frameOf({other.now(), robot.now()});
    RelationTable table;
    table.show(*frame, *frame->find("/order"));
    table.refresh(*frame);
    EXPECT_EQ(table.count(), 2) << "/probe writes it, /reader of another agent reads it";
    QStringList paths;
    for (int i = 0; i < table.topLevelItem(0)->childCount(); ++i) {
        paths << table.topLevelItem(0)->child(i)->text(2) + ' ' +
                     table.topLevelItem(0)->child(i)->text(4);
    }
    EXPECT_EQ(paths.join(", "), "/reader Standby, /probe Standby");
}

TEST_F(Header, AnOverloadedLoopShowsTheRateItReaches) {
    AgentFrame slow = robot.now("overloaded");
    slow.status.overloaded = true;
    slow.status.rate = 734;
    const auto frame = frameOf({slow});
    StatusBar bar;
    bar.resize(1280, bar.height());
    bar.refresh(*frame, Abnormal{});
    AgentTable table;
    table.refresh(*frame);
    const auto labels = bar.findChildren<TextLabel*>();
    EXPECT_TRUE(std::ranges::any_of(labels, [](const auto* each) {
        return each->text().contains("robot overloaded: 734 of 1000 Hz");
    }));
    bool inTable = false;
    for (int i = 0; i < table.columnCount(); ++i) {
        inTable = inTable || table.topLevelItem(0)->text(i) == "734 of 1000 Hz";
    }
    EXPECT_TRUE(inTable);
    EXPECT_TRUE(table.topLevelItem(0)->text(table.columnCount() - 1).startsWith("overloaded: 734"));
    EXPECT_GE(table.columnWidth(5), QFontMetrics{table.font()}.horizontalAdvance("734 of 1000 Hz"));
}

TEST_F(Header, AgentsThatHaveNoRoomInTheLineBelowAreAButtonToAll) {
    const auto frame = frameOf(std::vector<AgentFrame>(5, robot.now()));
    StatusBar bar;
    int wanted = 0;
    QObject::connect(&bar, &StatusBar::agentsWanted, [&] { ++wanted; });
    auto& more = *bar.findChild<Link*>();
    bar.resize(1600, bar.height());
    bar.refresh(*frame, Abnormal{});
    EXPECT_EQ(more.text(), "+2");
    EXPECT_EQ(more.accessibleName(), "2 agents");
    bar.resize(560, bar.height());
    bar.refresh(*frame, Abnormal{});
    EXPECT_EQ(more.text(), "5 agents");
    EXPECT_FALSE(more.isHidden());
    more.click();
    EXPECT_EQ(wanted, 1);
    bar.refresh(*frameOf({robot.now()}), Abnormal{});
    EXPECT_TRUE(more.isHidden());
}

TEST_F(Header, ALoopThatReachesItsRateAgainIsNotSaidToMissIt) {
    AgentFrame again = robot.now("overloaded");
    again.status.overloaded = true;
    again.status.rate = 999.96;
    StatusBar bar;
    bar.resize(900, bar.height());
    bar.refresh(*frameOf({again}), Abnormal{});
    const auto labels = bar.findChildren<TextLabel*>();
    EXPECT_TRUE(std::ranges::any_of(labels, [](const auto* each) {
        return each->text() == "robot overloaded until just now";
    }));
}

}  // namespace
}  // namespace cortex::test
