// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/event_fold.hpp"

#include <cstdint>
#include <string>
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

    std::vector<std::string> told;
    EventFold fold{[this](const Event& each) { told.emplace_back(each.text.view()); }};
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

TEST_F(EventFoldTest, TellsARunOfCommandsOnceASecondWithTheNewestArguments) {
    const auto done = [](const std::string& text) {
        return event(text.c_str(), EventKind::Command, Severity::Info);
    };
    for (int i = 0; i < 30; ++i) {  // three seconds of jog at 10 Hz, and a slider
        const std::int64_t now = i * second / 10;
        const std::string speed = i % 2 == 0 ? "-1.5e-05" : "2";
        fold.take(done("desk: jog(speed=" + speed + "): Done in the same cycle"), now);
        fold.take(done("desk: set(gain=" + std::to_string(i) + ", on=true): Done in 2 cycles"),
                  now);
    }
    fold.take(done("desk: set(title=\"new\"): Done in 1 cycle"), 3 * second - 1);
    fold.pass(3 * second);

    ASSERT_EQ(told.size(), 8U);
    EXPECT_EQ(told[0], "desk: jog(speed=-1.5e-05): Done in the same cycle");
    EXPECT_EQ(told[1], "desk: set(gain=0, on=true): Done in 2 cycles");
    EXPECT_EQ(told[2], "9 times within a second: desk: jog(speed=2): Done in the same cycle");
    EXPECT_EQ(told.back(), "11 times within a second: desk: set(title=\"new\"): Done in 1 cycle");
}

TEST_F(EventFoldTest, KeepsApartCommandsOfOtherSendersPathsNamesAndTexts) {
    for (const char* text :
         {"desk: jog(speed=1): Done in 1 cycle", "hall: jog(speed=1): Done in 1 cycle",
          "desk for ann: jog(speed=1): Done in 1 cycle", "desk: halt(): Done in 1 cycle",
          "desk: take(prefix=\"/arm\"): Done in 1 cycle",
          "desk: take(prefix=\"/hand\"): Done in 1 cycle"}) {
        Event here = event(text, EventKind::Command, Severity::Info);
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
    for (const char* who : {"op1", "op2", "op2", "op3"}) {
        const std::string text =
            std::string{"desk for "} + who + ": set(x=1): Rejected (authority), no in 1 cycle";
        fold.take(event(text.c_str(), EventKind::Refusal), 0);
    }
    EXPECT_EQ(told.size(), 3U);
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
