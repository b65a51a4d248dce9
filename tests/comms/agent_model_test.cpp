// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_model.hpp"

#include "support/agent_rig.hpp"
#include "wire/cdr.hpp"

#include <algorithm>
#include <numeric>
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

TEST(AgentModel, FillsSamplesThatAreFarFromTheLargestPacket) {
    const Told agent{manyPaths()};
    std::vector<std::size_t> sizes;
    for (const Model& each : agent.samples) sizes.push_back(encodedSize(each));

    EXPECT_LE(std::ranges::max(sizes), 1'200U);
    const std::size_t all = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
    EXPECT_LE(sizes.size(), all / 600 + 2) << "half empty at most, but for the last of each list";
}

}  // namespace
}  // namespace cortex::comms
