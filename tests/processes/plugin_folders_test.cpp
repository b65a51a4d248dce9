// SPDX-License-Identifier: Apache-2.0
// Plug-ins that no option names: which of them cortex-agent loads, and what it says of the others.
#include "cli/cortex_process.hpp"
#include "core/model_folder.hpp"

#include <filesystem>
#include <map>
#include <string>

#include <sys/stat.h>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

namespace fs = std::filesystem;

// One plant with a counter, and folders that the agent looks into.
class PluginFolders : public testing::Test {
protected:
    PluginFolders() {
        folder.write("types.xml",
                     "<ontology name='t' version='1.0'><include file='base.xml'/>"
                     "<type name='Counter' extends='Device'>"
                     "<data name='count' kind='int'/><data name='gain' kind='float'/>"
                     "<data name='share' kind='float'/><data name='title' kind='string'/></type>"
                     "<type name='TallyCounter' extends='Counter'/>"
                     "<type name='Pump' role='active'>"
                     "<data name='flow' kind='float' unit='m3/s'/></type>"
                     "<type name='Row' extends='Simplex' role='descriptive'/>"
                     "<type name='Hall' extends='Device'/></ontology>");
        folder.write("rules.xml",
                     "<morphology name='m' version='1.0'><include file='base-morphology.xml'/>"
                     "<include file='types.xml'/><rules type='Row'>"
                     "<relationship name='counters' direction='input' target='Counter' min='1' "
                     "max='4' create='Counter'/></rules></morphology>");
        for (const char* each : {"first", "second", "home/.local/lib/cortex/agent"})
            fs::create_directories(folder.path() / each);
    }
    void putLibrary(const std::string& file, const std::string& plugin) const {
        fs::create_symlink(fs::path{CORTEX_BINARY_DIR "/lib/plugins"} / (plugin + ".so"),
                           folder.path() / file);
    }
    void putCounter(const std::string& in) const {
        putLibrary(in + "/counter.so", "counter");
        folder.write(in + "/counter.types", "Counter\n");
    }
    // The agent, with `first` and `second` in its variable.
    Outcome agentOf(const std::string& type, const std::string& options = "") const {
        folder.write("plant.xml",
                     "<system name='s'><morphology file='rules.xml'/>"
                     "<cluster name='plant' frequency='100'/>"
                     "<simplex path='/one' type='" +
                         type + "'/></system>");
        return runProgram("sh",
                          {"-c", "exec " CORTEX_BINARY_DIR "/bin/cortex-agent plant.xml --offline "
                                 "--seconds 0.001 " +
                                     options},
                          {{"HOME", at("home")}, {"CORTEX_AGENT_PLUGINS", variable}},
                          folder.path().string());
    }
    std::string at(const std::string& file) const { return (folder.path() / file).string(); }
    // That it ran, and what it had loaded.
    static void expectLoaded(const Outcome& agent, const std::string& text) {
        EXPECT_EQ(agent.exit, 0) << agent.errors;
        EXPECT_TRUE(contains(agent.output, text + "\n")) << agent.output << agent.errors;
    }
    static void expectRefused(const Outcome& agent, const std::string& text) {
        EXPECT_EQ(agent.exit, 1) << agent.output;
        EXPECT_TRUE(contains(agent.errors, text)) << agent.errors;
    }

    const ModelFolder folder;
    std::string variable = at("first") + ":" + at("second");
};

TEST_F(PluginFolders, BringTheClassOfATypeThatNobodyElseHas) {
    putCounter("second");
    expectLoaded(agentOf("Counter"), "plug-in " + at("second/counter.so") + ": loaded for Counter");
    EXPECT_TRUE(agentOf("Counter").errors.find("no C++ class") == std::string::npos);
}

