// SPDX-License-Identifier: Apache-2.0
// `cortex shell`: of files and pipes, and as a person uses it on a terminal.
#include "cli/controlled_agent.hpp"
#include "cli/typed_shell.hpp"

#include <csignal>
#include <regex>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

const std::map<std::string, std::string> withPatience{
    {"CORTEX_TIMEOUT", std::to_string(patience.count())}};

struct CortexShell : CortexControl {
    Outcome runsFile(const std::string& lines, const Words& options = {}) {
        return cortex(Words{"shell", folder.write("lines.txt", lines).string()} + options + network,
                      withPatience);
    }
};

TEST_F(CortexShell, RunsTheLinesOfAFileWithOneParticipant) {
    const Outcome outcome = runsFile(
        "# in the morning\n\n"
        "take /drive\n"
        "set /drive naturalFrequency=8  # slowly\n"
        "cortex call /drive startup\n"
        "list '/drive'\n"
        "show /drive\n"
        "watch /drive.state --count 1\n"
        "events /drive\n"
        "events /drive\n"
        "agents\n"
        "graph\n"
        "types SimulatedAxis\n"
        "leases\n"
        "doctor\n");

    EXPECT_TRUE(contains(outcome.output, "you control /drive")) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "SimulatedAxis  active  mixer  Active  good"))
        << outcome.output << outcome.errors;
    const auto first = outcome.output.find("Standby -> StartingUp");
    EXPECT_NE(outcome.output.find("Standby -> StartingUp", first + 1), std::string::npos)
        << "events of the past, twice";
    EXPECT_TRUE(contains(outcome.output, "  you\n")) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "/drive.state  Active")) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "warnings")) << "doctor" << outcome.output;
    EXPECT_TRUE(leases().empty()) << "released at the end";
    EXPECT_FALSE(hasEvent("no longer has control"));
}

TEST_F(CortexShell, CommandsOnBehalfOfWhoUsesItUnlessACommandIsForSomebodyElse) {
    const Outcome outcome = runsFile(
        "take /drive\n"
        "set /drive naturalFrequency=8\n"
        "set /drive naturalFrequency=9 --for bob\n"
        "call /drive startup\n"
        "release /drive\n",
        {"--name", "alice@a-host-with-a-name-that-is-long"});

    EXPECT_EQ(outcome.exit, 0) << outcome.errors;
    const std::string events = live({"events"}).output;
    for (const char* command : {"alice: takeControl(prefix=\"/drive\")",
                                "alice: set(naturalFrequency=8)", "bob: set(naturalFrequency=9)",
                                "alice: startup()", "alice: releaseControl(prefix=\"/drive\")"}) {
        EXPECT_TRUE(contains(events, std::string{" for "} + command + ": Done")) << events;
    }
}

// Below the path of its agent, which the shell views all the time.
TEST(CortexShellFile, ShowsAfterACommandWhatItHasDone) {
    const ModelFolder folder;
    const std::string system =
        std::regex_replace(mixerSystem(), std::regex{"\"/drive\""}, "\"/mixer/drive\"");
    const Background agent{agentCommand(folder.write("mixer.xml", system).string())};
    std::string lines = "list\n";
    for (int i = 5; i < 15; ++i) {
        lines += "set /mixer/drive naturalFrequency=" + std::to_string(i) +
                 "\nshow /mixer/drive --json\n";
    }
    const Outcome outcome = lookUntil(
        [&] {
            return cortex(Words{"shell", folder.write("lines.txt", lines).string()} + network,
                          withPatience);
        },
        [](const Outcome& each) { return each.exit == 0; });
    const std::regex shown{R"("naturalFrequency": \{[^}]*"value": ([0-9.]+))"};
    int expected = 5;
    for (std::sregex_iterator each{outcome.output.begin(), outcome.output.end(), shown}, end;
         each != end; ++each) {
        EXPECT_EQ(std::stod((*each)[1]), expected++) << outcome.output;
    }
    EXPECT_EQ(expected, 15) << outcome.output << outcome.errors;
}

