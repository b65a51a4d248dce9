// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/event_fold.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

struct EventFoldTest : testing::Test {
    static constexpr std::int64_t second = 1'000'000'000;

    static Event event(const char* text, EventKind kind = EventKind::Limit,
                       Severity severity = Severity::Warning) {
        Event event;
        event.kind = kind;
        event.severity = severity;
        event.text = text;
        return event;
    }

    static Event done(const std::string& text) {
        return event(text.c_str(), EventKind::Command, Severity::Info);
    }

    std::vector<std::string> told;
    EventFold fold{[this](const Event& each) { told.emplace_back(each.text.view()); },
                   [](std::uint32_t, std::string_view command) { return command == "jog"; }};
};

TEST_F(EventFoldTest, TellsTheFirstAtOnceAndThenACountEachSecond) {
    for (int i = 0; i < 500; ++i) fold.take(event("clamped to 2.5 rad"), i);
    EXPECT_EQ(told, std::vector<std::string>{"clamped to 2.5 rad"});

    fold.take(event("clamped to 2.6 rad"), second);
    fold.take(event("clamped to 2.7 rad"), second + 1);
    EXPECT_EQ(told.size(), 2U);
    EXPECT_EQ(told.back(), "499 times within a second: clamped to 2.5 rad");
    fold.pass(2 * second);
    EXPECT_EQ(told.back(), "2 times within a second: clamped to 2.7 rad");
}

TEST_F(EventFoldTest, TellsTheFirstAtOnceAgainAfterASecondOfSilence) {
    fold.take(event("missed 1 tick"), 0);
    fold.pass(second);
    fold.take(event("missed 2 tick"), second + 1);

    EXPECT_EQ(told, (std::vector<std::string>{"missed 1 tick", "missed 2 tick"}));
}

TEST_F(EventFoldTest, TellsASingleRepeatAsItWas) {
    fold.take(event("missed 1 tick"), 0);
    fold.take(event("missed 2 tick"), 1);
    fold.pass(second);

    EXPECT_EQ(told, (std::vector<std::string>{"missed 1 tick", "missed 2 tick"}));
}

TEST_F(EventFoldTest, TellsTheOldestFirst) {
    for (const std::int64_t time : {1, 2}) {
        for (const char* text : {"c", "b", "a"}) {
            Event each = event(text);
            each.wallClock = 10 * time + (text[0] == 'b' ? 1 : text[0] == 'c' ? 0 : 2);
            fold.take(each, 0);
        }
    }
    told.clear();
    fold.pass(second);

    EXPECT_EQ(told, (std::vector<std::string>{"c", "b", "a"}));
}

TEST_F(EventFoldTest, NeverFoldsFaultsErrorsStatesAndCommands) {
    for (int i = 0; i < 2; ++i) {
        fold.take(event("a", EventKind::Fault), i);
        fold.take(event("b", EventKind::Message, Severity::Error), i);
        fold.take(event("c", EventKind::StateChange, Severity::Info), i);
        fold.take(event("d", EventKind::Command, Severity::Info), i);
        fold.take(event("e", EventKind::Watchdog), i);
    }

    EXPECT_EQ(told.size(), 10U);
}

TEST_F(EventFoldTest, TellsEachCommandThatIsNotTheSameWordForWord) {
    std::vector<std::string> sent;
    for (int i = 0; i < 50; ++i) {
        sent.push_back("desk: " + std::string{i % 2 == 0 ? "set(gain=" : "move(to="} +
                       std::to_string(i) + "): Done in 2 cycles");
        fold.take(done(sent.back()), i);
    }
    for (const char* each : {"desk: set(on=true): Done", "desk: set(on=false): Done",
                             "desk: set(name=\"T4\"): Done", "desk: set(name=\"T5\"): Done"}) {
        sent.emplace_back(each);
        fold.take(done(each), 50);
    }
    EXPECT_EQ(told, sent);
}

TEST_F(EventFoldTest, CountsCommandsThatAreTheSameWordForWordHoweverLongTheyTook) {
    for (int i = 0; i < 3; ++i)
        fold.take(done("desk: set(gain=1): Done in " + std::to_string(i + 2) + " cycles"), i);
    fold.pass(second);

    EXPECT_EQ(told, (std::vector<std::string>{
                        "desk: set(gain=1): Done in 2 cycles",
                        "2 times within a second: desk: set(gain=1): Done in 4 cycles"}));
}

TEST_F(EventFoldTest, TellsEachCommandOfWhichNotEveryWordIsLeft) {
    for (int i = 0; i < 2; ++i) {
        fold.take(done("desk: set(gain=1, na…): Done in 2 cycles"), i);
        fold.take(done("desk: set(gain=1, nam"), i);
    }
    EXPECT_EQ(told.size(), 4U);
}

