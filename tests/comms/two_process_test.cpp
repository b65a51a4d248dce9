// SPDX-License-Identifier: Apache-2.0
// Two processes on the loopback interface: one ends in order, is killed, and starts anew.
#include "cortex/comms/dds_interface.hpp"
#include "cortex/comms/mirror.hpp"

#include "comms/inbox.hpp"
#include "support/probe.hpp"

#include <csignal>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

class FarAgent {
public:
    FarAgent() {
        int input[2];
        EXPECT_EQ(pipe(input), 0);
        const std::string domain = std::to_string(loopback().domain);
        process_ = fork();
        if (process_ == 0) {
            dup2(input[0], STDIN_FILENO);
            close(input[0]);
            close(input[1]);
            execl(CORTEX_BINARY_DIR "/bin/far-agent", "far-agent", domain.c_str(), nullptr);
            _exit(127);
        }
        close(input[0]);
        input_ = input[1];
        test::hopeless = [child = process_] {
            const std::string how = test::howItEnded(child);
            return how.empty() ? how : "far-agent " + how;
        };
    }
    ~FarAgent() {
        if (process_ > 0) kill();
    }
    void kill() {
        ::kill(process_, SIGKILL);
        end();
    }
    // Its exit code; ThreadSanitizer's is not 0 where it found something.
    int end() {
        test::hopeless = {};
        close(input_);
        int status = 0;
        waitpid(process_, &status, 0);
        process_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

private:
    pid_t process_ = 0;
    int input_ = -1;
};

// "near" links /axis of the other process.
struct TwoProcesses : testing::Test {
    TwoProcesses() {
        near.tree.relateRemote(near.probe("/reader"), "observed", "/axis");
        near.cluster->addInterface<DdsInterface>(loopback());
        near.start();
    }
    bool axisIs(Quality quality) {
        return comesTrue([&] {
            near.step();
            return near.quality("/axis") == quality;
        });
    }

    test::ProbeCluster near{{}, "near"};
};

TEST_F(TwoProcesses, LinkAndCommandAndEndInOrder) {
    FarAgent far;
    ASSERT_TRUE(axisIs(Quality::Good));
    EXPECT_EQ(near.number("/axis", "position"), 2.0);
    Mirror tool{"tool", loopback()};
    tool.view({"/"}, 100);
    EXPECT_TRUE(tool.waitForOwner("/probe", test::patience));
    EXPECT_TRUE(tool.waitForValues(test::patience));
    for (int i = 0; i < 10; ++i) {
        const CommandAnswer answer = tool.call("/probe", "poke", {}, test::patience);
        EXPECT_EQ(answer.outcome, Outcome::Done) << answer.why;
    }

    EXPECT_EQ(far.end(), 0);
    EXPECT_TRUE(axisIs(Quality::Lost));
}

TEST_F(TwoProcesses, LinkAgainAfterOneWasKilled) {
    for (int round = 0; round < 2; ++round) {
        FarAgent far;
        ASSERT_TRUE(axisIs(Quality::Good)) << round;
        far.kill();
        EXPECT_TRUE(axisIs(Quality::Lost)) << round;
    }
}

// The chief of "near" starts and stops /probe of the other process.
TEST(TwoProcessesOfAChief, StartAndStopASimplexOfTheOtherAlsoAfterAKill) {
    test::ProbeCluster near{{}, "near"};
    test::Probe& chief = near.probe("/chief");
    near.tree.relateRemote(chief, "before", "/probe", "Probe");
    test::Probe::LifeCycleSender other;
    State wanted = State::Standby, asked = State::Standby;
    bool done = false;  // what was asked for last was answered so at least once
    chief.onPopulate = [&](test::Probe& probe) { other = probe.lifeCycle(probe.input("before")); };
    chief.onLoopEnd = [&](test::Probe&, const Tick&) {
        // The answer may come before the state does; then the chief asks once more, in vain.
        if (asked == wanted && other.answer().outcome == Outcome::Done) done = true;
        if (other.state() == wanted) return;
        asked = wanted;
        if (wanted == State::Active)
            other.startup();
        else
            other.shutdown();
    };
    near.cluster->addInterface<DdsInterface>(loopback());
    near.start();
    const auto becomes = [&](State state) {
        wanted = state;
        done = false;
        return comesTrue([&] {
            near.step();
            return near.quality("/probe") != Quality::Lost && near.state("/probe") == state;
        });
    };
    for (int round = 0; round < 2; ++round) {
        FarAgent far;
        EXPECT_TRUE(becomes(State::Active)) << round;
        EXPECT_TRUE(comesTrue([&] {
            near.step();
            return done;
        })) << round
            << ": " << other.answer().why.view();
        EXPECT_TRUE(becomes(State::Standby))
            << round << ": " << name(other.answer().outcome) << " " << other.answer().why.view();
        far.kill();
        EXPECT_TRUE(comesTrue([&] {
            near.step();
            return near.quality("/probe") == Quality::Lost;
        })) << round;
    }
}

}  // namespace
}  // namespace cortex::comms
