// SPDX-License-Identifier: Apache-2.0
#include "doctor/hearing.hpp"

#include "live/started_anew.hpp"

#include <gtest/gtest.h>

namespace cortex::cli {
namespace {

constexpr std::int64_t now = 1'700'000'000'000'000;  // UTC in microseconds

comms::AgentStatus agent(const char* name, std::uint32_t hears, std::int64_t seconds = 60) {
    comms::AgentStatus status;
    status.name = name;
    status.host = "desk";
    status.state = "running";
    status.epoch = now - seconds * 1'000'000;
    status.hears = hears;
    return status;
}

TEST(Hearing, NamesWhoDoesNotHearAnotherThatIsHeardHere) {
    Diagnoses found;
    examineHearing({agent("robot", 1), agent("hand", 2)}, now, found);

    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].level, Diagnosis::Level::Warning);
    EXPECT_EQ(found[0].message, "robot on desk hears 0 of the 1 other agents that are heard here");
}

TEST(Hearing, SaysNothingOfThoseThatJoinStillAreLostOrDoNotSay) {
    comms::AgentStatus lost = agent("lost", 1);
    lost.state = "lost";
    Diagnoses found;
    examineHearing({agent("robot", 2), agent("hand", 0), agent("young", 1, 3), lost}, now, found);

    EXPECT_TRUE(found.empty());
}

TEST(StartedAnew, NamesWhoseStartIsAnotherOrGone) {
    comms::AgentStatus lost = agent("lost", 1);
    lost.state = "lost";
    const Starts starts{
        {"gone", 1}, {"lost", lost.epoch}, {"new", 7}, {"same", agent("", 1).epoch}};

    EXPECT_EQ(startedAnew(starts, {agent("new", 1), agent("same", 1), lost}),
              (std::vector<std::string>{"gone", "lost", "new"}));
}

}  // namespace
}  // namespace cortex::cli
