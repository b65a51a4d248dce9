// SPDX-License-Identifier: Apache-2.0
// Summaries of a running agent.
#include "cortex/comms/mirror.hpp"

#include "comms/mutated.hpp"
#include "comms/raw_dds.hpp"
#include "comms/stepped_agent.hpp"
#include "wire/cdr.hpp"

#include <chrono>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using namespace std::chrono_literals;

class MirrorSummaries : public testing::Test {
protected:
    MirrorSummaries() {
        agent.rig.hand("/arm");
        agent.rig.hand("/hand");
        agent.run();
    }

    SimplexMark mark(const std::string& path) {
        const auto marks = mirror.summary("robot");
        const auto structure = mirror.structure("robot");
        return marks.empty() ? SimplexMark{} : marks.at(structure->find(path));
    }
    bool comes(const std::string& path, const SimplexMark& wanted) {
        return comesTrue([&] { return mark(path) == wanted; });
    }

    SteppedAgent agent{"robot"};
    Mirror mirror{"test", loopback()};
};

TEST_F(MirrorSummaries, TellHowAllSimplexesAreOfWhichNothingIsViewed) {
    ASSERT_TRUE(mirror.waitUntilComplete(test::patience));
    EXPECT_TRUE(mirror.agents().front().summarises);
    EXPECT_TRUE(mirror.summary("robot").empty()) << "nobody has asked";

    mirror.viewSummary();

    ASSERT_TRUE(comesTrue([&] { return !mirror.summary("robot").empty(); }));
    EXPECT_FALSE(mirror.image("robot")) << "no values come";
    const auto state = [&](const char* path) {
        return static_cast<State>(
            agent.rig.agent->images().newest().get<std::int64_t>(path, "state"));
    };
    EXPECT_TRUE(comes("/arm", {state("/arm"), Quality::Good, false}));
    EXPECT_TRUE(comes("/hand", {state("/hand"), Quality::Good, false}));
    agent.change([&] {
        dynamic_cast<test::Hand&>(agent.rig.tree.at("/arm")).data<double>("gain") = 1000.0;
    });
    EXPECT_TRUE(comes("/arm", {state("/arm"), Quality::Good, true}));
    EXPECT_EQ(mark("/hand").outside, false);
    EXPECT_TRUE(mirror.summary("nobody").empty());
}

TEST_F(MirrorSummaries, ComeWhileSomebodyAsksForThem) {
    Participant other{loopback(), "other"};
    const auto ours = other.writer<Summary>(topics::summary);
    const auto theirs = other.reader<Summary>(topics::summary, [](Summary&&) {});
    ASSERT_TRUE(mirror.waitUntilComplete(test::patience));
    mirror.view({"/"}, 30);
    ASSERT_TRUE(mirror.waitForValues(test::patience));
    EXPECT_EQ(theirs->writers(), 1U) << "our own: a view of values asks for no summary";
    EXPECT_EQ(ours->readers(), 1U);

    mirror.viewSummary();
    EXPECT_TRUE(comesTrue([&] { return theirs->writers() == 2 && ours->readers() == 2; }));
    ASSERT_TRUE(comesTrue([&] { return !mirror.summary("robot").empty(); }));
    mirror.viewSummary(false);

    EXPECT_TRUE(comesTrue([&] { return ours->readers() == 1; }));
    EXPECT_TRUE(mirror.summary("robot").empty());
}

TEST_F(MirrorSummaries, OfALoopThatStandsStillAreStale) {
    mirror.viewSummary();
    ASSERT_TRUE(comesTrue([&] { return mark("/arm").quality == Quality::Good; }));

    agent.change(
        [&] { EXPECT_TRUE(comesTrue([&] { return mark("/arm").quality == Quality::Stale; })); });
    EXPECT_TRUE(comesTrue([&] { return mark("/arm").quality == Quality::Good; }));
}

TEST_F(MirrorSummaries, ThatAreMutatedDoNothing) {
    Participant other{loopback(), "other"};
    Inbox<Summary> heard;
    const auto reader = other.reader<Summary>(topics::summary, heard.push());
    mirror.viewSummary();
    ASSERT_TRUE(heard.waitUntil([](const std::vector<Summary>& all) { return !all.empty(); }));
    const Summary original = heard.elements().front();
    std::vector<std::uint8_t> payload(encodedSize(original));
    encode(original, payload);
    RawWriter raw{loopback(), topics::summary, Summary::typeName, false};
    ASSERT_TRUE(comesTrue([&] { return raw.readers() == 2; }));
    std::mt19937_64 random{1};
    const std::uint64_t before = mirror.refused();

    EXPECT_TRUE(comesTrue([&] {
        for (int i = 0; i < 20; ++i) raw.write({}, mutated(payload, random));
        return mirror.refused() > before + 50;
    }));

    EXPECT_TRUE(comesTrue([&] { return mark("/arm").quality == Quality::Good; }));
    EXPECT_EQ(mirror.summary("robot").size(), mirror.structure("robot")->simplexes.size());
}

}  // namespace
}  // namespace cortex::comms