TEST_F(EventFoldTest, TellsARunOfAHeldButtonOnceASecondWithItsLastArgumentsAndTheirRanges) {
    for (int i = 0; i < 30; ++i) {  // three seconds of jog at 10 Hz
        const std::string speed = i % 3 == 0 ? "-1.5e-05" : i % 3 == 1 ? "2" : "0.25";
        fold.take(done("desk: jog(axis=1, speed=" + speed + "): Done in 1 cycle"), i * second / 10);
    }
    fold.pass(3 * second);

    EXPECT_EQ(
        told,
        (std::vector<std::string>{
            "desk: jog(axis=1, speed=-1.5e-05): Done in 1 cycle",
            "9 times within a second: desk: jog(axis=1, speed=-1.5e-05 (-1.5e-05 to 2)): Done "
            "in 1 cycle",
            "10 times within a second: desk: jog(axis=1, speed=2 (-1.5e-05 to 2)): Done in 1 "
            "cycle",
            "10 times within a second: desk: jog(axis=1, speed=0.25 (-1.5e-05 to 2)): Done in "
            "1 cycle"}));
}

TEST_F(EventFoldTest, KeepsApartWhatAHeldButtonSaysInOtherWords) {
    for (const char* text :
         {"desk: jog(frame=base, speed=1): Done", "desk: jog(frame=tip, speed=1): Done",
          "desk: jog(speed=1 2): Done", "desk: jog(speed=1): Done", "desk: jog(tool=\"T1\"): Done",
          "desk: jog(tool=\"T2\"): Done", "desk: jog(tool=\" 1\"): Done",
          "desk: jog(tool=\" 2\"): Done"})
        fold.take(done(text), 0);
    EXPECT_EQ(told.size(), 8U);
}

TEST_F(EventFoldTest, TellsOneRangeOfAnArrayWhereATextHasNoRoomForEachNumber) {
    const auto jog = [](const std::string& first, const std::string& last) {
        return "desk: jog(axes=1 2, speeds=" + first + " 0 0.25 0 0.125 0 " + last +
               "): Done in 1 cycle";
    };
    fold.take(done(jog("0.75", "0")), 0);
    fold.take(done(jog("-0.123456", "0.5")), 1);
    fold.take(done(jog("0.5", "-0.654321")), 2);
    fold.pass(second);
    EXPECT_EQ(told.back(),
              "2 times within a second: desk: jog(axes=1 2, speeds=0.5 (-0.123456 to 0.5) 0 0.25 "
              "0 0.125 0 -0.654321 (-0.654321 to 0.5)): Done in 1 cycle");
    const std::string sender(20, 'n');
    fold.take(done(sender + jog("-0.123456", "0.5")), second + 2);
    fold.take(done(sender + jog("-0.123456", "0.5")), second + 2);
    fold.take(done(sender + jog("0.5", "-0.654321")), second + 3);
    fold.pass(3 * second);
    EXPECT_EQ(told.back(), "2 times within a second: " + sender +
                               "desk: jog(axes=1 2, speeds=0.5 0 0.25 0 0.125 0 -0.654321 (each "
                               "-0.654321 to 0.5)): Done in 1 cycle");
}

TEST_F(EventFoldTest, NeverShowsTheLastNumbersOfARunForAllOfIt) {
    const std::string name(75, 'n');
    for (const char* speed : {"1", "1.125", "-1.25", "1.5"})
        fold.take(done(name + ": jog(frame=tip, axis=9, speed=" + speed + "): Done in 1 cycle"), 0);
    fold.pass(second);
    EXPECT_EQ(told.back(), "3 times within a second: " + name +
                               ": jog(…, numbers -1.25 to 1.5): Done in 1 cycle");

    const auto refused = [](const std::string& speed) {
        return event(("desk for somebody at the window: jog(axis=2, speed=" + speed +
                      "): Rejected (range), speed is above 0.25 rad/s, as its type says it")
                         .c_str(),
                     EventKind::Refusal);
    };
    for (const char* speed : {"1", "1.125", "7.25", "1.5"}) fold.take(refused(speed), second + 1);
    fold.pass(3 * second);
    EXPECT_TRUE(told.back().starts_with(
        "3 times within a second: desk for somebody at the window: jog(axis=2, speed=1.5 (1.125 to "
        "7.25)): Rejected (range), speed is above"))
        << told.back();
}

