// SPDX-License-Identifier: Apache-2.0
// The first page: what it says, of agents made by hand, and that nothing in it moves.
#include "gui/events_fixture.hpp"
#include "gui/made_agent.hpp"
#include "gui/measured_agent.hpp"
#include "model/shown_time.hpp"
#include "model/wrong_rows.hpp"
#include "views/overview_part.hpp"
#include "views/overview_view.hpp"
#include "widgets/text_label.hpp"

#include <QApplication>
#include <QScrollArea>
#include <QScrollBar>

#include <QtTest/QTest>
#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

QStringList cellsOf(const OverviewRows& rows, int column) {
    QStringList all;
    for (const OverviewRow& each : rows) all << each.cells[column];
    return all;
}

comms::AgentEvent commandOf(std::uint64_t number, const std::string& text) {
    return eventOf(number, "command", "/drive", text);
}

class FirstPage : public testing::Test {
protected:
    FirstPage() {
        robot.put("/b", "state", std::int64_t{4});
        robot.put("/b", "faultCode", std::int64_t{7});
        robot.put("/b", "faultText", std::string{"the brake is closed"});
        robot.put("/seen", "level", 3.0);
        robot.put("/old", "level", 0.5);
        view.resize(1200, 600);
        view.show();
        QApplication::processEvents();
        if (QWidget* focused = QApplication::focusWidget()) focused->clearFocus();
    }
    void show(const std::shared_ptr<const Frame>& frame) {
        abnormal.update(*frame);
        view.refresh(frame);
        QApplication::processEvents();
    }
    OverviewTable& table(const QString& name) {
        for (auto* each : view.findChildren<OverviewTable*>())
            if (each->accessibleName() == name) return *each;
        throw std::runtime_error{"no such part"};
    }
    QStringList shown(const QString& part, int column = 0) {
        QStringList all;
        for (int row = 0; row < table(part).topLevelItemCount(); ++row)
            all << table(part).topLevelItem(row)->text(column);
        return all;
    }
    bool says(const QString& text) {
        QApplication::processEvents();
        const auto labels = view.findChildren<TextLabel*>();
        return std::ranges::any_of(
            labels, [&](const auto* each) { return each->isVisible() && each->text() == text; });
    }

    MadeAgent robot{"robot", [](SimplexTree& tree) {
                        for (const char* each : {"/a", "/b"}) tree.add(each, "Probe");
                        for (const char* each : {"/old", "/seen"}) tree.add(each, "Seen");
                    }};
    MadeAgent arm = clusterNamed("arm"), mill = clusterNamed("mill");
    Abnormal abnormal;
    StateTimes times;
    EventModel events;
    OverviewView view{abnormal, times, events};
};

TEST_F(FirstPage, NamesTheAgentsThatAreWorstOffFirstWithTheRateThatTheyReach) {
    AgentFrame slow = mill.now("overloaded"), lost = robot.now("lost"), gone = arm.now("lost");
    slow.status.overloaded = true;
    slow.status.rate = 734;
    lost.status.age = 12.4;
    gone.status.ended = true;
    gone.status.age = 5;
    MadeAgent well = clusterNamed("well");
    const auto rows = agentRows(*frameOf({gone, slow, lost, well.now()}));
    EXPECT_EQ(cellsOf(rows, 0), (QStringList{"robot", "mill", "arm", "well"}));
    EXPECT_EQ(cellsOf(rows, 1),
              (QStringList{"lost for 12 s", "overloaded", "ended 5 s ago", "running"}));
    EXPECT_EQ(cellsOf(rows, 2), (QStringList{"—", "734 of 1000 Hz", "—", "1000 Hz"}));
    EXPECT_EQ(rows[0].shape, Shape::Lost);
    EXPECT_EQ(rows[1].shape, Shape::Warning);
}

TEST_F(FirstPage, SaysWhatIsWrongWithTheFaultTheItemAndItsLimit) {
    AgentFrame lost = arm.now("lost");
    lost.status.age = 12;
    const auto frame = frameOf({lost, robot.now()});
    abnormal.update(*frame);
    const auto rows = wrongRows(*frame, abnormal, times);
    EXPECT_EQ(cellsOf(rows, 0), (QStringList{"/b", "/seen", "/arm"}));
    EXPECT_EQ(rows[0].cells[1], "Fault 7: the brake is closed");
    EXPECT_TRUE(rows[1].cells[1].startsWith("level 3") && rows[1].cells[1].contains(", above "))
        << rows[1].cells[1].toStdString();
    EXPECT_EQ(rows[1].item, "level");
    EXPECT_EQ(rows[1].shape, Shape::AboveLimit);
    EXPECT_EQ(rows[2].cells[1], "Agent arm is lost for 12 s, with all that it has");
    EXPECT_EQ(wrongCount(*frame, abnormal), "1 in Fault, 1 outside limits, 1 lost");
}

