// SPDX-License-Identifier: Apache-2.0
// `cortex validate` says what the start of an agent says, as `cortex-agent --validate` finds it.
#include "cli/cortex_process.hpp"
#include "core/model_folder.hpp"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <sys/socket.h>
#include <unistd.h>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <nlohmann/json.hpp>

namespace cortex::test {
namespace {

using nlohmann::json;

constexpr const char* agentProgram = CORTEX_BINARY_DIR "/bin/cortex-agent";

class StartCheck : public testing::Test {
protected:
    StartCheck() {
        folder.write("types.xml",
                     "<ontology name='t' version='1.0'><include file='robotics.xml'/>"
                     "<include file='devices.xml'/>"
                     "<type name='Turn' extends='RotaryAxisConcept'>"
                     "<data name='position' min='-3' max='3' rate='2'/>"
                     "<data name='velocity' min='-2' max='2' rate='10'/>"
                     "<data name='acceleration' rate='100'/></type>"
                     "<type name='Level' extends='AnalogueInput'><data name='value' unit='m'/>"
                     "</type><type name='Guard' extends='Active'/></ontology>");
        folder.write("rules.xml",
                     "<morphology name='m' version='1.0'><include file='cortex-morphology.xml'/>"
                     "<include file='types.xml'/><rules type='Guard'>"
                     "<relationship name='guarded' direction='input' target='Level' min='1' "
                     "max='1' onLoss='fault'/>"
                     "</rules></morphology>");
    }

    std::filesystem::path write(const std::string& simplexes) const {
        return folder.write("plant.xml",
                            "<system name='s'><ontology file='types.xml'/>\n"
                            "<morphology file='rules.xml'/>\n"
                            "<cluster name='plant' frequency='100'/>\n" +
                                simplexes + "</system>");
    }
    Outcome validate(std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"validate", "plant.xml"});
        return cortex(more, {}, folder.path().string());
    }
    Outcome start(std::vector<std::string> more) const {
        more.insert(more.begin(), "plant.xml");
        return runProgram(agentProgram, more, {}, folder.path().string());
    }

    const ModelFolder folder;
};

std::string axis(const std::string& name) {
    return simplex(name + "/axis", "Turn") + simplex(name + "/wish", "Turn");
}

std::string drive(const std::string& name, const std::string& demand) {
    return simplex(name + "/drive", "SimulatedAxis",
                   relate("demand", demand) + relate("observation", name + "/axis"));
}

std::string leader(const std::string& path, const std::string& type, const std::string& name,
                   const std::string& more = "") {
    return simplex(path, type,
                   relate("axes", name + "/axis") + relate("demands", name + "/wish") + more);
}

std::string coupler(const std::string& sets) {
    return simplex("/level", "Level") +
           simplex("/io", "ModbusIoDevice", relate("inputNumbers", "/level") + sets);
}

struct Wrong {
    const char* rule;
    std::string simplexes;
};