TEST_F(PluginFolders, BringTheClassOfAnAncestor) {
    putCounter("first");
    const Outcome agent = agentOf("TallyCounter");
    expectLoaded(agent, "plug-in " + at("first/counter.so") + ": loaded for Counter");
    EXPECT_TRUE(contains(agent.errors,
                         "TallyCounter has no class of its own and runs that of "
                         "Counter"))
        << agent.errors;
}

TEST_F(PluginFolders, BringTheClassOfATypeThatARuleCreates) {
    putCounter("first");
    expectLoaded(agentOf("Row"), "plug-in " + at("first/counter.so") + ": loaded for Counter");
}

TEST_F(PluginFolders, AreNotLoadedForWhatNobodyNames) {
    putCounter("first");
    putLibrary("second/pump.so", "plugin-wrong-abi");
    folder.write("second/pump.types", "Pump\nTurbine\n");
    const Outcome agent = agentOf("Counter");
    expectLoaded(agent, "loaded for Counter");
    EXPECT_FALSE(contains(agent.output, "pump.so")) << agent.output;
    EXPECT_FALSE(contains(agent.errors, "pump.so")) << agent.errors;
}

TEST_F(PluginFolders, OutrankEachOtherInTheirOrderAndAnOptionOutranksAll) {
    putCounter("first");
    putCounter("second");
    putCounter("home/.local/lib/cortex/agent");
    expectLoaded(agentOf("Counter"), "plug-in " + at("first/counter.so") + ": loaded for Counter");

    const Outcome named = agentOf("Counter", "--plugin second/counter.so");
    EXPECT_EQ(named.exit, 0) << named.errors;
    EXPECT_FALSE(contains(named.output, "loaded for")) << named.output;

    variable = "";
    expectLoaded(agentOf("Counter"), "plug-in " + at("home/.local/lib/cortex/agent/counter.so") +
                                         ": loaded for Counter");
}

TEST_F(PluginFolders, ThatListATypeWithoutItsPluginNameThePackage) {
    folder.write("first/counter.types", "# of the hall\npackage hall-counters\n\nCounter  # it\n");
    putCounter("second");  // an older one, perhaps
    expectRefused(agentOf("Counter"), "/one (Counter): " + at("first/counter.so") +
                                          " is not there, and " + at("first/counter.types") +
                                          " says that Counter is in it; install package "
                                          "hall-counters");
    folder.write("first/counter.types", "Counter\n");
    expectRefused(agentOf("Counter"),
                  "says that Counter is in it; put it there, or remove the "
                  "list");
}

// As where cortex-tools is installed, and the packages that it suggests are not.
TEST_F(PluginFolders, NameThePackagesOfWhatIsShipped) {
    const std::map<std::string, std::string> packages{{"ModbusIoDevice", "modbus/cortex-modbus"},
                                                      {"MujocoWorld", "physics/cortex-mujoco"}};
    for (const auto& [type, list] : packages) {
        const std::string package = list.substr(list.find('/') + 1);
        fs::copy_file(CORTEX_SOURCE_DIR "/" + list + ".types", at("first/" + package + ".types"));
        folder.write("rules.xml",
                     "<morphology name='m' version='1.0'>"
                     "<include file='cortex-morphology.xml'/></morphology>");
        expectRefused(agentOf(type), "says that " + type + " is in it; install package " + package);
    }
}

TEST_F(PluginFolders, TellWhyAPluginIsNotLoaded) {
    putLibrary("first/pump.so", "plugin-wrong-abi");
    folder.write("first/pump.types", "Pump\nTurbine\n");
    expectRefused(agentOf("Pump"), "/one (Pump): plug-in " + at("first/pump.so") +
                                       " has plug-in ABI 999, this program has ");
    EXPECT_TRUE(contains(agentOf("Pump").errors, "build it against this version of cortex"));
}

