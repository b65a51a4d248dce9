// SPDX-License-Identifier: Apache-2.0
// What agents kept of the past, among the events of a window and before a fault.
#include "gui/event_views.hpp"
#include "model/event_details.hpp"
#include "model/fault_history.hpp"
#include "model/past_reach.hpp"
#include "model/shown_time.hpp"

#include <QAbstractItemModelTester>
#include <QKeyEvent>

#include <QtTest/QTest>

namespace cortex::test {
namespace {

constexpr std::int64_t millisecond = 1'000'000;  // ns

comms::AgentEvent command(std::uint64_t number, const std::string& text = "started") {
    return eventOf(number, "command", "/drive",
                   "cortex@desk.1-a for alice: startup(): Done in 2 cycles, " + text);
}

// It has no number.
comms::AgentEvent value(std::int64_t milliseconds, const std::string& text) {
    comms::AgentEvent event = eventOf(0, name(EventKind::ValueChange), "/drive", text);
    event.wallClock = milliseconds * millisecond;
    return event;
}

class PastRows : public testing::Test {
protected:
    QStringList texts() {
        QStringList all;
        for (int row = 0; row < shown.rowCount(); ++row)
            all << shown.index(row, EventModel::Text).data().toString();
        return all;
    }
    std::vector<std::int64_t> times() {  // ms
        std::vector<std::int64_t> all;
        for (int row = 0; row < shown.rowCount(); ++row)
            all.push_back(shown.at(row).event.wallClock / millisecond);
        return all;
    }