std::vector<Wrong> wrongSystems() {
    const std::string one = axis("/a") + drive("/a", "/a/wish");
    const std::string two = axis("/a") + axis("/b");
    return {
        {"pair-crossed", two + drive("/a", "/b/wish") + drive("/b", "/a/wish") +
                             leader("/a/jog", "JogController", "/a") +
                             leader("/b/jog", "JogController", "/b")},
        {"two-managers",
         one + leader("/a/jog", "JogController", "/a") +
             leader("/a/pose", "AxisPoseController", "/a") +
             simplex("/a/select", "AxisControllerSelector", relate("choices", "/a/pose"))},
        {"nobody-writes", one + leader("/a/jog", "JogController", "/a") +
                              simplex("/level", "Level") +
                              simplex("/guard", "Guard", relate("guarded", "/level"))},
        {"start-value-in-vain",
         simplex("/a/axis", "Turn") + simplex("/a/wish", "Turn", set("position", "1")) +
             drive("/a", "/a/wish") + leader("/a/jog", "JogController", "/a")},
        {"no-class",
         one + leader("/a/jog", "JogController", "/a") +
             simplex("/x", "Guard", relate("guarded", "/elsewhere", "remote=\"true\""))},
        {"max-age", one + simplex("/a/jog", "JogController",
                                  relate("axes", "/a/axis", "maxAge=\"0.01\"") +
                                      relate("demands", "/a/wish"))},
        {"on-loss-direction",
         one + simplex("/a/jog", "JogController",
                       relate("axes", "/a/axis") + relate("demands", "/a/wish", "maxAge=\"1\""))},
        {"count-unequal", one + leader("/a/jog", "JogController", "/a", relate("axes", "/b/axis")) +
                              simplex("/b/axis", "Turn")},
        {"populate", coupler(set("address", "plc.local") + set("inputRegistersAt", "0"))},
        {"populate", coupler(set("address", "127.0.0.1:502"))},
        {"setting-range",
         one + leader("/a/jog", "JogController", "/a") + simplex("/r", "Ramp", set("rate", "-1"))},
        {"unknown-path", one + leader("/a/jog", "JogController", "/b")},
    };
}

TEST_F(StartCheck, FindsByValidateWhatTheStartRefusesInTheSameWords) {
    for (const Wrong& wrong : wrongSystems()) {
        write(wrong.simplexes);
        const Outcome checked = validate({"--json"});
        const Outcome started = start({"--offline"});

        EXPECT_EQ(checked.exit, 1) << wrong.rule << checked.output << checked.errors;
        EXPECT_EQ(started.exit, 1) << wrong.rule << started.errors;
        std::set<std::string> rules;
        const json found = json::parse(checked.output);
        for (const json& each : found.at("findings")) {
            if (each.at("severity") != "error") continue;
            rules.insert(each.at("rule"));
            EXPECT_TRUE(contains(started.errors, each.at("message"))) << each << started.errors;
            EXPECT_TRUE(contains(started.errors, each.at("remedy"))) << each << started.errors;
        }
        EXPECT_EQ(rules.count(wrong.rule), 1U) << wrong.rule << checked.output;
    }
}

TEST_F(StartCheck, IsLeftOutWhereItIsAskedForAndWhereNoAgentIsInstalled) {
    write(simplex("/x", "Guard", relate("guarded", "/level", "remote=\"true\"")) +
          simplex("/seen", "Level"));
    EXPECT_TRUE(contains(validate().output, "(no-class)"));

    const Outcome asked = validate({"--model-only"});
    EXPECT_EQ(asked.exit, 0) << asked.output;
    EXPECT_TRUE(contains(asked.output, "valid as a model")) << asked.output;
    EXPECT_FALSE(contains(asked.output, "start-unchecked")) << asked.output;

    std::filesystem::copy_file(CORTEX_BINARY_DIR "/bin/cortex", folder.path() / "cortex");
    const Outcome alone =
        runProgram("./cortex", {"validate", "plant.xml"},
                   {{"LD_LIBRARY_PATH", CORTEX_BINARY_DIR "/lib"}}, folder.path().string());
    EXPECT_EQ(alone.exit, 0) << alone.output << alone.errors;
    EXPECT_TRUE(contains(alone.output, "note: only the model was checked: cortex-agent, which"))
        << alone.output;
    EXPECT_TRUE(contains(alone.output, "valid as a model")) << alone.output;
}

TEST_F(StartCheck, SaysThatAnAgentWouldNotReadAllTheFiles) {
    folder.write("more.xml",
                 "<ontology name='more' version='1.0'><include file='base.xml'/>"
                 "<type name='Thing' extends='Simplex' role='descriptive'/>"
                 "</ontology>");
    folder.write("plant.xml",
                 "<system name='s'><ontology file='base.xml'/>"
                 "<morphology file='base-morphology.xml'/>"
                 "<cluster name='plant' frequency='100'/>"
                 "<simplex path='/thing' type='Thing'/></system>");

    const Outcome checked = validate({"more.xml"});

    EXPECT_EQ(checked.exit, 0) << checked.output;
    EXPECT_TRUE(contains(checked.output, "an agent reads this file alone")) << checked.output;
}

