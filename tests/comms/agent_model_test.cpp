// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_model.hpp"

#include "support/agent_rig.hpp"
#include "wire/cdr.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

struct Plates {
    explicit Plates(const std::vector<std::string>& paths) {
        for (const std::string& path : paths) rig.tree.add(path, "Plate");
        rig.start();
    }

    test::AgentRig rig;
};

struct Told {
    explicit Told(const std::vector<std::string>& paths) : plates{paths} {}

    const Plates plates;
    const AgentSelf self{plates.rig.outside.access};
    const AgentModel model{self};
    const std::vector<Model>& samples = model.samples();
};

std::vector<std::string> manyPaths() {
    std::vector<std::string> paths;
    for (int i = 0; i < 300; ++i) paths.push_back("/plate/" + std::to_string(i));
    return paths;
}

TEST(AgentModel, TellsEveryTypeAndSimplexOnce) {
    const Told agent{manyPaths()};
    std::set<std::string> types, paths;
    std::size_t told = 0;
    for (const Model& each : agent.samples) {
        for (const TypeMessage& type : each.types) types.insert(type.name);
        for (const SimplexMessage& simplex : each.simplexes) paths.insert(simplex.path);
        told += each.types.size() + each.simplexes.size();
    }

    const Presence presence = agent.model.presence("running", 1, 0);
    EXPECT_EQ(types.size(), presence.types);
    EXPECT_EQ(paths.size(), presence.simplexes);
    EXPECT_EQ(told, types.size() + paths.size());
    EXPECT_TRUE(paths.contains("/plate/299"));
}

TEST(AgentModel, FillsSamplesOfOnePacketUnlessOneMessageIsLonger) {
    const Told agent{manyPaths()};
    std::size_t all = 0, shared = 0;
    for (const Model& each : agent.samples) {
        const std::size_t size = encodedSize(each);
        if (each.types.size() + each.simplexes.size() == 1) continue;
        EXPECT_LE(size, 1'200U);
        all += size;
        ++shared;
    }
    EXPECT_GT(shared, 10U);
    EXPECT_LE(shared, all / 600 + 2) << "half empty at most, but for the last of each list";
}

}  // namespace
}  // namespace cortex::comms