TEST_F(FirstPage, HasOneRowOfAPathThatIsInFaultAndLostAsWell) {
    robot.degrade("/b", Quality::Lost);
    auto frame = frameOf({robot.now()});
    abnormal.update(*frame);
    const auto rows = wrongRows(*frame, abnormal, times);
    EXPECT_EQ(cellsOf(rows, 0), (QStringList{"/b", "/seen"}));
    EXPECT_EQ(rows[0].cells[1], "Fault 7: the brake is closed; its values are lost");
    EXPECT_EQ(wrongCount(*frame, abnormal), "1 in Fault, 1 outside limits, 1 lost")
        << "as the tree counts";
    const auto structures = frame->structures;
    abnormal.update(*frame);  // it is not its turn to look again
    frame = frameOf({robot.now("lost")});
    frame->structures = structures;
    abnormal.update(*frame);
    EXPECT_EQ(wrongCount(*frame, abnormal), "4 lost") << "at once, of what it was nothing is known";
    EXPECT_EQ(wrongRows(*frame, abnormal, times).size(), 1U);
}

TEST_F(FirstPage, NamesAPathThatTwoAgentsClaimWhileBothAreHeard) {
    auto frame = frameOf({arm.now(), robot.now()});
    frame->contested.push_back(
        {"/b", {"arm", "robot"}, "arm", "which was there first", "agents arm, robot both have /b"});
    abnormal.update(*frame);
    auto rows = wrongRows(*frame, abnormal, times);
    ASSERT_FALSE(rows.empty());
    EXPECT_EQ(rows.back().cells, (QStringList{"/b", "agents arm, robot both have /b"}));
    EXPECT_EQ(rows.back().shape, Shape::Contradiction);
    EXPECT_TRUE(wrongCount(*frame, abnormal).endsWith("1 claimed twice"));
    frame->agents = {arm.now(), robot.now("lost")};
    EXPECT_FALSE(wrongCount(*frame, abnormal).contains("claimed"));
    frame->agents.push_back(mill.now());
    frame->contested[0].agents.push_back("mill");
    EXPECT_TRUE(wrongCount(*frame, abnormal).endsWith("1 claimed twice")) << "two are heard";
}

TEST_F(FirstPage, SaysHowManyMoreAreWrongWhereThereAreVeryMany) {
    MadeAgent large{"large", [](SimplexTree& tree) {
                        for (int i = 0; i < 150; ++i) tree.add("/p" + std::to_string(i), "Probe");
                    }};
    for (int i = 0; i < 150; ++i) large.put("/p" + std::to_string(i), "state", std::int64_t{4});
    const auto frame = frameOf({large.now()});
    abnormal.update(*frame);
    const auto rows = wrongRows(*frame, abnormal, times);
    ASSERT_EQ(rows.size(), mostWrongOfAKind + 1);
    EXPECT_EQ(rows.back().cells[0], "and 50 more");
    EXPECT_EQ(rows.back().opens, abnormal.found(Abnormal::Fault)[mostWrongOfAKind].path);
}

TEST_F(FirstPage, NamesThePersonFirstWhoHoldsControlOfWhat) {
    giveLease(arm, "/arm", "/", "cortex-explorer@desk.1-1");
    giveLease(mill, "/mill", "/", "cortex-explorer@desk.1-1");
    auto frame = frameOf({arm.now(), mill.now(), robot.now()});
    frame->control.self = "cortex-explorer@own.2-2";
    frame->control.tools.push_back({"cortex-explorer@desk.1-1", "desk", "alice", {}, {}, {}});
    auto rows = controlRows(*frame);
    EXPECT_EQ(controlNote(*frame, true, 9), "All else is held by nobody.");
    EXPECT_EQ(controlNote(*frame, false, 9), "");
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].cells.mid(0, 3),
              (QStringList{"everything", "alice (cortex-explorer@desk.1-1)", "arm and mill"}));
    EXPECT_FALSE(rows[0].cells[3].isEmpty());
    frame->control.self = "cortex-explorer@desk.1-1";
    frame->control.person = "ben";
    EXPECT_EQ(controlRows(*frame)[0].cells[1], "you: ben (cortex-explorer@desk.1-1)");
    giveLease(mill, "/mill", "", "");
    frame->agents = {arm.now("lost"), mill.now()};
    EXPECT_TRUE(controlRows(*frame).empty()) << "nobody knows what a lost agent would show";
    EXPECT_EQ(controlNote(*frame, false, 9), "Not heard, so not known of: arm.");
    EXPECT_EQ(controlNote(*frame, true, 9), "Not heard, so not known of: arm.");
    frame->agents.front().status.ended = true;
    EXPECT_EQ(controlNote(*frame, true, 9), "All else is held by nobody.") << "it has ended";
}