// A socket that counts as a device.
TEST_F(StartCheck, OpensNoDeviceAndLeavesRetainedValuesAlone) {
    const int listener = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    ASSERT_EQ(bind(listener, reinterpret_cast<sockaddr*>(&address), size), 0);
    ASSERT_EQ(listen(listener, 4), 0);
    ASSERT_EQ(getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size), 0);
    const std::string port = std::to_string(ntohs(address.sin_port));
    write(coupler(set("address", "127.0.0.1:" + port) + set("inputRegistersAt", "0")));
    folder.write("plant.retained.xml", "broken");

    const Outcome checked = validate();

    EXPECT_EQ(checked.exit, 0) << checked.output << checked.errors;
    EXPECT_LT(accept(listener, nullptr, nullptr), 0) << "somebody has connected";
    EXPECT_EQ(folder.read("plant.retained.xml"), "broken");
    close(listener);
}

TEST_F(StartCheck, NamesAPlugInThatCannotBeLoadedAndTakesOneThatCan) {
    write("");
    const std::string plugins = CORTEX_BINARY_DIR "/lib/plugins/";
    const Outcome wrong = validate({"--plugin", plugins + "plugin-wrong-abi.so"});
    EXPECT_EQ(wrong.exit, 1);
    EXPECT_TRUE(contains(wrong.output, "has plug-in ABI")) << wrong.output;
    EXPECT_TRUE(contains(wrong.output, "(start-refused)")) << wrong.output;
    EXPECT_EQ(validate({"--plugin", plugins + "worlds.so"}).exit, 0);
}

TEST_F(StartCheck, SaysTheSizesThatAStartInANetworkWarnsOf) {
    folder.write("big.xml",
                 "<ontology name='big' version='1.0'><include file='base.xml'/>"
                 "<type name='Big' extends='Simplex' role='descriptive'>"
                 "<data name='values' kind='float' length='60000'/></type></ontology>");
    std::string simplexes;
    for (int i = 0; i < 40; ++i) simplexes += simplex("/big/" + std::to_string(i), "Big");
    folder.write("plant.xml",
                 "<system name='s'><ontology file='big.xml'/>"
                 "<morphology file='base-morphology.xml'/>"
                 "<cluster name='plant' frequency='10'/>" +
                     simplexes + "</system>");
    const std::string warning = "the values of all simplexes can take 20 MB";

    EXPECT_TRUE(contains(validate().output, warning));
    const Outcome offline = start({"--offline", "--seconds", "0.1"});
    EXPECT_FALSE(contains(offline.errors, warning)) << offline.errors;
    const Outcome onNetwork = start({"--interface", "127.0.0.1", "--seconds", "0.1"});
    EXPECT_TRUE(contains(onNetwork.errors, warning)) << onNetwork.errors;
}

TEST_F(StartCheck, FindsAllShippedSystemsValid) {
    for (const char* each :
         {"lbr_teleop/lbr_teleop.xml", "lbr_teleop/robot.xml", "lbr_teleop/operator.xml",
          "jog_axis/jog_axis.xml", "gantry/gantry.xml", "swap_gripper/slide.xml",
          "swap_gripper/jaws.xml", "swap_gripper/two_finger.xml",
          "ds402_dual_axis/ds402_dual_axis.xml"}) {
        const Outcome checked =
            cortex({"validate", CORTEX_SOURCE_DIR "/examples/" + std::string{each}});
        EXPECT_EQ(checked.exit, 0) << each << checked.output << checked.errors;
        EXPECT_TRUE(contains(checked.output, ": valid, ")) << checked.output;
    }
}

}  // namespace
}  // namespace cortex::test
