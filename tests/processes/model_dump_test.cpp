// SPDX-License-Identifier: Apache-2.0
// `cortex-agent --dump-mjcf`: what goes to which output, and what is refused.
#include "cli/cortex_process.hpp"
#include "comms/inbox.hpp"
#include "processes/agent_process.hpp"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

// A plant with a line to a device, and with what a test adds.
class ModelDump : public testing::Test {
protected:
    ModelDump() {
        folder.write("types.xml",
                     "<ontology name='t' version='1.0'><include file='base.xml'/>"
                     "<type name='World' extends='Device'><data name='bodies' kind='int' "
                     "default='1' min='0'/><data name='kept' kind='int' settable='Standby' "
                     "retain='true'/></type>"
                     "<type name='Line' extends='Device'/>"
                     "<type name='Table' extends='Simplex' role='descriptive'/></ontology>");
        folder.write("rules.xml",
                     "<morphology name='m' version='1.0'><include file='base-morphology.xml'/>"
                     "<include file='types.xml'/></morphology>");
    }
    void writePlant(const std::string& simplexes) const {
        folder.write("plant.xml",
                     "<system name='s'><morphology file='rules.xml'/>"
                     "<cluster name='plant' frequency='100' priority='80'/>"
                     "<simplex path='/line' type='Line'/><simplex path='/table' type='Table'/>" +
                         simplexes + "</system>");
    }
    static std::string world(const std::string& path, const std::string& inside = "") {
        return "<simplex path='" + path + "' type='World'>" + inside + "</simplex>";
    }
    // In a shell: "$0" is the program with its plug-in.
    Outcome shell(const std::string& command) const {
        return runProgram("sh", {"-c", command, CORTEX_BINARY_DIR "/bin/cortex-agent"}, {},
                          folder.path().string());
    }
    Outcome dump(const std::string& options) const {
        return shell("exec \"$0\" plant.xml --plugin " + plugin + " " + options);
    }
    void expectRefused(const std::string& options, int exit, const std::string& text) const {
        const Outcome agent = dump(options);
        EXPECT_EQ(agent.exit, exit) << agent.errors;
        EXPECT_EQ(agent.output, "");
        EXPECT_EQ(agent.errors, text + "\n");
    }

    const ModelFolder folder;
    const std::string plugin = CORTEX_BINARY_DIR "/lib/plugins/worlds.so";
};

TEST_F(ModelDump, PrintsTheModelAloneWhateverElseIsPrinted) {
    writePlant(world("/world"));
    const Outcome agent = dump("--dump-mjcf");
    EXPECT_EQ(agent.exit, 0) << agent.errors;
    EXPECT_EQ(agent.output, "<mujoco model=\"/world\">\n  <body/>\n</mujoco>\n");
    EXPECT_TRUE(contains(agent.errors, "a world is made")) << agent.errors;
    EXPECT_TRUE(contains(agent.errors, "of so many bodies: 1")) << agent.errors;
}

TEST_F(ModelDump, TakesItsStartValuesAsARunWould) {
    writePlant(world("/world", "<set data='bodies' value='2'/>"));
    EXPECT_TRUE(contains(dump("--dump-mjcf").output, ">\n  <body/>\n  <body/>\n</"));
    EXPECT_TRUE(contains(dump("--dump-mjcf --set /world.bodies=0").output, "\">\n</mujoco>"));
}

TEST_F(ModelDump, MayStandBeforeTheSystemFile) {
    writePlant(world("/world"));
    const Outcome agent = shell("exec \"$0\" --plugin " + plugin + " --dump-mjcf plant.xml");
    EXPECT_EQ(agent.exit, 0) << agent.errors;
    EXPECT_TRUE(agent.output.starts_with("<mujoco ")) << agent.output;
}

TEST_F(ModelDump, RunsNothingAndTalksToNoDevice) {
    writePlant(world("/world"));
    const Outcome agent = dump("--dump-mjcf --startup --offline --log events.txt");
    EXPECT_EQ(agent.exit, 0) << agent.errors;
    EXPECT_FALSE(contains(agent.errors, "it runs")) << agent.errors;
    EXPECT_FALSE(contains(agent.errors, "it talks")) << agent.errors;
    EXPECT_FALSE(contains(agent.errors, "real time: ")) << agent.errors;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "events.txt"));
}