TEST_F(EventFoldTest, CountsRefusalsOfAHeldButtonAndTellsThoseOfOtherCommands) {
    const auto refused = [](const std::string& text) {
        return event(text.c_str(), EventKind::Refusal);
    };
    for (int i = 0; i < 5; ++i) {
        const std::string number = std::to_string(i);
        fold.take(refused("desk: jog(speed=" + number + "): Rejected (range), " + number + " is"),
                  i);
    }
    EXPECT_EQ(told.size(), 1U);
    for (int i = 0; i < 5; ++i)
        fold.take(refused("desk: set(gain=" + std::to_string(i) + "): Rejected (range), no"), i);
    EXPECT_EQ(told.size(), 7U);
}

TEST_F(EventFoldTest, TellsASetAgainAfterAnotherInTheOrderInWhichTheyCame) {
    std::vector<std::string> sent;
    for (const char* each : {"ann: set(x=1): Done", "bob: set(x=2): Done", "ann: set(x=1): Done",
                             "ann: set(x=3): Failed, it hurts", "bob: set(x=2): Done",
                             "ann: take(prefix=\"/\"): Done", "bob: set(x=2): Done"}) {
        sent.emplace_back(each);
        Event set = done(each);
        if (sent.back().starts_with("ann: take")) set.kind = EventKind::Control;
        fold.take(set, 0);
        EXPECT_EQ(told, sent);
    }
}

TEST_F(EventFoldTest, TellsWhatItCountedOfCommandsBeforeTheNextOne) {
    for (const char* each :
         {"ann: jog(speed=1): Done", "ann: jog(speed=2): Done", "ann: jog(speed=3): Done",
          "bob: set(x=1): Done", "ann: jog(speed=4): Done", "bob: set(x=1): Done"})
        fold.take(done(each), 0);
    fold.pass(second);

    EXPECT_EQ(told, (std::vector<std::string>{
                        "ann: jog(speed=1): Done",
                        "2 times within a second: ann: jog(speed=3 (2 to 3)): Done",
                        "bob: set(x=1): Done", "ann: jog(speed=4): Done", "bob: set(x=1): Done"}));
}

TEST_F(EventFoldTest, NeverTellsATimeBeforeWhatItToldAlready) {
    std::vector<std::int64_t> times;
    EventFold timed{[&times](const Event& each) { times.push_back(each.wallClock); },
                    [](std::uint32_t, std::string_view) { return false; }};
    for (std::int64_t i = 1; i <= 40; ++i) {
        Event each = event(i % 4 == 0   ? "over"
                           : i % 4 == 1 ? "desk: set(x=1): Done"
                                        : "a",
                           i % 4 == 1 ? EventKind::Command : EventKind::Limit, Severity::Info);
        if (i % 4 == 3) each = event("lost", EventKind::Fault);
        each.wallClock = i * second / 10;
        timed.take(each, each.wallClock);
    }
    timed.pass(100 * second);
    EXPECT_GT(times.size(), 20U);
    EXPECT_TRUE(std::ranges::is_sorted(times));
}

TEST_F(EventFoldTest, KeepsApartCommandsOfOtherSendersPathsNamesAndTexts) {
    for (const char* text :
         {"desk: jog(speed=1): Done in 1 cycle", "hall: jog(speed=1): Done in 1 cycle",
          "desk for ann: jog(speed=1): Done in 1 cycle", "desk: halt(): Done in 1 cycle",
          "desk: take(prefix=\"/arm\"): Done in 1 cycle",
          "desk: take(prefix=\"/hand\"): Done in 1 cycle"}) {
        Event here = done(text);
        fold.take(here, 0);
        here.simplex = 3;
        fold.take(here, 0);
    }

    EXPECT_EQ(told.size(), 12U);
}

TEST_F(EventFoldTest, TellsEachCommandThatFailsOrIsRefused) {
    for (int i = 0; i < 5; ++i) {
        fold.take(event("desk: jog(speed=1): Failed, it hurts in 1 cycle", EventKind::Command), i);
    }
    EXPECT_EQ(told.size(), 5U);
}

TEST_F(EventFoldTest, KeepsApartRefusalsOfPeopleWhoseNamesDifferInANumber) {
    for (const char* who : {"op1", "op2", "op2", "op2", "op3"}) {
        const std::string text =
            std::string{"desk for "} + who + ": set(x=1): Rejected (authority), no in 1 cycle";
        fold.take(event(text.c_str(), EventKind::Refusal), 0);
    }
    ASSERT_EQ(told.size(), 4U);
    EXPECT_TRUE(told[2].starts_with("2 times within a second: desk for op2: ")) << told[2];
}

TEST_F(EventFoldTest, KeepsApartWhatDiffersInPathSeverityOrWords) {
    fold.take(event("over"), 0);
    fold.take(event("under"), 0);
    fold.take(event("over", EventKind::Limit, Severity::Info), 0);
    Event other = event("over");
    other.simplex = 3;
    fold.take(other, 0);

    EXPECT_EQ(told.size(), 4U);
}

}  // namespace
}  // namespace cortex
