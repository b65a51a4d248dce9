// SPDX-License-Identifier: Apache-2.0
// `cortex-agent --check-hooks` from outside: what it says of plug-ins.
#include "cli/cortex_process.hpp"
#include "core/model_folder.hpp"

#include <fstream>
#include <regex>
#include <string>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

struct Checked {
    int exitCode = -1;
    std::string output;

    bool says(const std::string& text) const { return output.find(text) != std::string::npos; }
};

Checked check(const std::string& arguments) {
    const Outcome outcome =
        runProgram("sh", {"-c", "exec " CORTEX_BINARY_DIR
                                "/bin/cortex-agent --offline --check-hooks --startup " +
                                    arguments + " 2>&1"});
    Checked checked;
    // What addr2line leaves out where something was inlined into the function.
    checked.output =
        std::regex_replace(outcome.output, std::regex{"in (Misdeeds|Thrower)::"}, "in ");
    checked.exitCode = outcome.exit;
    return checked;
}

// Where the plug-in does what its comment says: "misdeeds.cpp:32".
std::string place(const std::string& comment) {
    std::ifstream source{CORTEX_SOURCE_DIR "/tests/plugins/misdeeds.cpp"};
    int number = 1;
    for (std::string line; std::getline(source, line); ++number) {
        if (line.ends_with("// " + comment)) return "misdeeds.cpp:" + std::to_string(number);
    }
    return "no line of misdeeds.cpp has the comment " + comment;
}

TEST(CheckHooks, NamesEachMisdeedOfAPluginWithItsHookAndLine) {
    const ModelFolder folder;
    folder.write("types.xml",
                 "<ontology name='t' version='1.0'><include file='base.xml'/>"
                 "<type name='Misdeeds' extends='Processor'/>"
                 "<type name='Thrower' extends='Processor'/></ontology>");
    folder.write("rules.xml",
                 "<morphology name='m' version='1.0'><include file='base-morphology.xml'/>"
                 "<include file='types.xml'/></morphology>");
    const auto system = folder.write(
        "plant.xml",
        "<system name='s'><morphology file='rules.xml'/><cluster name='plant' frequency='100'/>"
        "<simplex path='/o1' type='DigitalIoConcept'/><simplex path='/o2' type='DigitalIoConcept'/>"
        "<simplex path='/bad' type='Misdeeds'><relate rule='outputs' to='/o1'/></simplex>"
        "<simplex path='/t' type='Thrower'><relate rule='outputs' to='/o2'/></simplex></system>");

    const Checked checked =
        check(system.string() + " --seconds 1 --plugin " CORTEX_MISDEEDS_PLUGIN);

    EXPECT_EQ(checked.exitCode, 4) << "the thrower does not follow, and that comes first";
    const auto expect = [&](const std::string& hook, const std::string& what,
                            const std::string& comment) {
        const std::string simplex =
            hook == "thrower" ? "/t (Thrower), stateActive: " : "/bad (Misdeeds), " + hook + ": ";
        const std::string function = hook == "thrower" ? "stateActive" : hook;
        const std::string words = simplex + what + ", in " + function + " at " + place(comment);
        EXPECT_TRUE(checked.says("hook check: " + words + "\n")) << words << checked.output;
        EXPECT_TRUE(checked.says(": " + words + "\n")) << words << checked.output;
    };
    expect("loopStart", "allocation of 24 bytes", "the allocation");
    expect("loopStart", "memory given back", "the release");
    expect("stateStandby", "lock by pthread_mutex_lock", "the lock");
    expect("stateStartingUp", "system call close", "the system call");
    expect("stateActive", "output to standard output by puts", "the output");
    expect("loopEnd", "page fault", "the page fault");
    expect("thrower", "throw of std::logic_error", "the throw");
    EXPECT_TRUE(checked.says("hook check: violations at 8 places\n")) << checked.output;
}

TEST(CheckHooks, EndsWithZeroWhereItFindsNothing) {
    const Checked checked = check(CORTEX_SOURCE_DIR
                                  "/examples/water/water.xml --seconds 2 --log /dev/null "
                                  "--plugin " CORTEX_WATER_PLUGIN);

    EXPECT_EQ(checked.exitCode, 0) << checked.output;
    EXPECT_TRUE(checked.says("hook check: no violation\n")) << checked.output;
}

#ifdef CORTEX_HAS_MODBUS
// With nobody at its address, and with a number that its register cannot hold.
TEST(CheckHooks, FindsNothingInACouplerBehindModbus) {
    const ModelFolder folder;
    const auto system = folder.write(
        "coupler.xml",
        "<system name='s'><morphology file='devices-morphology.xml'/>"
        "<cluster name='plant' frequency='100'/><simplex path='/lamps' type='DigitalOutputGroup'/>"
        "<simplex path='/fans' type='AnalogueOutputGroup'><set data='value' value='1e9 "
        "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0'/>"
        "</simplex><simplex path='/buttons' type='DigitalInputGroup'/>"
        "<simplex path='/levels' type='AnalogueInputGroup'/>"
        "<simplex path='/coupler' type='ModbusIoDevice'>"
        "<relate rule='digitalOutputs' to='/lamps'/><relate rule='analogueOutputs' to='/fans'/>"
        "<relate rule='digitalInputs' to='/buttons'/><relate rule='analogueInputs' to='/levels'/>"
        "<set data='coilsAt' value='0'/><set data='discreteInputsAt' value='0'/>"
        "<set data='inputRegistersAt' value='0'/><set data='holdingRegistersAt' value='0'/>"
        "<set data='address' value='127.0.0.1:1'/></simplex></system>");

    const Checked checked = check(system.string() + " --seconds 2 --priority 0");

    EXPECT_EQ(checked.exitCode, 0) << checked.output;
    EXPECT_TRUE(checked.says("cannot hold")) << checked.output;
    EXPECT_TRUE(checked.says("hook check: no violation\n")) << checked.output;
}
#endif

}  // namespace
}  // namespace cortex::test
