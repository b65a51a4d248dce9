// SPDX-License-Identifier: Apache-2.0
// Which events are one row, and which rows are shown.
#include "gui/events_fixture.hpp"
#include "model/event_details.hpp"
#include "support/share.hpp"

#include <QAbstractItemModelTester>
#include <clocale>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

constexpr std::int64_t second = 1'000'000'000;  // ns

class EventRows : public testing::Test {
protected:
    QString text(int row) { return shown.index(row, EventModel::Text).data().toString(); }
    QString times(int row) { return shown.index(row, EventModel::Times).data().toString(); }
    int hits(const QString& filter) {
        shown.search(filter);
        return shown.rowCount();
    }

    EventModel events{share(EventModel{}.kept())};
    EventFilter shown{events};
    QAbstractItemModelTester tester{&shown, QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(EventRows, TheSameWithOtherNumbersIsOneRowWithTheirRange) {
    events.add({limit(1, "position limited from -2.1187 to -2.0944 rad")});
    events.add({eventOf(2, "message", "/b", "something else")});
    events.add({limit(3, "position limited from -2.0951 to -2.0944 rad"),
                limit(4, "position limited from -2.1 to -2.0944 rad")});
    ASSERT_EQ(shown.rowCount(), 2);
    EXPECT_EQ(text(0), QString::fromUtf8("position limited from −2.1187 … −2.0951 to -2.0944 rad"));
    EXPECT_EQ(times(0), QString::fromUtf8("×3"));
    EXPECT_EQ(shown.index(0, EventModel::Time).data(), "00:00:00.001") << "of the first";
    EXPECT_EQ(times(1), "");
}

TEST_F(EventRows, HaveTheSameRangeInEveryLocale) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    (void)std::setlocale(LC_ALL, "de_DE.UTF-8");  // where it is installed
    events.add({limit(1, "limited from 2.7 to 1"), limit(2, "limited from 2.25 to 1")});
    std::setlocale(LC_ALL, before.c_str());
    EXPECT_EQ(text(0), QString::fromUtf8("limited from 2.25 … 2.7 to 1"));
}

TEST_F(EventRows, AreTheirOwnAfterTenSecondsAndAtAnotherSeverity) {
    comms::AgentEvent late = limit(3, "limited to 3");
    late.wallClock = 11 * second;
    comms::AgentEvent later = limit(4, "limited to 4");
    later.wallClock = 12 * second;
    events.add({limit(1, "limited to 1"), limit(2, "limited to 2", Severity::Info), late, later});
    ASSERT_EQ(shown.rowCount(), 3);
    EXPECT_EQ(times(2), QString::fromUtf8("×2"));
}

TEST_F(EventRows, ChangesOfStateFaultsCommandsAndLossesAreNeverOne) {
    for (const char* kind : {"state change", "fault", "command", "control", "loss"}) {
        events.add({eventOf(events.count() + 1, kind, "/a", "the same"),
                    eventOf(events.count() + 2, kind, "/a", "the same")});
    }
    EXPECT_EQ(shown.rowCount(), 10);
}

TEST_F(EventRows, NumbersOfNamesAreNoNumbers) {
    events.add({eventOf(1, "message", "/a", "input from /drives/4 is bad"),
                eventOf(2, "message", "/a", "input from /drives/5 is bad"),
                eventOf(3, "message", "/a", "code 0x8611"),
                eventOf(4, "message", "/a", "code 0x8612"), eventOf(5, "message", "/a", "axis A4"),
                eventOf(6, "message", "/a", "axis A5")});
    EXPECT_EQ(shown.rowCount(), 6);
    const NumberedText some = numberedText("1 of -2.5e-3 m, at 7.");
    EXPECT_EQ(some.numbers, (std::vector<std::string>{"1", "-2.5e-3", "7"}));
}

TEST_F(EventRows, WhatTheWindowSaysOfAnAgentHasNoNumberThatCouldBeMissing) {
    const comms::AgentEvent restarted = eventOf(0, "loss", "/robot", "agent restarted");
    events.add({restarted, limit(500, "first that came")});
    EXPECT_EQ(shown.rowCount(), 2);
    EXPECT_EQ(text(0), "agent restarted");
}

TEST_F(EventRows, NumbersOfAnAgentThatAreMissingAreARow) {
    events.add({limit(1, "a"), limit(9, "b")});
    ASSERT_EQ(shown.rowCount(), 3);
    EXPECT_EQ(text(1), "7 events of robot did not come");
    EXPECT_EQ(shown.index(1, EventModel::SeverityColumn).data(), "missing");
    EXPECT_EQ(shown.index(1, EventModel::Time).data(), "00:00:00.001") << "after the one before";
    comms::AgentEvent anew = limit(5, "c");
    anew.epoch = 2;
    events.add({anew, limit(10, "d")});
    EXPECT_EQ(shown.rowCount(), 5) << "another start counts for itself";
    shown.showSeverity(Severity::Warning, false);
    EXPECT_EQ(shown.rowCount(), 1) << "what is missing is not hidden";
}

TEST_F(EventRows, AreFoundByTheGrammarOfTheTree) {
    events.add(changes(1, 3));
    events.add({limit(4, "position limited"),
                eventOf(5, "fault", "/drives/1", "Fault 0x8611", Severity::Error)});
    EXPECT_EQ(hits(""), 5);
    EXPECT_EQ(hits("in:/drives"), 4);
    EXPECT_EQ(hits("-in:/drives"), 1);
    EXPECT_EQ(hits("severity:error or kind:limit"), 2);
    EXPECT_EQ(hits("kind:\"state change\" path:2"), 1);
    EXPECT_EQ(hits("agent:robot FAULT"), 1);
    EXPECT_EQ(hits("agent:nobody"), 0);
    EXPECT_EQ(hits("text:limited"), 1);
    EXPECT_EQ(hits("kinds:limit"), 0);
    EXPECT_TRUE(events.query().trouble().contains("kind")) << "the nearest name";
}

TEST_F(EventRows, JogCommandsAreHiddenFromTheStart) {
    events.add({eventOf(1, "command", "/jog", "desk: jog(axis=1, velocity=0.1): Done in 1 cycle"),
                eventOf(2, "command", "/jog", "desk: set(holdTime=0.2): Done in 1 cycle")});
    EXPECT_EQ(shown.rowCount(), 1);
    EXPECT_EQ(shown.counts().routine, 1U);
    shown.showRoutine(true);
    EXPECT_EQ(shown.rowCount(), 2);
}

TEST_F(EventRows, JogCommandsAreShownWhileTheWordsNameThem) {
    events.add({eventOf(1, "command", "/jog", "desk: jog(axis=1, velocity=0.1): Done in 1 cycle")});
    for (const char* each : {"kind:command", "jog", "in:/jog text:jog", "fault or kind:Command"}) {
        shown.search(each);
        EXPECT_TRUE(shown.showsRoutine()) << each;
        EXPECT_EQ(shown.rowCount(), 1) << each;
        shown.search("desk -kind:limit");
        EXPECT_FALSE(shown.showsRoutine()) << "as before " << each;
    }
    shown.search("jog");
    shown.showRoutine(false);
    EXPECT_EQ(shown.rowCount(), 0) << "the chip is the person's";
    shown.showRoutine(true);
    shown.search("desk");
    EXPECT_EQ(shown.rowCount(), 1);
}

TEST_F(EventRows, ARowKeepsNoMoreThanThousandOfItsEventsAndCountsAll) {
    for (std::uint64_t i = 1; i <= 2'000; ++i) events.add({limit(i, "at " + std::to_string(i))});
    ASSERT_EQ(shown.rowCount(), 1);
    EXPECT_EQ(times(0), QString::fromUtf8("×2,000"));
    EXPECT_EQ(text(0), QString::fromUtf8("at 1 … 2000"));
    EXPECT_EQ(events.at(0).others.size(), EventRow::mostOthers);
    EXPECT_EQ(events.dropped(), 0U);
}

TEST_F(EventRows, ThatCameLateSaySo) {
    comms::AgentEvent late = eventOf(5, "message", "/b", "it was before");
    late.agent = "left";
    events.add({eventOf(10, "message", "/a", "first that came")});
    events.add({late});
    events.add({eventOf(11, "message", "/a", "in order again")});
    const auto time = [this](int row) { return shown.index(row, EventModel::Time).data(); };
    EXPECT_EQ(time(0), "00:00:00.010");
    EXPECT_EQ(time(1), QString::fromUtf8("↑00:00:00.005"));
    EXPECT_EQ(shown.index(1, EventModel::Time).data(Qt::AccessibleTextRole),
              "00:00:00.005, came late");
    EXPECT_EQ(time(2), "00:00:00.011");
}

TEST_F(EventRows, ARowOfManyOpensToEachOfThem) {
    events.add({limit(1, "limited to 1"), limit(2, "limited to 2"),
                eventOf(3, "message", "/b", "something else")});
    ASSERT_EQ(shown.rowCount(), 2);
    shown.open(shown.serial(1));
    EXPECT_EQ(shown.rowCount(), 2) << "that is one event";
    shown.open(shown.serial(0));
    ASSERT_EQ(shown.rowCount(), 4);
    EXPECT_EQ(text(1).trimmed(), "limited to 1");
    EXPECT_EQ(text(2).trimmed(), "limited to 2");
    EXPECT_EQ(shown.index(2, EventModel::Time).data(), "00:00:00.002");
    EXPECT_EQ(text(3), "something else");
    events.add({limit(4, "limited to 4"), eventOf(5, "message", "/c", "one more")});
    ASSERT_EQ(shown.rowCount(), 6);
    EXPECT_EQ(text(3).trimmed(), "limited to 4");
    EXPECT_EQ(text(5), "one more");
    EXPECT_EQ(shown.rowOf(shown.serial(5)), 5);
    shown.search("severity:warning");
    EXPECT_EQ(shown.rowCount(), 4) << "it stays open";
    shown.search("severity:info");
    EXPECT_EQ(shown.rowCount(), 2);
    shown.search("");
    EXPECT_EQ(shown.rowCount(), 3);
    shown.open(shown.serial(0));
    events.add(changes(6, events.kept()));
    EXPECT_FALSE(shown.isMember(0)) << "it dropped out";
}

TEST_F(EventRows, TheDetailsOfACommandNameItsParts) {
    const EventDetails details = detailsOf(EventRow{eventOf(
        1, "command", "/a", "cortex@desk.4711: moveTo(speedShare=0.25): Done in 3912 cycles")});
    const auto has = [&](const char* title, const char* value) {
        return std::ranges::find(details, std::pair{QString{title}, QString{value}}) !=
               details.end();
    };
    EXPECT_TRUE(has("sender", "cortex@desk.4711"));
    EXPECT_TRUE(has("command", "moveTo(speedShare=0.25)"));
    EXPECT_TRUE(has("outcome", "Done"));
    EXPECT_TRUE(has("latency", "3912 cycles"));
}

TEST_F(EventRows, APathThatIsCutIsWholeInItsTooltip) {
    events.add({limit(1, "position limited")});
    EXPECT_EQ(shown.index(0, EventModel::Path).data(Qt::ToolTipRole), "/arm/demands/4");
    EXPECT_EQ(shown.index(0, EventModel::Text).data(Qt::ToolTipRole), "position limited");
}

TEST_F(EventRows, AnyTextIsARow) {
    events.add({limit(1, ""), limit(2, "-"), limit(3, "1e"),
                limit(4, std::string("\x01 1 \n \xff", 7)),
                limit(5, "999999999999999999999999e999"), limit(6, "<b>bold</b>")});
    events.add({limit(7, std::string("\x01 2 \n \xff", 7)), limit(8, "1e999"), limit(9, "2e999")});
    for (int row = 0; row < shown.rowCount(); ++row) {
        EXPECT_FALSE(text(row).contains('\n'));
        EXPECT_FALSE(text(row).contains(QChar{1}));
    }
}

}  // namespace
}  // namespace cortex::test
