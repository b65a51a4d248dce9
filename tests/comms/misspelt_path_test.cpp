// SPDX-License-Identifier: Apache-2.0
// When an agent says that a path of another one is perhaps misspelt.
#include "agent/misspelt_path.hpp"

#include "comms/told_agent.hpp"
#include "wire/ids.hpp"
#include "wire/presence_extras.hpp"

#include <string>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

constexpr std::int64_t oneSecond = 1'000'000'000;  // ns

struct PathReader {
    PathReader() {
        rig.tree.add("/plate", "Plate");
        rig.start();
    }

    test::AgentRig rig{"near"};
};

// An agent looks for paths; "rig", of which everything has come, has /work/one.
struct MisspeltPathTest : testing::Test {
    MisspeltPathTest() {
        for (const Model& model : told.models) peers.take(model, oneSecond);
        hearRig("2");
    }
    void hearRig(const std::string& agents) {
        Presence presence = told.presence;
        presence.extras = {{rootPaths, "/boss /plate /reading /rig /work"}, {agentsHeard, agents}};
        peers.take(presence, oneSecond);
    }
    // An agent of which nothing but its presence has come.
    void hearAnother(const std::string& roots) {
        Presence presence = told.presence;
        presence.name = "other";
        presence.agent = agentId(presence.name);
        presence.extras = {{rootPaths, roots}, {agentsHeard, "3"}};
        peers.take(presence, oneSecond);
    }
    std::string hintAt(std::int64_t now, const std::string& path = "/work/onne",
                       bool nameless = false) {
        return misspelt.hint(path, peers.all(), nameless, now);
    }

    PathReader reader;
    ToldAgent told;
    AgentSelf self{reader.rig.outside.access};
    AgentPeers peers{self, [](const std::string&, std::int64_t) {}};
    MisspeltPath misspelt;
    const std::string words = "rig has no such simplex, nearest of: /work/one";
};

TEST_F(MisspeltPathTest, IsToldOnceWhereNobodyNewComesForASecond) {
    EXPECT_EQ(hintAt(oneSecond), "");
    EXPECT_EQ(hintAt(2 * oneSecond - 1), "");

    EXPECT_EQ(hintAt(2 * oneSecond).substr(0, words.size()), words);

    EXPECT_EQ(hintAt(3 * oneSecond), "");
}

TEST_F(MisspeltPathTest, WaitsLongerWhereNobodyHasAPathAboveIt) {
    const std::string path = "/wrok/one";
    hintAt(oneSecond, path);
    EXPECT_EQ(hintAt(11 * oneSecond - 1, path), "");

    EXPECT_EQ(hintAt(11 * oneSecond, path).substr(0, words.size()), words);
}

TEST_F(MisspeltPathTest, WaitsForAllOfAnAgentThatMayHaveThePath) {
    hearAnother("/work/onne");
    hintAt(oneSecond);
    EXPECT_EQ(hintAt(9 * oneSecond), "");

    hearAnother("/elsewhere");

    EXPECT_NE(hintAt(9 * oneSecond), "");
}

TEST_F(MisspeltPathTest, WaitsForAnAgentThatOthersHear) {
    hearRig("3");
    hintAt(oneSecond);
    EXPECT_EQ(hintAt(9 * oneSecond), "");

    hearRig("2");

    EXPECT_NE(hintAt(9 * oneSecond), "");
}

TEST_F(MisspeltPathTest, WaitsForWhoWasFoundAndHasNotSaidWhoItIs) {
    hintAt(oneSecond);
    EXPECT_EQ(hintAt(9 * oneSecond, "/work/onne", true), "");

    EXPECT_NE(hintAt(9 * oneSecond, "/work/onne", false), "");
}

TEST_F(MisspeltPathTest, DoesNotWaitForEverForWhoNeverSaysAll) {
    hearAnother("*");
    hintAt(oneSecond);
    EXPECT_EQ(hintAt(60 * oneSecond), "");

    EXPECT_NE(hintAt(61 * oneSecond), "");
}

TEST_F(MisspeltPathTest, SaysNothingOfWhatResemblesNothing) {
    hintAt(oneSecond, "/quite/different");

    EXPECT_EQ(hintAt(9 * oneSecond, "/quite/different"), "");
}

}  // namespace
}  // namespace cortex::comms
