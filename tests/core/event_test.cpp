// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/event.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/event_sinks.hpp"

#include "core/model_folder.hpp"
#include "support/small_structure.hpp"

#include <clocale>
#include <filesystem>
#include <fstream>
#include <locale>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

Event eventAt(std::int64_t cycle, std::uint32_t order, std::uint32_t sequence) {
    Event event;
    event.cycle = cycle;
    event.time = cycle * 1'000'000;
    event.order = order;
    event.sequence = sequence;
    event.text << cycle << "." << std::int64_t{order} << "." << std::int64_t{sequence};
    return event;
}

class EventLogTest : public ::testing::Test {
protected:
    EventLogTest() {
        log.addSink([this](const Event& event, const Structure&) {
            if (!texts.empty()) texts += ' ';
            texts += event.text.view();
            numbers.push_back(event.number);
            repeatable.push_back(event.repeatable);
        });
    }

    std::shared_ptr<const Structure> structure = test::makePlant().structure;
    EventLog log{structure, 3, 4};
    std::string texts;
    std::vector<std::uint64_t> numbers, repeatable;
};

TEST_F(EventLogTest, MergesByCycleOrderAndSequenceWhateverTheRing) {
    log.ring(2).post(eventAt(1, 1, 0));
    log.ring(2).post(eventAt(2, 0, 1));
    log.ring(0).post(eventAt(1, 2, 0));
    log.ring(1).post(eventAt(1, 0, 3));
    log.ring(1).post(eventAt(1, 0, 2));
    log.complete(2);
    log.flush();

    EXPECT_EQ(texts, "1.0.2 1.0.3 1.1.0 1.2.0 2.0.1");
    EXPECT_EQ(numbers, (std::vector<std::uint64_t>{1, 2, 3, 4, 5}));
}