    EventModel events{100};
    EventFilter shown{events};
    QAbstractItemModelTester tester{&shown, QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(PastRows, StandWhereTheyBelongInTimeWithoutAGap) {
    events.add({eventOf(20, "limit", "/a", "one"), eventOf(21, "message", "/a", "two")});
    comms::AgentEvent station = command(3);
    station.agent = "station";
    station.wallClock = 20 * millisecond + 1;
    events.addPast({command(7), station, value(5, "position above its limit")});
    EXPECT_EQ(times(), (std::vector<std::int64_t>{5, 7, 20, 20, 21}));
    EXPECT_EQ(texts().filter("did not come").size(), 0) << "memory has no chatter";
    EXPECT_EQ(shown.at(3).event.agent, "station");
    events.add({eventOf(22, "message", "/a", "three")});
    EXPECT_EQ(times().back(), 22);
}

TEST_F(PastRows, AreOneRowEachHoweverAndHoweverOftenTheyCame) {
    events.add(
        {command(9), eventOf(10, "refusal", "/a", "no 1"), eventOf(11, "refusal", "/a", "no 2")});
    const std::vector<comms::AgentEvent> past{value(5, "x"), command(8),
                                              command(9),    eventOf(11, "refusal", "/a", "no 2"),
                                              command(12),   command(12)};
    events.addPast(past);
    events.addPast(past);
    events.add({command(12), eventOf(13, "message", "/a", "live again")});
    EXPECT_EQ(times(), (std::vector<std::int64_t>{5, 8, 9, 10, 12, 13}));
    EXPECT_EQ(events.count(), 7U);
    comms::AgentEvent anew = command(8);
    anew.epoch = 2;
    events.addPast({anew, value(5, "y")});
    EXPECT_EQ(shown.rowCount(), 8) << "another start, and another value, are others";
}

TEST_F(PastRows, WhatIsKeptOutlastsChatter) {
    events.add({command(1)});
    for (std::uint64_t number = 2; number < 500; ++number)
        events.add({eventOf(number, "message", "/a", "chatter of a" + std::to_string(number))});
    EXPECT_EQ(shown.at(0).event.number, 1U);
    EXPECT_EQ(shown.at(shown.rowCount() - 1).event.number, 499U);
    EXPECT_LE(shown.rowCount(), 100);
    EXPECT_GE(shown.rowCount(), 80);
    EXPECT_EQ(events.count() - events.dropped(), shown.counts().shown);
    events.addPast(changes(1'000, 300));
    EXPECT_LE(shown.rowCount(), 100) << "not without an end";
    EXPECT_EQ(events.count() - events.dropped(), shown.counts().shown);
}

TEST_F(PastRows, ARowThatIsOpenStaysOpenAndAFilterIsKept) {
    events.add({limit(20, "limited to 1"), limit(21, "limited to 2"), command(22)});
    shown.open(shown.serial(0));
    ASSERT_EQ(shown.rowCount(), 4);
    events.addPast({command(5)});
    ASSERT_EQ(shown.rowCount(), 5);
    EXPECT_TRUE(shown.isMember(2));
    events.add({limit(23, "limited to 3")});
    EXPECT_EQ(shown.rowCount(), 6) << "it goes on to grow";
    shown.search("kind:limit");
    events.addPast({command(6)});
    EXPECT_EQ(shown.rowCount(), 4);
    EXPECT_EQ(shown.counts().shown, 3U);
}

TEST_F(PastRows, SayOnWhoseBehalfFirst) {
    events.addPast({command(1),
                    eventOf(2, "control", "/robot",
                            "3 times within a second: cortex@desk.1-a for alice: "
                            "takeControl(prefix=/): Done in 1 cycle"),
                    eventOf(3, "refusal", "/a", "x for y (z@admin: jog(): Rejected (state)"),
                    eventOf(4, "command", "/a", "desk: jogged(): Done"),
                    eventOf(5, "control", "/robot",
                            "cortex@desk.1-a for alice no longer has control of /: it is gone")});
    EXPECT_EQ(texts()[4], "alice (cortex@desk.1-a) no longer has control of /: it is gone");
    EXPECT_EQ(texts()[0], "alice (cortex@desk.1-a): startup(): Done in 2 cycles, started");
    EXPECT_EQ(texts()[1],
              "3 times within a second: alice (cortex@desk.1-a): takeControl(prefix=/): Done in 1 "
              "cycle");
    EXPECT_EQ(texts()[2], "x for y (z@admin: jog(): Rejected (state)")
        << "brackets could stand for another tool";
    EXPECT_EQ(texts()[3], "desk: jogged(): Done");
    const EventDetails details = detailsOf(shown.at(1));
    const auto has = [&](const char* title, const char* text) {
        return std::ranges::count(details, std::pair{QString{title}, QString{text}}) == 1;
    };
    EXPECT_TRUE(has("on behalf of", "alice"));
    EXPECT_TRUE(has("sender", "cortex@desk.1-a"));
    EXPECT_TRUE(has("command", "takeControl(prefix=/)"));
}

TEST_F(PastRows, AnyTextIsARow) {
    events.add({eventOf(50, "message", "/a", "now")});
    const std::string longest(10'000, 'x');
    events.addPast({value(1, "<b>bold</b>"), value(1, "\x1b[31m\n\xff"), value(2, longest),
                    eventOf(3, "command", "/\xe2\x80\xae" + longest, "\xe2\x80\xae: (): ")});
    ASSERT_EQ(shown.rowCount(), 5);
    for (const QString& each : texts())
        EXPECT_FALSE(each.contains('\n') || each.contains(QChar{27}));
    EXPECT_TRUE(texts().contains("<b>bold</b>"));
}

TEST_F(Events, NoRowThatIsLookedAtMovesWhenThePastComes) {
    events.add(changes(1'000, 200));
    ASSERT_TRUE(isAtTheEnd(rows()));
    rows().verticalScrollBar()->triggerAction(QScrollBar::SliderToMinimum);
    rows().verticalScrollBar()->triggerAction(QScrollBar::SliderSingleStepAdd);
    rows().setCurrentIndex(rows().model()->index(3, 0));
    QApplication::processEvents();
    const auto path = [&](int y) {
        QApplication::processEvents();
        return rows().indexAt({10, y}).siblingAtColumn(EventModel::Path).data().toString();
    };
    const QString top = path(0), selected = "/drives/1003";
    ASSERT_EQ(top, "/drives/1001");
    events.addPast(changes(1, 50));
    EXPECT_EQ(path(0), top);
    EXPECT_EQ(rows().currentIndex().siblingAtColumn(EventModel::Path).data(), selected);
    ASSERT_EQ(shown.rowCount(), 250);
    rows().follow();
    const QString newest = path(rows().viewport()->height() - 30);
    events.addPast(changes(100, 50));
    EXPECT_EQ(path(rows().viewport()->height() - 30), newest);
    EXPECT_TRUE(isAtTheEnd(rows()));
}

TEST_F(Events, UnderThePointerNothingMovesWhenThePastComes) {
    events.add(changes(1'000, 200));
    ASSERT_TRUE(isAtTheEnd(rows()));
    QTest::mouseMove(rows().viewport(), {50, 40});
    QEvent enter{QEvent::Enter};
    QApplication::sendEvent(rows().window(), &enter);
    events.add(changes(1'200, 3));
    const auto underPointer = [&] {
        QApplication::processEvents();
        const QPoint at = rows().viewport()->mapFromGlobal(QCursor::pos());
        return rows().indexAt(at).siblingAtColumn(EventModel::Path).data().toString();
    };
    const QString path = underPointer();
    ASSERT_FALSE(path.isEmpty());
    events.addPast(changes(1, 50));
    EXPECT_EQ(underPointer(), path);
}

TEST_F(EventTab, TheRowOfAFaultOpensWhatWasBeforeItByKeyAndByButton) {
    events.add({eventOf(1, "fault", "/drive", "fault 7: broken", Severity::Error),
                eventOf(2, "message", "/drive", "all else")});
    std::vector<std::uint64_t> faults;
    std::vector<std::string> paths;
    for (auto* each : {&view}) {
        QObject::connect(each, &EventView::beforeWanted,
                         [&](const comms::AgentEvent& fault) { faults.push_back(fault.number); });
        QObject::connect(each, &EventView::opened,
                         [&](const std::string& path) { paths.push_back(path); });
    }
    QObject::connect(&list, &EventList::beforeWanted,
                     [&](const comms::AgentEvent& fault) { faults.push_back(fault.number); });
    QKeyEvent enter{QEvent::KeyPress, Qt::Key_Return, Qt::NoModifier};
    for (EventTable* each : {&table(), &rows()}) {
        each->setCurrentIndex(each->model()->index(0, 0));
        QApplication::sendEvent(each, &enter);
    }
    view.refresh();
    ASSERT_NE(button("Ten seconds before"), nullptr);
    button("Ten seconds before")->click();
    ASSERT_NE(buttonIn(list, "Ten seconds before"), nullptr);
    const QRect place = buttonIn(list, "Ten seconds before")->geometry();
    buttonIn(list, "Ten seconds before")->click();
    EXPECT_EQ(faults, (std::vector<std::uint64_t>{1, 1, 1, 1}));
    for (EventTable* each : {&table(), &rows()}) each->setCurrentIndex(each->model()->index(1, 0));
    view.refresh();
    EXPECT_EQ(button("Ten seconds before"), nullptr);
    EXPECT_EQ(buttonIn(list, "Ten seconds before"), nullptr);
    QApplication::sendEvent(&table(), &enter);
    EXPECT_EQ(paths, std::vector<std::string>{"/drive"});
    rows().setCurrentIndex(rows().model()->index(0, 0));
    EXPECT_EQ(buttonIn(list, "Ten seconds before")->geometry(), place) << "its place is kept";
}

class BeforeAFault : public testing::Test {
protected:
    BeforeAFault() { fault.wallClock = 60'000 * millisecond; }
    comms::AgentEvent at(std::int64_t milliseconds, comms::AgentEvent event) const {
        event.wallClock = milliseconds * millisecond;
        return event;
    }
    std::vector<std::string> lines(const FaultHistory& history) const {
        std::vector<std::string> all;
        for (const EventRow& each : history.rows())
            all.push_back((history.secondsOf(each) + ' ' + each.text()).toStdString());
        return all;
    }

    comms::AgentEvent fault = eventOf(90, "fault", "/drive", "fault 7: broken", Severity::Error);
    EventModel events;
};

TEST_F(BeforeAFault, StandsWhatAllAgentsSayOfTenSecondsOnceAndInOrder) {
    comms::AgentEvent station = at(59'999, eventOf(5, "loss", "/station", "agent robot lost"));
    station.agent = "station";
    events.add({at(40'000, command(70)), at(57'690, command(80)), at(59'000, limit(81, "at 1")),
                at(59'500, limit(82, "at 2")), fault,
                at(60'001, eventOf(91, "message", "/a", "after it"))});
    FaultHistory history{fault};
    history.show(events, {value(57'690, "velocity"), at(57'690, command(80)), station,
                          at(50'000, command(75, "first")), at(49'999, command(74, "too old")),
                          at(60'000, eventOf(89, "state change", "/b", "Active -> Fault")), fault});
    EXPECT_EQ(lines(history),
              (std::vector<std::string>{
                  "−10.000 s alice (cortex@desk.1-a): startup(): Done in 2 cycles, first",
                  "−2.310 s velocity",
                  "−2.310 s alice (cortex@desk.1-a): startup(): Done in 2 cycles, started",
                  "−1.000 s at 1 … 2", "−0.001 s agent robot lost", "0.000 s Active -> Fault",
                  "0.000 s fault 7: broken"}));
    EXPECT_EQ(history.rows()[3].times, 2U);
    history.show(events, {value(57'690, "velocity"), value(57'690, "velocity")});
    EXPECT_EQ(history.rows().size(), 4U) << "in place of what it had: " << lines(history).size();
}

TEST_F(BeforeAFault, TheNewestStayWhereThereAreTooMany) {
    std::vector<comms::AgentEvent> all;
    for (std::uint64_t i = 0; i < FaultHistory::most + 10; ++i)
        all.push_back(at(55'000 + static_cast<std::int64_t>(i), changes(1'000 + i, 1).front()));
    FaultHistory history{fault};
    history.show(events, all);
    EXPECT_EQ(history.rows().size(), FaultHistory::most);
    EXPECT_EQ(history.left(), 11U);
    EXPECT_EQ(history.rows().back().event.number, 90U);
    EXPECT_EQ(history.rows().front().event.number, 1'011U);
}

TEST_F(BeforeAFault, IsTheSameAfterALayoutHadIt) {
    fault.epoch = 1'764'400'000'123'457;
    fault.text = "<b>\n\xe2\x80\xae";
    const FaultHistory history{fault};
    const FaultHistory again{FaultHistory::restored(history.saved())};
    EXPECT_EQ(again.saved(), history.saved());
    EXPECT_EQ(again.fault().wallClock, fault.wallClock);
    EXPECT_EQ(again.fault().epoch, fault.epoch);
    EXPECT_EQ(again.fault().number, fault.number);
    EXPECT_EQ(history.title(), "Before the fault of /drive at 00:01:00 UTC");
    const FaultHistory nothing{FaultHistory::restored({})};
    EXPECT_FALSE(nothing.title().isEmpty()) << "a file of somebody else";
}

TEST(PastReachText, SaysWhoseMemoryDoesNotReachBackAndWhoHasNone) {
    constexpr std::int64_t aSecond = 1'000'000'000, from = 1'764'410'000 * aSecond;
    const PastReach whole{"whole", 0, true, false, "", {{"command", from - 1}, {"fault", from}}};
    const PastReach some{"robot", 0,  true,
                         false,   "", {{"command", from + 60 * aSecond}, {"fault", from}}};
    const PastReach old{"zoo", 0, false, false, "it was built before agents kept a memory", {}};
    const PastReach gone{"table\n\xe2\x80\xae", 0, true, false, "it is not heard", {}};
    PastReach asking;
    asking.agent = "late";
    EXPECT_EQ(reachText({}, from), "");
    EXPECT_EQ(reachText({whole}, from),
              "All agents keep what happened since 2025-11-29 09:53:20 UTC.");
    EXPECT_EQ(
        reachText({whole, some}, from),
        "robot: commands are kept since 2025-11-29 09:54:20.000 UTC; older ones are not kept");
    EXPECT_EQ(reachText({whole, old, asking}, from),
              "asking late…; zoo: it was built before agents kept a memory: only its last 1,000 "
              "events");
    const QString hostile = reachText({gone}, from);
    EXPECT_TRUE(hostile.endsWith(": it is not heard")) << hostile.toStdString();
    EXPECT_FALSE(hostile.contains('\n') || hostile.contains(QChar{0x202e}));
    const QString many = reachText(std::vector<PastReach>(100, old), from);
    EXPECT_TRUE(many.endsWith("; 88 more agents")) << many.toStdString();
    EXPECT_EQ(reachText(std::vector<PastReach>(100, asking), from), "asking 100 agents…");
}

}  // namespace
}  // namespace cortex::test