TEST_F(FirstPage, HasARowForEachMomentAtWhichAPartWasTaken) {
    MadeAgent late = clusterNamed("late");
    for (auto* each : {&arm, &mill, &late}) each->skip(300'000);
    giveLease(arm, "/arm", "/", "desk");
    giveLease(mill, "/mill", "/", "desk", 2'000);
    giveLease(late, "/late", "/", "desk", 200'000);
    const auto frame = frameOf({arm.now(), late.now(), mill.now(), robot.now()});
    const auto rows = controlRows(*frame);
    EXPECT_EQ(cellsOf(rows, 2), (QStringList{"arm and mill", "late"}));
    EXPECT_EQ(cellsOf(rows, 3), (QStringList{"22:13:20", "22:16:40"}));
    EXPECT_NE(rows[0].key, rows[1].key) << "each keeps a place of its own";
}

TEST_F(FirstPage, SaysOfWhatIsHeldNoMoreThanIsKnownWhereARowIsKept) {
    giveLease(arm, "/arm", "/", "desk");
    show(frameOf({arm.now(), mill.now()}));
    table("Who controls what").setAttribute(Qt::WA_UnderMouse);
    show(frameOf({arm.now("lost"), mill.now()}));
    EXPECT_EQ(shown("Who controls what", 1).front(), "No agent that is heard says so now.");
    giveLease(arm, "/arm", "", "");
    show(frameOf({arm.now(), mill.now()}));
    EXPECT_EQ(shown("Who controls what", 1).front(), "It is not held any more.");
}

TEST_F(FirstPage, NamesAsManySilentAgentsAsTwoLinesHoldAndMovesNothing) {
    std::vector<AgentFrame> agents{mill.now()};
    const auto note = [&] {
        for (auto* each : view.findChildren<TextLabel*>())
            if (each->text().startsWith("Not heard")) return each;
        throw std::runtime_error{"no note"};
    };
    view.resize(500, 600);
    show(frameOf(agents));
    const auto places = [&] {
        std::vector<QRect> all;
        for (auto* each : view.findChildren<OverviewPart*>()) all.push_back(each->geometry());
        return all;
    };
    const auto before = places();
    for (int i = 0; i < 40; ++i) {
        MadeAgent each = clusterNamed("operator" + std::to_string(i));
        agents.push_back(each.now("lost"));
    }
    show(frameOf({agents[0], agents[1]}));
    EXPECT_EQ(note()->text(), "Not heard, so not known of: operator0.");
    show(frameOf(agents));
    const QString all = note()->text();
    EXPECT_TRUE(all.contains("operator2") && all.endsWith(" more.")) << all.toStdString();
    EXPECT_TRUE(note()->fits(all));
    EXPECT_GE(note()->height(), note()->heightOfLines(2));
    EXPECT_TRUE(places() == before);
}

TEST_F(FirstPage, HasTheLastCommandsAndLossesWhateverTheFilterOfEventsHides) {
    LastEvents last{events};
    EventFilter filter{events};
    filter.search("no such word");
    events.add({commandOf(1, "desk for alice: startup(): Done"), changes(2, 1).front(),
                commandOf(3, "desk: jog(axis=1): Done"), limit(4, "position limited from 3 to 2"),
                eventOf(5, "loss", "/arm", "agent lost", Severity::Warning),
                eventOf(8, "loss", "/arm", "input x is back"),
                eventOf(6, "control", "/", "desk for alice: takeControl(): Done"),
                eventOf(7, "fault", "/b", "fault 7: it hangs", Severity::Error)});
    const auto rows = last.update(false);
    EXPECT_EQ(cellsOf(rows, 1), (QStringList{"/drive", "/arm", "/", "/b"}));
    EXPECT_EQ(rows[0].cells[2], "alice: startup(): Done");
    EXPECT_EQ(rows[0].whole, "alice (desk): startup(): Done") << "the tool is in the tool tip";
    EXPECT_EQ(rows[3].shape, Shape::Fault);
}

TEST_F(FirstPage, KeepsCommandsThroughABurstOfLossesAndOrdersByTime) {
    LastEvents last{events}, later{events};
    last.update(false);  // it sees each as it comes, the other one what there is by then
    events.add({commandOf(1, "desk: a(): Done")});
    for (std::uint64_t i = 2; i <= 60; ++i)
        events.add({eventOf(i, "loss", "/arm", "input is lost", Severity::Warning)});
    auto early = commandOf(61, "desk: early(): Done");
    early.agent = "other";
    early.wallClock -= 3'600'000'000'000;
    events.add({early});
    for (LastEvents* each : {&last, &later}) {
        const auto& rows = each->update(false);
        ASSERT_EQ(rows.size(), LastEvents::usualLosses + 2);
        EXPECT_TRUE(rows[0].cells[2].contains("early")) << rows[0].cells[2].toStdString();
        EXPECT_TRUE(rows[1].cells[2].contains("a()")) << rows[1].cells[2].toStdString();
    }
}

TEST_F(FirstPage, KeepsTheLastTwentyAndMoreWhileTheyAreLookedAt) {
    LastEvents last{events};
    for (std::uint64_t i = 1; i <= 30; ++i) events.add({commandOf(i, "desk: a(): Done")});
    EXPECT_EQ(last.update(false).size(), LastEvents::usual);
    const std::string first = last.update(true).front().key;
    events.add({commandOf(31, "desk: newest(): Done")});
    EXPECT_EQ(last.update(true).front().key, first);
    events.addPast({commandOf(500, "desk: older(): Done")});
    EXPECT_EQ(last.update(true).size(), LastEvents::usual + 1);
    EXPECT_NE(last.update(false).front().key, first);
    EXPECT_EQ(last.update(false).size(), LastEvents::usual);
}

TEST_F(FirstPage, OpensTheFirstSimplexBelowWhatIsNoneItself) {
    MadeAgent deep{"deep", [](SimplexTree& tree) {
                       tree.add("/x/b", "Probe");
                       tree.add("/x/a", "Probe");
                       tree.add("/xy", "Probe");
                   }};
    const auto frame = frameOf({deep.now()});
    EXPECT_EQ(simplexAt(*frame, "/x"), "/x/a");
    EXPECT_EQ(simplexAt(*frame, "/xy"), "/xy");
    EXPECT_EQ(simplexAt(*frame, "/nothing"), "");
}

TEST_F(FirstPage, SaysInOneLineWhereThereIsNothing) {
    show(frameOf({arm.now()}));
    EXPECT_TRUE(says("Nothing is in Fault, outside its limits, lost, or claimed twice."));
    EXPECT_TRUE(says("Nobody controls anything."));
    EXPECT_TRUE(says("There was no command and no loss yet."));
    EXPECT_FALSE(table("What is wrong").isVisible());
}

TEST_F(FirstPage, SaysThatNobodyIsHeardAsThePageOfASimplexDoes) {
    auto frame = frameOf({});
    frame->domain = 7;
    show(frame);
    EXPECT_TRUE(says("Nobody is heard in domain 7."));
    frame = frameOf({});
    frame->problem = "the interface is gone";
    show(frame);
    EXPECT_TRUE(says("the interface is gone"));
}

TEST_F(FirstPage, KeepsItsRowsWhereTheyAreWhileThePointerIsInThem) {
    show(frameOf({mill.now(), robot.now()}));
    table("Agents").setAttribute(Qt::WA_UnderMouse);
    const QRect before = table("What is wrong").geometry();
    show(frameOf({arm.now(), mill.now(), robot.now("lost")}));
    EXPECT_EQ(shown("Agents"), (QStringList{"mill", "robot", "arm"}));
    show(frameOf({arm.now(), robot.now()}));
    EXPECT_EQ(shown("Agents"), (QStringList{"mill", "robot", "arm"}));
    EXPECT_EQ(shown("Agents", 3).front(), "It is not heard.");
    EXPECT_EQ(shown("Agents", 1).front(), "");
    auto later = frameOf({arm.now(), robot.now()});
    later->gone.push_back({"mill", true, MadeAgent::start, mill.structure});
    show(later);
    EXPECT_EQ(shown("Agents", 3).front(), "It ended at 22:13:20 UTC.");
    EXPECT_EQ(table("What is wrong").geometry(), before);
    table("Agents").setAttribute(Qt::WA_UnderMouse, false);
    show(frameOf({arm.now(), robot.now()}));
    EXPECT_EQ(shown("Agents"), (QStringList{"arm", "robot"}));
}

TEST_F(FirstPage, FollowsWhatIsWrongWhileTheKeyboardOnlyBeginsThere) {
    show(frameOf({robot.now()}));
    QApplication::setActiveWindow(&view);
    table("Agents").setFocus(Qt::OtherFocusReason);  // as a window does when it opens
    show(frameOf({robot.now(), arm.now("lost")}));
    EXPECT_EQ(shown("Agents"), (QStringList{"arm", "robot"})) << "the worst first";
    EXPECT_EQ(table("Agents").currentItem()->text(0), "robot") << "as before";
    QTest::keyClick(&table("Agents"), Qt::Key_Down);
    show(frameOf({robot.now(), arm.now("lost"), mill.now("lost")}));
    EXPECT_EQ(shown("Agents"), (QStringList{"arm", "robot", "mill"})) << "a person uses it";
}

TEST_F(FirstPage, LeavesARowWhereAFaultIsOverWhileItHasTheKeyboard) {
    show(frameOf({robot.now()}));
    QApplication::setActiveWindow(&view);
    table("What is wrong").setFocus(Qt::TabFocusReason);
    ASSERT_EQ(shown("What is wrong"), (QStringList{"/b", "/seen"}));
    EXPECT_EQ(table("What is wrong").selectedItems().size(), 1) << "it is seen what Enter opens";
    robot.put("/b", "state", std::int64_t{0});
    robot.put("/seen", "level", 0.5);
    show(frameOf({robot.now()}));
    EXPECT_EQ(shown("What is wrong"), (QStringList{"/b", "/seen"}));
    EXPECT_EQ(shown("What is wrong", 1), (QStringList{"It is over.", "It is over."}));
    show(frameOf({robot.now("lost")}));
    EXPECT_EQ(shown("What is wrong", 1).front(), "Its agent is not heard.");
    table("What is wrong").clearFocus();
    show(frameOf({robot.now()}));
    EXPECT_FALSE(table("What is wrong").isVisible());
}

TEST_F(FirstPage, FollowsTheNewestEventUntilSomebodyLooksAtThem) {
    auto& last = table("Last commands and losses");
    for (std::uint64_t i = 1; i <= 30; ++i) events.add({commandOf(i, "desk: a(): Done")});
    show(frameOf({arm.now()}));
    const auto* bar = last.verticalScrollBar();
    ASSERT_GT(bar->maximum(), 0);
    EXPECT_EQ(bar->value(), bar->maximum());
    last.setAttribute(Qt::WA_UnderMouse);
    const int before = bar->value();
    events.add({commandOf(31, "desk: newest(): Done")});
    show(frameOf({arm.now()}));
    EXPECT_EQ(bar->value(), before);
    EXPECT_EQ(last.topLevelItemCount(), 21);
    last.setAttribute(Qt::WA_UnderMouse, false);
    show(frameOf({arm.now()}));
    EXPECT_EQ(bar->value(), bar->maximum());
    EXPECT_EQ(last.topLevelItemCount(), 20);
}

TEST_F(FirstPage, IsOneColumnThatScrollsWhereThereIsLittleRoom) {
    show(frameOf({robot.now()}));
    EXPECT_GT(table("Who controls what").parentWidget()->parentWidget()->y(), 0);
    const auto left = [&](const char* name) { return table(name).mapTo(&view, QPoint{}).x(); };
    EXPECT_LT(left("Agents"), left("What is wrong"));
    view.resize(700, 300);
    QApplication::processEvents();
    EXPECT_EQ(left("Agents"), left("What is wrong"));
    const auto* area = view.findChild<QScrollArea*>();
    EXPECT_GT(area->verticalScrollBar()->maximum(), 0);
    for (auto* each : view.findChildren<OverviewPart*>())
        EXPECT_GE(each->height(), each->minimumHeight());
    EXPECT_EQ(area->verticalScrollBar()->value(), 0);
    events.add({commandOf(1, "desk: a(): Done")});
    show(frameOf({robot.now()}));
    QApplication::setActiveWindow(&view);
    table("Last commands and losses").setFocus(Qt::TabFocusReason);
    EXPECT_GT(area->verticalScrollBar()->value(), 0) << "what has the keyboard is in sight";
}

TEST_F(FirstPage, ShowsHostileTextsAsPlainText) {
    const std::string path = "/<b>x</b>", text = "a\nb\x01 <i>" + std::string(10'000, 'x');
    events.add({eventOf(1, "command", path, text), eventOf(2, "loss", "", "\xe2\x80\xae<b>")});
    show(frameOf({robot.now()}));
    EXPECT_EQ(shown("Last commands and losses", 1).front(), "/<b>x</b>");
    EXPECT_FALSE(shown("Last commands and losses", 2).front().contains('\n'));
}

}  // namespace
}  // namespace cortex::test