// An agent of that name would end there with exit code 5.
TEST_F(ModelDump, JoinsNoNetwork) {
    writePlant(world("/world"));
    AgentProcess agent{folder, folder.path() / "plant.xml", {"--plugin", plugin}};
    ASSERT_TRUE(agent.prints(" simplexes at "));
    const comms::NetworkOptions network = comms::loopback();
    const Outcome dumped = dump("--dump-mjcf --domain " + std::to_string(network.domain) +
                                " --interface " + network.interfaces.front());
    EXPECT_EQ(dumped.exit, 0) << dumped.errors;
    EXPECT_TRUE(dumped.output.starts_with("<mujoco ")) << dumped.output;
    EXPECT_EQ(agent.endInOrder(), 0) << agent.output();
}

TEST_F(ModelDump, LeavesAFileOfRetainedValuesAsItIs) {
    writePlant(world("/world"));
    folder.write("plant.retained.xml", "no XML");
    EXPECT_EQ(dump("--dump-mjcf").exit, 0);
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "plant.retained.xml"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "plant.retained.xml.broken"));
}

TEST_F(ModelDump, PrintsTheOneOfSeveralThatIsNamed) {
    writePlant(world("/left") + world("/right"));
    EXPECT_TRUE(dump("--dump-mjcf /right").output.starts_with("<mujoco model=\"/right\">"));
    EXPECT_TRUE(dump("--dump-mjcf=/left").output.starts_with("<mujoco model=\"/left\">"));
    expectRefused("--dump-mjcf", 2,
                  "--dump-mjcf: plant.xml has 2 models; add the path of one: /left, /right");
}

TEST_F(ModelDump, NamesTheModelsThatThereAre) {
    writePlant(world("/cell/world") + world("/other"));
    expectRefused("--dump-mjcf /cell/wrld", 2,
                  "--dump-mjcf /cell/wrld: no simplex has this path; nearest of: /cell/world");
    expectRefused("--dump-mjcf /somewhere/else/entirely", 2,
                  "--dump-mjcf /somewhere/else/entirely: no simplex has this path; these have a "
                  "model: /cell/world, /other");
    expectRefused("--dump-mjcf /table", 2,
                  "--dump-mjcf /table: a Table has no model; these have one: /cell/world, /other");
    EXPECT_EQ(dump("--dump-mjcf other").exit, 2);
    EXPECT_TRUE(contains(dump("--dump-mjcf other").errors, "'other' is no path of a simplex"));
}

TEST_F(ModelDump, NamesWhatWouldHaveAModelWhereNothingHas) {
    writePlant("");
    expectRefused("--dump-mjcf", 1,
                  "plant.xml: no simplex has a model as MJCF; a MujocoWorld has one "
                  "(physics-morphology.xml)");
}

TEST_F(ModelDump, RefusesASystemThatWouldNotStart) {
    writePlant(world("/world", "<set data='bodies' value='-1'/>"));
    const Outcome agent = dump("--dump-mjcf");
    EXPECT_EQ(agent.exit, 1);
    EXPECT_EQ(agent.output, "");
    EXPECT_TRUE(contains(agent.errors, "/world")) << agent.errors;
}

// 900 KB: no pipe holds so much.
TEST_F(ModelDump, LeavesNothingOutForAReaderWhoIsSlow) {
    writePlant(world("/world", "<set data='bodies' value='80000'/>"));
    const Outcome agent =
        shell("\"$0\" plant.xml --plugin " + plugin + " --dump-mjcf | (sleep 0.5; cat)");
    EXPECT_EQ(std::ranges::count(agent.output, '\n'), 80'002);
    EXPECT_TRUE(agent.output.ends_with("</mujoco>\n"));
}

TEST_F(ModelDump, SaysThatItCouldNotBeWritten) {
    writePlant(world("/world"));
    const Outcome agent = dump("--dump-mjcf >/dev/full");
    EXPECT_EQ(agent.exit, 1);
    EXPECT_TRUE(
        contains(agent.errors, "the standard output cannot be written: No space left on device"))
        << agent.errors;
}

}  // namespace
}  // namespace cortex::test
