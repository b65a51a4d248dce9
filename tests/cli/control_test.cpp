// SPDX-License-Identifier: Apache-2.0
// Control of the plant from the command line: `--take` and `leases`.
#include "cli/controlled_agent.hpp"
#include "cli/on_terminal.hpp"
#include "common/person_name.hpp"

#include <csignal>
#include <memory>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;
const std::string others = " 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0";
const std::string longWay = "pose=1e5" + others, shortWay = "pose=20" + others,
                  startPose = "pose=0" + others;

using Words = std::vector<std::string>;

TEST_F(CortexControl, TakeCommandsWhereControlIsRequiredAndReleasesItAtTheEnd) {
    const Outcome without = live({"call", "/drive", "startup"});
    EXPECT_EQ(without.exit, 1);
    EXPECT_TRUE(contains(without.output, "control is required")) << without.output;

    EXPECT_TRUE(contains(without.errors, "--take")) << without.errors;

    EXPECT_EQ(live({"set", "/drive", "naturalFrequency=8", "--take"}).exit, 0);
    EXPECT_EQ(live({"call", "/drive", "startup", "--take"}).exit, 0);
    EXPECT_EQ(live({"call", "/mixer", "startup", "--take"}).exit, 0) << "of everything";
    EXPECT_EQ(live({"call", "/drive", "startup", "--take"}).exit, 1) << "it is Active already";

    EXPECT_TRUE(leases().empty()) << leases();
    EXPECT_FALSE(hasEvent("no longer has control")) << "released, not lost";
}

TEST_F(CortexControl, RestoreTakesWhatItChanges) {
    const std::string saved = (folder.path() / "saved.xml").string();
    ASSERT_EQ(live({"save", saved}).exit, 0);
    ASSERT_EQ(live({"set", "/drive", "naturalFrequency=8", "--take"}).exit, 0);

    EXPECT_EQ(live({"restore", saved}).exit, 1);
    const json restored =
        liveJson({"restore", saved, "--take", "--for", "Zora of the night"}, "restore");

    EXPECT_EQ(restored["results"][0]["outcome"], "Done") << restored;
    EXPECT_TRUE(leases().empty()) << leases();
    const std::string events = live({"events"}).output;
    for (const char* command : {"takeControl(prefix=\"/drive\")", "set(", "releaseControl("}) {
        EXPECT_TRUE(contains(events, std::string{" for Zora of the night: "} + command)) << events;
    }
}

TEST_F(CortexControl, ARefusalNamesTheHolderItsHostAndSinceWhen) {
    Holder holder{"/drive"};

    const json shown = leases();
    ASSERT_EQ(shown.size(), 1U) << shown;
    EXPECT_EQ(shown[0]["holder"], holder.name());
    EXPECT_EQ(shown[0]["prefix"], "/drive");
    EXPECT_EQ(shown[0]["mine"], false);
    const std::string since = shown[0]["since"], host = shown[0]["host"];
    for (const Words& words : {Words{"set", "/drive", "naturalFrequency=8", "--take"},
                               Words{"call", "/mixer", "startup", "prefix=/", "--take"}}) {
        const Outcome refused = live(words);
        EXPECT_EQ(refused.exit, 1) << refused.output;
        EXPECT_TRUE(contains(refused.errors, holder.name() + " on host " + host +
                                                 " holds /drive of agent mixer since " +
                                                 since.substr(0, 16)))
            << refused.errors;
        EXPECT_TRUE(contains(refused.errors, "must release it or hand it over")) << refused.errors;
    }
    EXPECT_EQ(live({"call", "/controller", "startup", "--take"}).exit, 0) << "free beside it";
    EXPECT_TRUE(contains(live({"leases"}).output, holder.name()));
}

TEST_F(CortexControl, ShutdownNeedsNoLease) {
    ASSERT_EQ(live({"call", "/drive", "startup", "--take"}).exit, 0);
    Holder holder{"/"};

    const Outcome outcome = live({"call", "/drive", "shutdown", "--take"});

    EXPECT_EQ(outcome.exit, 0) << outcome.errors;
}

// As `cortex new-system` writes it, at 1 kHz: agents of other tests run slower.
TEST(CortexShipped, KeepsItsPaceAndItsHolderForLongerThanALease) {
    const ModelFolder folder;
    const std::string file = folder.write("mixer.xml", mixerSystem(1000)).string();
    const Background agent{agentCommand(file) + Words{"--startup"}};
    const auto isActive = [] {
        return liveJson({"list", "/drive"}, "list")[0]["state"] == "Active";
    };
    ASSERT_TRUE(becomesTrue(isActive));
    const Holder holder{"/"};
    const std::int64_t then = cycleOfAgent();

    ASSERT_TRUE(becomesTrue([&] { return cycleOfAgent() > then + 3000; })) << "longer than 2 s";

    EXPECT_EQ(liveJson({"agents"}, "agents")[0]["state"], "running");
    EXPECT_TRUE(isActive());
    ASSERT_TRUE(leasesShow("/"));
    EXPECT_EQ(leases()[0]["holder"], holder.name());
    EXPECT_FALSE(hasEvent("no longer has control"));
}