TEST_F(EventLogTest, DatesEventsByTheClockAndNotByNominalTime) {
    std::vector<std::int64_t> dates;
    log.addSink([&](const Event& event, const Structure&) { dates.push_back(event.wallClock); });
    Event first = eventAt(1, 0, 0);
    first.clock = 5'000'000'000;
    Event second = eventAt(1, 1, 0);
    second.clock = first.clock + 1'400'000'000;
    log.ring(0).post(first);
    log.ring(0).post(second);
    log.complete(1);
    log.postOutside(eventAt(1, 2, 0));
    log.flush();

    ASSERT_EQ(dates.size(), 3U);
    EXPECT_EQ(dates[1] - dates[0], 1'400'000'000);
    EXPECT_GT(dates[2], structure->epoch * 1000 + eventAt(1, 2, 0).time) << "dated by nominal time";
}

TEST_F(EventLogTest, LetsTheOrderOfTheRingsDecideAtLast) {
    Event first = eventAt(1, 1, 0);
    first.text = "loop";
    Event second = eventAt(1, 1, 0);
    second.text = "worker";
    log.ring(1).post(second);
    log.ring(0).post(first);
    log.complete(1);
    log.flush();

    EXPECT_EQ(texts, "loop worker");
}

TEST_F(EventLogTest, WaitsUntilACycleIsComplete) {
    log.ring(0).post(eventAt(1, 5, 0));
    log.ring(0).post(eventAt(2, 0, 0));
    log.flush();
    EXPECT_EQ(texts, "");
    log.complete(1);
    log.flush();
    EXPECT_EQ(texts, "1.5.0");
    log.ring(1).post(eventAt(2, 1, 0));
    log.complete(2);
    log.flush();
    EXPECT_EQ(texts, "1.5.0 2.0.0 2.1.0");
}

TEST_F(EventLogTest, HandsOutWhatIsLeftWhenItStops) {
    log.start();
    log.ring(0).post(eventAt(7, 0, 0));
    log.stop();
    EXPECT_EQ(texts, "7.0.0");
    log.stop();
    EXPECT_EQ(texts, "7.0.0");
    log.start();
    log.ring(0).post(eventAt(8, 0, 0));
    log.stop();
    EXPECT_EQ(texts, "7.0.0 8.0.0");
}

TEST_F(EventLogTest, CountsWhatAFullRingDroppedAndSaysSo) {
    for (std::uint32_t i = 0; i < 6; ++i) log.ring(0).post(eventAt(1, 0, i));
    log.ring(1).post(eventAt(1, 1, 0));
    log.complete(1);
    log.flush();

    EXPECT_EQ(log.dropped(), 3U);
    EXPECT_EQ(texts,
              "1.0.0 1.0.1 1.0.2 1.1.0 "
              "3 events dropped: more were posted than their ring holds");

    texts.clear();
    log.ring(0).post(eventAt(2, 0, 0));
    log.complete(2);
    log.flush();
    EXPECT_EQ(texts, "2.0.0");
}

TEST_F(EventLogTest, KeepsRoomForErrorsThatOthersCannotTake) {
    for (std::uint32_t i = 0; i < 100; ++i) log.ring(0).post(eventAt(1, 0, i));
    Event fault = eventAt(1, 0, 100);
    fault.severity = Severity::Error;
    log.ring(0).post(fault);
    log.complete(1);
    log.flush();

    EXPECT_TRUE(texts.starts_with("1.0.0 1.0.1 1.0.2 1.0.100 97 events dropped")) << texts;
}

TEST_F(EventLogTest, HandsRepeatsToThoseThatAskForThemOnly) {
    std::vector<std::uint64_t> folded;
    log.addSink([&](const Event& event, const Structure&) { folded.push_back(event.number); },
                EventLog::Repeats::Folded);
    for (std::uint32_t i = 0; i < 3; ++i) log.ring(0).post(eventAt(1, 0, i));
    log.complete(1);
    log.flush();
    EXPECT_EQ(numbers, (std::vector<std::uint64_t>{1, 2, 3}));
    EXPECT_EQ(folded, std::vector<std::uint64_t>{1}) << "the texts differ in numbers alone";

    log.stop();
    EXPECT_EQ(folded, (std::vector<std::uint64_t>{1, 2})) << "numbered without a gap";
}

TEST_F(EventLogTest, NumbersEventsFromOutsideTheCyclesToo) {
    log.ring(0).post(eventAt(1, 0, 0));
    log.postOutside(eventAt(0, 9, 9));
    log.complete(1);
    log.flush();

    EXPECT_EQ(texts, "1.0.0 0.9.9");
    EXPECT_EQ(numbers, (std::vector<std::uint64_t>{1, 2}));
}

TEST_F(EventLogTest, PutsEventsFromOutsideTheCyclesWhereTheirTimeIs) {
    const auto at = [](std::int64_t cycle, std::uint32_t order, std::int64_t clock) {
        Event event = eventAt(cycle, order, 0);
        event.clock = clock;
        return event;
    };
    log.ring(0).post(at(1, 0, 200));
    log.ring(0).post(at(2, 0, 400));
    log.ring(1).post(at(2, 1, 390));  // its thread began a little earlier
    for (const std::int64_t clock : {100, 300, 500}) log.postOutside(at(0, 9, clock));
    log.complete(2);
    log.flush();

    EXPECT_EQ(texts, "0.9.0 1.0.0 0.9.0 2.0.0 2.1.0 0.9.0");
    EXPECT_EQ(numbers, (std::vector<std::uint64_t>{1, 2, 3, 4, 5, 6}));
}

TEST_F(EventLogTest, NumbersApartWhatTheSameInputDoesNotCauseAgain) {
    Event missed = eventAt(1, 1, 0), hung = eventAt(1, 2, 0);
    missed.kind = EventKind::Overflow;
    hung.kind = EventKind::Watchdog;
    log.ring(0).post(eventAt(1, 0, 0));
    log.ring(0).post(missed);
    log.ring(0).post(hung);
    log.ring(1).post(eventAt(1, 3, 0));
    log.postOutside(eventAt(1, 4, 0));
    log.ring(1).post(eventAt(2, 0, 0));
    log.complete(1);
    log.flush();
    log.complete(2);
    log.flush();

    EXPECT_EQ(numbers, (std::vector<std::uint64_t>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(repeatable, (std::vector<std::uint64_t>{1, 0, 0, 2, 0, 3}));
}

// What each event is called by its number, however many of them a ring has lost.
TEST_F(EventLogTest, NumbersWhatRepeatsAsIfNoneOfItWereLost) {
    const auto numbersOf = [this](std::uint32_t capacity) {
        std::map<std::string, std::uint64_t> seen;
        EventLog some{structure, 2, capacity};
        some.addSink([&](const Event& event, const Structure&) {
            if (event.repeatable != 0) seen[std::string{event.text.view()}] = event.repeatable;
        });
        for (std::int64_t cycle = 1; cycle <= 9; ++cycle) {
            some.ring(0).post(eventAt(cycle, 2, 0));
            Event missed = eventAt(cycle, 1, 1);
            missed.kind = EventKind::Overflow;
            some.ring(0).post(missed);
            for (std::uint32_t i = 0; i < 4; ++i) {
                some.ring(i % 2).post(eventAt(cycle, i % 2, taskSequence + i));
            }
            Event fault = eventAt(cycle, 1, taskSequence + 9);
            fault.severity = Severity::Error;
            some.ring(1).post(fault);
            some.ring(0).post(eventAt(cycle, 1, endSequence));
            some.complete(cycle);
            if (cycle % 3 == 0) some.flush();
        }
        return seen;
    };

    const auto all = numbersOf(1024), some = numbersOf(8);

    EXPECT_EQ(all.size(), 9U * 7U);
    EXPECT_LT(some.size(), all.size());
    EXPECT_GT(some.size(), 20U);
    for (const auto& [text, number] : some) EXPECT_EQ(number, all.at(text)) << text;
}

TEST_F(EventLogTest, LetsASinkPostFromOutside) {
    log.addSink([this](const Event& event, const Structure&) {
        if (event.cycle == 1) log.postOutside(eventAt(0, 0, 0));
    });
    log.ring(0).post(eventAt(1, 0, 0));
    log.complete(1);
    log.flush();
    log.flush();

    EXPECT_EQ(texts, "1.0.0 0.0.0");
}

// Two loop threads post, a third flushes by hand while the log's own thread polls.
TEST(EventLogThreads, HandOutEachEventOnceAndInOrder) {
    constexpr std::int64_t cycles = 2000;
    std::vector<std::int64_t> keys;
    EventLog log{test::makePlant().structure, 2, 2 * cycles};
    log.addSink([&](const Event& event, const Structure&) {
        keys.push_back(event.cycle * 2 + event.order);
        if (event.order == 0 && event.cycle % 500 == 0) log.postOutside(Event{});
    });
    log.start();
    std::atomic<std::int64_t> workerCycle{0}, loopCycle{0};
    std::atomic<bool> done{false};

    std::thread worker{[&] {
        for (std::int64_t cycle = 1; cycle <= cycles; ++cycle) {
            while (loopCycle.load() < cycle) std::this_thread::yield();
            log.ring(1).post(eventAt(cycle, 0, 0));
            workerCycle = cycle;
        }
    }};
    std::thread flusher{[&] {
        while (!done) {
            log.flush();
            std::this_thread::yield();
        }
    }};
    for (std::int64_t cycle = 1; cycle <= cycles; ++cycle) {
        loopCycle = cycle;
        log.ring(0).post(eventAt(cycle, 1, 0));
        while (workerCycle.load() < cycle) std::this_thread::yield();
        log.complete(cycle);
    }
    worker.join();
    done = true;
    flusher.join();
    log.stop();

    std::erase(keys, 0);  // those from outside
    ASSERT_EQ(keys.size(), 2U * cycles);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        ASSERT_EQ(keys[i], static_cast<std::int64_t>(i) + 2);
    }
    EXPECT_EQ(log.dropped(), 0U);
}

TEST(EventRing, HoldsAtLeastOne) {
    EventRing ring{0};
    Event event;
    EXPECT_FALSE(ring.peek(event));
    ring.post(eventAt(3, 0, 0));
    ring.post(eventAt(4, 0, 0));
    EXPECT_FALSE(ring.peek(event)) << "its cycle is not over";
    ring.publish();
    ASSERT_TRUE(ring.peek(event));
    EXPECT_EQ(event.cycle, 3);
    EXPECT_EQ(ring.dropped(), 1U);
}

TEST(EventText, IsBuiltFromWordsAndNumbers) {
    EventText text{"clamped "};
    const char* to = "to ";
    text << to << 2.5 << std::string_view{" of "} << std::int64_t{-3};
    EXPECT_EQ(text.view(), "clamped to 2.5 of -3");
}

TEST(EventText, HasNumbersOfSixDigitsOrWholeOrAsManyAsTellTwoApart) {
    EventText text;
    text << 0.1 + 0.2 << " " << 1.0 / 3 << " " << 1234567.0 << " ";
    text.apart(1.0000001, 1) << " ";
    text.apart(1.0000001, 2);

    EXPECT_EQ(text.view(), "0.3 0.333333 1234567 1.0000001 1");
}

// As many octets as a text has at most.
constexpr std::size_t eventCapacity = 150;

TEST(EventText, HoldsAWholeTextThatJustFits) {
    EventText text;
    for (std::size_t i = 0; i < eventCapacity; ++i) text << "a";
    text << "";
    EXPECT_EQ(text.view(), std::string(eventCapacity, 'a'));
}

TEST(EventText, EndsAtAWordWhereItDoesNotFit) {
    EventText text{"input observation from "};
    text << "/" + std::string(100, 'p') << " was not followed for " << 12.5 << " ms, allowed";
    EXPECT_EQ(text.view(),
              "input observation from /" + std::string(100, 'p') + " was not followed for …");
    text << "3";
    EXPECT_TRUE(text.view().ends_with(" followed for …"))
        << "nothing comes after what was left out";
    EXPECT_EQ(EventText{std::string(eventCapacity, 'a') + " b"}.view(),
              std::string(eventCapacity - 4, 'a') + "…")
        << "a word that is too long";
}

TEST(EventText, IsCutAtACharacter) {
    const auto accents = [](std::size_t count) {
        std::string text;
        for (std::size_t i = 0; i < count; ++i) text += "\u00e9";
        return text;
    };
    EXPECT_EQ(EventText{accents(100)}.view(), accents(73) + "…");
    EXPECT_EQ(EventText{"a" + accents(100)}.view(), "a" + accents(72) + "…");
}

TEST(EventKindName, IsInWords) {
    EXPECT_STREQ(name(EventKind::StateChange), "state change");
    EXPECT_STREQ(name(EventKind::Message), "message");
}

TEST(LineOf, HasTimeSeverityPathAndText) {
    const test::Plant plant = test::makePlant();
    Event event;
    event.simplex = plant.axis;
    event.severity = Severity::Warning;
    event.text << "position clamped to " << 2.96 << " rad";

    EXPECT_EQ(lineOf(event, *plant.structure, 1'795'168'800'123'456'789),
              "2026-11-20T10:00:00.123Z warning /axis position clamped to 2.96 rad");
}

TEST(LineOf, NamesTheAgentWhereNoSimplexIsMeant) {
    EXPECT_EQ(lineOf(Event{}, *test::makePlant().structure, 0),
              "1970-01-01T00:00:00.000Z info /robot ");
}

TEST(LineOf, StaysOneLine) {
    Event event;
    event.text = "a\nb\tc\x7f\xff";
    EXPECT_EQ(lineOf(event, *test::makePlant().structure, 0),
              "1970-01-01T00:00:00.000Z info /robot a\\x0ab\\x09c\\x7f\\xff");
}

struct CommaNumbers : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

TEST(EventSinks, PrintTheSameInEveryLocale) {
    const std::locale before =
        std::locale::global(std::locale{std::locale::classic(), new CommaNumbers});
    (void)std::setlocale(LC_ALL, "de_DE.UTF-8");
    EventLog log{test::makePlant().structure, 1, 4};
    std::ostringstream out;
    log.addSink(printEvents(out));

    Event event = eventAt(123456, 0, 0);
    event.text = "at ";
    event.text << 1234.5;
    log.ring(0).post(event);
    log.complete(123456);
    log.flush();
    (void)std::setlocale(LC_ALL, "C");
    std::locale::global(before);

    EXPECT_EQ(out.str(), "1970-01-01T00:02:03.456Z info /robot at 1234.5\n");
}

TEST(EventSinks, AppendToALogFile) {
    const test::ModelFolder folder;
    const auto file = folder.path() / "log";
    for (std::int64_t cycle = 1; cycle <= 2; ++cycle) {
        EventLog log{test::makePlant().structure, 1, 4};
        log.addSink(logEvents(file));
        log.ring(0).post(eventAt(cycle, 0, 0));
    }

    std::ifstream in{file};
    std::stringstream text;
    text << in.rdbuf();
    EXPECT_EQ(text.str(),
              "1970-01-01T00:00:00.001Z info /robot 1.0.0\n"
              "1970-01-01T00:00:00.002Z info /robot 2.0.0\n");
}

TEST(EventSinks, RefuseALogFileThatCannotBeWritten) {
    const test::ModelFolder folder;
    EXPECT_THROW(logEvents(folder.path() / "no such folder/log"), Error);
}

TEST(EventSinks, SayOnceThatALogFileCannotBeWrittenAnyMore) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "/dev/full is missing";
    EventLog log{test::makePlant().structure, 1, 4};
    log.addSink(logEvents("/dev/full"));
    ::testing::internal::CaptureStderr();

    log.ring(0).post(eventAt(1, 0, 0));
    log.ring(0).post(eventAt(1, 0, 1));
    log.stop();

    EXPECT_EQ(::testing::internal::GetCapturedStderr(),
              "cannot write the log file /dev/full: events are lost until it can be written "
              "again\n");
}

TEST(EventSinks, GoOnWithALogFileThatCanBeWrittenAgainAndSayWhatIsMissing) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "/dev/full is missing";
    const test::ModelFolder folder;
    const auto name = folder.path() / "log", real = folder.path() / "real-log";
    std::filesystem::create_symlink("/dev/full", name);
    EventLog log{test::makePlant().structure, 1, 4};
    log.addSink(logEvents(name));
    ::testing::internal::CaptureStderr();
    log.ring(0).post(eventAt(1, 0, 0));
    log.ring(0).post(eventAt(2, 0, 0));
    log.complete(2);
    log.flush();

    std::filesystem::remove(name);
    std::filesystem::create_symlink(real, name);
    log.ring(0).post(eventAt(3, 0, 0));
    log.stop();

    ::testing::internal::GetCapturedStderr();
    std::stringstream text;
    text << std::ifstream{real}.rdbuf();
    EXPECT_EQ(text.str(), "(events missing here: 2)\n1970-01-01T00:00:00.003Z info /robot 3.0.0\n");
}

}  // namespace
}  // namespace cortex
