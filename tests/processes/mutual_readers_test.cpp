// SPDX-License-Identifier: Apache-2.0
// Two agents whose processors read what the other one writes.
#include "core/model_folder.hpp"
#include "processes/agent_process.hpp"

#include <string>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

// Its filter at /NAME/filter reads the result of the other.
std::filesystem::path systemIn(const ModelFolder& folder, const std::string& name,
                               const std::string& other) {
    return folder.write(
        name + ".xml",
        "<system name='s'><ontology file='types.xml'/><morphology file='process-morphology.xml'/>" +
            simplex("/" + name + "/out", "Level") +
            simplex("/" + name + "/filter", "Filter",
                    relate("source", "/" + other + "/out", "remote=\"true\" type=\"Level\"") +
                        relate("result", "/" + name + "/out")) +
            "<cluster name='" + name + "' frequency='100'/></system>");
}

TEST(AgentsThatReadEachOther, StartInEachOrder) {
    const ModelFolder folder;
    folder.write("types.xml",
                 "<ontology name='t' version='1.0'><include file='devices.xml'/>"
                 "<type name='Level' extends='AnalogueInput'><data name='value' unit='m'/></type>"
                 "</ontology>");
    const auto west = systemIn(folder, "west", "east"), east = systemIn(folder, "east", "west");
    const std::string started = "all active simplexes are started";
    for (const auto& [first, second] : {std::pair{west, east}, std::pair{east, west}}) {
        AgentProcess one{folder, first, {"--startup"}};
        EXPECT_TRUE(one.prints("waits for /")) << one.output();
        AgentProcess other{folder, second, {"--startup"}};
        EXPECT_TRUE(one.prints(started)) << one.output();
        EXPECT_TRUE(other.prints(started)) << other.output();
    }
    AgentProcess one{folder, west, {"--startup"}}, other{folder, east, {"--startup"}};
    EXPECT_TRUE(one.prints(started)) << one.output();
    EXPECT_TRUE(other.prints(started)) << other.output();
}

}  // namespace
}  // namespace cortex::test