// A call whose move lasts minutes, once its progress is shown. Again, where the agent was silent
// for a second as control was taken: nothing was executed then.
std::unique_ptr<OnTerminal> longCall() {
    const auto begin = [] {
        return std::make_unique<OnTerminal>(cortexCommand(
            {"call", "/controller", "moveTo", "speedShare=0.01", "--take", "--timeout", "100"}));
    };
    return lookUntil(begin, [](const std::unique_ptr<OnTerminal>& call) {
        return call->shows("moveTo: ") || !contains(call->output(), "no control of /controller") ||
               !contains(call->output(), "not heard");
    });
}

TEST_F(CortexControl, AnInterruptReleasesControl) {
    ASSERT_EQ(live({"call", "/mixer", "startup", "--take"}).exit, 0);
    ASSERT_EQ(live({"set", "/controller", longWay, "--take"}).exit, 0);
    for (const int signal : {SIGINT, SIGTERM}) {
        const auto call = longCall();
        ASSERT_TRUE(leasesShow("/controller")) << call->output();

        call->signal(signal);

        EXPECT_FALSE(call->shows("Done"));
        EXPECT_EQ(call->exit(), -signal) << "as without --take: " << call->output();
        EXPECT_TRUE(contains(call->output(), "may go on without us")) << call->output();
        EXPECT_TRUE(leases().empty()) << leases();
    }
    EXPECT_FALSE(hasEvent("no longer has control")) << "released, not lost";
}

// A move of some seconds.
TEST_F(CortexControl, ProgressOfALongCommandIsShownOnStandardErrorWhileItRuns) {
    ASSERT_EQ(live({"call", "/mixer", "startup", "--take"}).exit, 0);
    ASSERT_EQ(live({"set", "/controller", shortWay, "--take"}).exit, 0);
    const Words move{"call", "/controller", "moveTo", "speedShare=0.01", "--take"};
    // Again, where the loop stood still for so long that an axis counted as lost.
    const auto isLost = [](const std::string& output) {
        return contains(output, "Failed: its input");
    };

    const Outcome lines = lookUntil([&] { return live(move); },
                                    [&](const Outcome& each) { return !isLost(each.output); });
    EXPECT_EQ(lines.output, "Done\n");
    EXPECT_TRUE(contains(lines.errors, "moveTo: ")) << lines.errors;
    EXPECT_TRUE(lines.errors.ends_with(" %\n")) << lines.errors;
    EXPECT_FALSE(contains(lines.errors, "\r")) << lines.errors;

    ASSERT_EQ(live({"set", "/controller", startPose, "--take"}).exit, 0);
    const auto onTerminal = [&] {
        return std::make_unique<OnTerminal>(cortexCommand(move + Words{"--timeout", patient}));
    };
    const auto terminal = lookUntil(onTerminal, [&](const std::unique_ptr<OnTerminal>& call) {
        return call->shows("\r\033[KDone") || !isLost(call->output());
    });
    EXPECT_TRUE(contains(terminal->output(), "\r\033[KmoveTo: ")) << terminal->output();
    EXPECT_TRUE(contains(terminal->output(), "\r\033[KDone"))
        << "on a line that is empty again: " << terminal->output();
    EXPECT_EQ(terminal->exit(), 0);
    EXPECT_EQ(live({"call", "/drive", "shutdown"}).errors, "") << "no long command";
}

TEST_F(CortexControl, ALongCommandThatIsNotWaitedForAnyLongerIsKnownToRun) {
    ASSERT_EQ(live({"call", "/mixer", "startup", "--take"}).exit, 0);
    ASSERT_EQ(live({"set", "/controller", longWay, "--take"}).exit, 0);

    const auto leave = [] {
        return cortex(Words{"call", "/controller", "moveTo", "speedShare=0.01", "--take"} +
                      network + Words{"--timeout", "2"});
    };
    // Again, where the loop stood still for so long that an axis counted as lost.
    const Outcome left = lookUntil(leave, [](const Outcome& each) { return each.exit == 4; });

    EXPECT_EQ(left.exit, 4) << left.output << left.errors;
    EXPECT_TRUE(contains(left.output, "still running at ")) << left.output;
    EXPECT_TRUE(contains(left.output, " %, not waited for any longer\n")) << left.output;
}

TEST_F(CortexControl, ALeaseEndsWithAHolderThatWasKilled) {
    ASSERT_EQ(live({"call", "/mixer", "startup", "--take"}).exit, 0);
    ASSERT_EQ(live({"set", "/controller", longWay, "--take"}).exit, 0);
    const auto call = longCall();
    ASSERT_TRUE(leasesShow("/controller")) << call->output();

    call->signal(SIGKILL);

    const std::string lost = " for " + common::nameInCommand(common::personName("")) +
                             " no longer has control of /controller";
    EXPECT_TRUE(becomesTrue([&] { return hasEvent(lost); }));
    EXPECT_TRUE(leases().empty());
}

}  // namespace
}  // namespace cortex::test