TEST_F(PluginFolders, AndTheirPluginsHaveTheSameTypes) {
    putLibrary("first/counter.so", "counter");
    folder.write("first/counter.types", "Counter\nHall\n");
    for (const char* type : {"Counter", "Hall"}) {
        expectRefused(agentOf(type), "plug-in " + at("first/counter.so") +
                                         " has no class for type Hall, which " +
                                         at("first/counter.types") +
                                         " lists; take the line out, or add the class");
    }
    folder.write("first/counter.types", "Hall\n");
    expectRefused(agentOf("Hall"), "has no class for type Hall");
    putLibrary("second/good.so", "plugin-good");
    folder.write("second/good.types", "Pump\n");
    expectRefused(agentOf("Pump"), "plug-in " + at("second/good.so") +
                                       " has a class for type Turbine, which " +
                                       at("second/good.types") + " does not list; add it there");
}

TEST_F(PluginFolders, DoNotListATypeTwice) {
    putCounter("first");
    putLibrary("first/other.so", "counter");
    folder.write("first/other.types", "Counter\n");
    expectRefused(agentOf("Counter"), "/one (Counter): " + at("first/counter.types") + " and " +
                                          at("first/other.types") +
                                          " both list type Counter; take it out of one, or name "
                                          "the plug-in by --plugin");
}

TEST_F(PluginFolders, ThatAreWrongAreToldAndHinderNobody) {
    putCounter("second");
    folder.write("first/a.types", "Counter Hall\n");
    folder.write("first/b.types", "# nothing yet\n");
    folder.write("first/c.types", "Hall\n\x1b[2J\n");
    folder.write("first/i.types", "Hall\npackage\n");
    fs::create_directory(folder.path() / "first/d.types");
    ASSERT_EQ(mkfifo(at("first/f.types").c_str(), 0600), 0);
    ASSERT_EQ(mkfifo(at("first/g.so").c_str(), 0600), 0);
    folder.write("first/h.types", "hall\n");
    putLibrary("first/e.so", "counter");
    variable += ":nowhere";

    const Outcome agent = agentOf("Counter");

    expectLoaded(agent, "plug-in " + at("second/counter.so") + ": loaded for Counter");
    for (const std::string& text :
         {at("first/a.types") + ":1: 'Counter Hall' is no name of a type; write one in each line",
          at("first/b.types") + ": no type could be read from it",
          at("first/c.types") + ":2: '\\x1b[2J' is no name of a type",
          at("first/i.types") + ":2: 'package' has no name; write 'package NAME'",
          at("first/d.types") + " is no file; put one there, or take it away",
          at("first/f.types") + " is no file", at("first/g.so") + " is no file",
          at("first/h.types") + ":1: type hall is written Hall in the ontology; write it so",
          at("first/e.so") + " is never loaded: e.types is not beside it",
          std::string{"CORTEX_AGENT_PLUGINS names nowhere, which is no folder"}}) {
        EXPECT_TRUE(contains(agent.errors, text)) << text << "\n" << agent.errors;
    }
}

TEST_F(PluginFolders, MayHaveAByteOrderMarkInTheirLists) {
    putLibrary("first/counter.so", "counter");
    folder.write("first/counter.types",
                 "\xef\xbb\xbf"
                 "Counter\r\n");
    expectLoaded(agentOf("Counter"), "plug-in " + at("first/counter.so") + ": loaded for Counter");
}

TEST_F(PluginFolders, NeverWaitForAPluginThatIsAPipe) {
    ASSERT_EQ(mkfifo(at("first/counter.so").c_str(), 0600), 0);
    folder.write("first/counter.types", "Counter\n");
    expectRefused(agentOf("Counter"), "plug-in " + at("first/counter.so") +
                                          " cannot be loaded: it is no file; name the shared "
                                          "object itself");
}

TEST_F(PluginFolders, HaveNothingForATypeThatNoneLists) {
    putCounter("first");
    expectRefused(agentOf("Hall"), "no C++ class implements the active type Hall");
}

}  // namespace
}  // namespace cortex::test