TEST_F(CortexShell, StopsAtTheFirstLineThatFailsUnlessToldToGoOn) {
    const std::string lines = "list\nshow /drvie\ncall /drive startup\nlist\n";

    const Outcome stopped = runsFile(lines);
    EXPECT_EQ(stopped.exit, 3);
    EXPECT_TRUE(contains(stopped.errors, "lines.txt:2: 'show /drvie' ended with exit code 3"))
        << stopped.errors;
    EXPECT_FALSE(contains(stopped.errors, "lines.txt:3")) << stopped.errors;

    const Outcome all = runsFile(lines, {"--keep-going"});
    EXPECT_EQ(all.exit, 3) << "of the first that failed";
    EXPECT_TRUE(contains(all.errors, "lines.txt:3: 'call /drive startup' ended with exit code 1"))
        << all.errors;
    EXPECT_EQ(runsFile("list\nquit\nnonsense\n").exit, 0);
    EXPECT_EQ(runsFile("set /drive 'a\n").exit, 2);
    EXPECT_EQ(cortex({"shell", folder.path().string()}).exit, 3) << "no file";
    EXPECT_EQ(cortex({"shell", "no-such-file"}).exit, 3);
}

TEST_F(CortexShell, HelpListsAndExplainsItsVerbs) {
    const Outcome outcome = runsFile("help\nhelp handover\n");
    EXPECT_EQ(outcome.exit, 0) << outcome.errors;
    for (const char* verb : {"list", "watch", "take", "release", "handover", "quit"}) {
        EXPECT_TRUE(contains(outcome.output, std::string{"\n  "} + verb + " ")) << verb;
    }
    EXPECT_FALSE(contains(outcome.output, "\n  shell ")) << "no shell in a shell";
    for (const char* usage : {"  list [PREFIX] [OPTIONS]", "  set PATH ITEM=VALUE... [OPTIONS]",
                              "  handover PREFIX TO [OPTIONS]", "  help [VERB]"}) {
        EXPECT_TRUE(contains(outcome.output, usage)) << usage << '\n' << outcome.output;
    }

    const Outcome wrong = runsFile("help wach\n");
    EXPECT_EQ(wrong.exit, 2);
    EXPECT_TRUE(contains(wrong.errors, "nearest of: watch")) << wrong.errors;
    EXPECT_TRUE(contains(runsFile("tak /\n").errors, "nearest of: take"));
}

TEST_F(CortexShell, RunsLinesOfAPipe) {
    std::string command = "printf 'list /drive\\nnonsense\\n' | exec \"$0\" shell";
    for (const std::string& each : network) command += " " + each;

    const Outcome outcome =
        runProgram("sh", {"-c", command, CORTEX_BINARY_DIR "/bin/cortex"}, withPatience);

    EXPECT_EQ(outcome.exit, 2);
    EXPECT_TRUE(contains(outcome.output, "SimulatedAxis")) << outcome.output;
    EXPECT_TRUE(contains(outcome.errors, "<stdin>:2: 'nonsense'")) << outcome.errors;
}

TEST_F(CortexShell, ControlIsKeptWhileAPersonThinksAndReleasedAtTheEnd) {
    TypedShell shell{folder};
    shell.run("take /drive", "cortex [/drive]");
    ASSERT_TRUE(leasesShow("/drive"));
    const std::int64_t taken = cycleOfAgent();
    ASSERT_TRUE(becomesTrue([&] { return cycleOfAgent() > taken + 60; })) << "3 s";

    shell.run("call /drive startup", "Done");
    shell.run("leases", "  you");
    shell.run("set /controller mode=1 --take", "has no 'mode'");
    shell.run("call /controller startup --take", "cortex [/drive]");
    EXPECT_EQ(leases().size(), 1U) << "for the verb alone";
    shell.run("release /drive", "cortex> ");
    EXPECT_TRUE(leases().empty());
    shell.run("release /drive", "you do not hold /drive; you hold nothing");
    shell.run("take /axis", "cortex [/axis]");

    EXPECT_EQ(shell.exit("\x04"), 0) << shell.output();
    EXPECT_TRUE(leases().empty());
    EXPECT_FALSE(hasEvent("no longer has control"));
}

TEST_F(CortexShell, AnInterruptEndsAVerbAndClearsALineAndLeavesTheShell) {
    TypedShell shell{folder};
    shell.enter("watch /mixer.commandCount");
    ASSERT_TRUE(shell.shows("Z  /mixer.commandCount")) << shell.output();

    shell.type("\x03");
    EXPECT_TRUE(shell.shows("interrupted")) << shell.output();
    EXPECT_TRUE(shell.shows("cortex> ")) << shell.output();
    shell.typeLine("nonsense");
    shell.type("\x03");
    EXPECT_TRUE(shell.shows("\n")) << shell.output();
    shell.run("list /drive", "SimulatedAxis");
    EXPECT_FALSE(contains(shell.output(), "there is no verb")) << shell.output();
    shell.enter("top");
    EXPECT_TRUE(shell.shows("\033[?1049h")) << shell.output();
    shell.type("q");
    EXPECT_TRUE(shell.shows("\033[?1049l")) << shell.output();
    shell.run("list /drive", "SimulatedAxis");
    shell.enter("quit");

    EXPECT_EQ(shell.exit(), 0);
}

TEST_F(CortexShell, ARequestToEndReleasesControl) {
    TypedShell shell{folder};
    shell.run("take /drive", "cortex [/drive]");

    shell.signal(SIGTERM);

    EXPECT_FALSE(shell.shows("never"));
    EXPECT_EQ(shell.exit(), -SIGTERM);
    EXPECT_TRUE(leases().empty());
    EXPECT_FALSE(hasEvent("no longer has control"));
}

TEST_F(CortexShell, CompletesVerbsPathsCommandsAndParameters) {
    TypedShell shell{folder};
    shell.run("list", "/mixer");
    // The terminal gets what is added to the line.
    const auto completes = [&](const std::string& typed, const std::string& shown) {
        shell.typeLine(typed);
        shell.type("\t");
        EXPECT_TRUE(shell.shows(shown)) << typed << shell.output();
        shell.type("\x03");
        EXPECT_TRUE(shell.shows("> ")) << shell.output();
    };

    completes("handov", "er ");
    completes("show /dri", "ve ");
    completes("watch /drive.naturalF", "requency ");
    completes("call /controller mov", "eTo ");
    completes("call /controller moveTo sp", "eedShare=");
    completes("set /drive da", "mpingRatio=");
    completes("call /drive --ti", "meout ");
    shell.typeLine("show /axis/");
    shell.type("\t");
    EXPECT_TRUE(shell.shows("/axis/demanded")) << "several" << shell.output();
    EXPECT_TRUE(shell.shows("/axis/observed")) << shell.output();
}

TEST_F(CortexShell, RemembersLinesAlsoOfTheLastShell) {
    {
        TypedShell shell{folder};
        shell.run("list /drive", "SimulatedAxis");
        shell.typeUntil("\033[A\r", "SimulatedAxis");
        shell.enter("quit");
        EXPECT_EQ(shell.exit(), 0);
    }
    TypedShell next{folder};
    next.typeUntil("\033[A\033[A\r", "SimulatedAxis");
}

TEST_F(CortexShell, TellsAtThePromptThatALeaseWasLost) {
    TypedShell shell{folder};
    shell.run("take /drive", "cortex [/drive]");
    shell.mark();

    agent->end(SIGKILL);
    EXPECT_TRUE(shell.shows("control of /drive of agent mixer was lost")) << shell.output();

    start();
    shell.run("take /drive", "cortex [/drive]");
}

TEST_F(CortexShell, ShowsTheLastValuesOfALostAgentInBrackets) {
    TypedShell shell{folder};
    shell.run("show /drive", "Standby");
    shell.run("take /drive", "cortex [/drive]");
    shell.mark();
    agent->end(SIGKILL);
    ASSERT_TRUE(shell.shows("control of /drive of agent mixer was lost")) << shell.output();

    shell.run("show /drive --timeout 1", "[Standby]");
    EXPECT_TRUE(contains(shell.output(), "[12")) << shell.output();
    EXPECT_TRUE(std::regex_search(shell.output(), std::regex{"startPosition +0\\.5 "}))
        << "a constant as it is";
}

TEST_F(CortexShell, HandsControlOverToAnotherShellThatKeepsIt) {
    TypedShell one{folder}, other{folder};
    one.run("take /drive", "cortex [/drive]");
    ASSERT_TRUE(leasesShow("/drive"));
    other.run("take /", "on host");
    other.mark();

    one.run("handover /drive " + other.name, "cortex> ");

    EXPECT_TRUE(other.shows("control of /drive of agent mixer is yours now")) << other.output();
    const std::int64_t given = cycleOfAgent();
    ASSERT_TRUE(becomesTrue([&] { return cycleOfAgent() > given + 60; })) << "3 s";
    const json shown = leases();
    ASSERT_EQ(shown.size(), 1U) << shown;
    EXPECT_EQ(shown[0]["holder"], other.name);
    one.run("set /drive naturalFrequency=8", "is held by " + other.name);
    other.run("set /drive naturalFrequency=8", "Done");
}

}  // namespace
}  // namespace cortex::test
