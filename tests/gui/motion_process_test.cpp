// SPDX-License-Identifier: Apache-2.0
// A window that jogs, stopped and killed, in a process of its own: what the agent counts.
#include "gui/motion_fixture.hpp"

#include <algorithm>
#include <csignal>
#include <mutex>

namespace cortex::test {
namespace {

constexpr double holdTime = 0.25;  // s, of JogController
constexpr double frequency = 500;  // Hz

// The last cycle that jogged, and the cycle of the last jog that was executed, as far as it had
// another velocity than the one before.
class JoggedCycles {
public:
    JoggedCycles() : mirror_{"watcher", ownNetwork()} {
        mirror_.onImage([this](const std::string&, const comms::AgentImage& image) {
            const std::scoped_lock lock{mutex_};
            seen_.cycle = image->cycle();
            const double velocity =
                std::get<std::vector<double>>(image->value("/jog", "demandVelocity")).front();
            if (velocity != 0 && velocity != velocity_) {
                seen_.executed = seen_.cycle;
                ++seen_.count;
            }
            velocity_ = velocity;
            if (image->get<bool>("/jog", "jogging")) seen_.jogged = seen_.cycle;
        });
        mirror_.view({"/jog"}, 0);
        EXPECT_TRUE(mirror_.waitForValues(patience));
    }
    struct Seen {
        std::int64_t cycle = 0, jogged = 0, executed = 0;
        int count = 0;
    };
    Seen seen() const {
        const std::scoped_lock lock{mutex_};
        return seen_;
    }

private:
    mutable std::mutex mutex_;
    Seen seen_;
    double velocity_ = 0;
    comms::Mirror mirror_;
};

class JoggingProcess : public MotionAgent {
protected:
    JoggingProcess() : MotionAgent{motionTypes, motionSystem("")} {}

    // A window that jogs gets this signal. A jog that is under way then is executed within its
    // budget, which is holdTime, and lasts for holdTime; nothing comes after it.
    void endsAfter(int signal) {
        ASSERT_TRUE(starts("/jog"));
        JoggedCycles cycles;
        Background jogging{{CORTEX_BINARY_DIR "/bin/jogging-window", domain, "/jog"}};
        const auto look = [&] { return cycles.seen(); };
        const auto jogs = lookUntil(look, [](const auto& seen) { return seen.count >= 5; });
        ASSERT_GE(jogs.count, 5) << "it never jogged";
        if (signal == SIGKILL) {
            jogging.end(signal);
        } else {
            jogging.send(signal);
        }
        const std::int64_t sent = cycles.seen().cycle;
        constexpr auto hold = static_cast<std::int64_t>(holdTime * frequency);
        const auto last = lookUntil(look, [&](const auto& seen) {
            return seen.cycle > std::max(sent, seen.jogged) + 3 * hold;
        });
        EXPECT_GT(last.cycle, std::max(sent, last.jogged) + 3 * hold) << "it jogs on";
        // One of them for an image that comes late, or for a jog as fast as the one before.
        EXPECT_LE(last.jogged - last.executed, 2 * hold);
        if (judgesTime) EXPECT_LE(last.jogged - sent, 3 * hold);
        std::cout << "it jogged for " << last.jogged - sent << " cycles after the signal, for "
                  << last.jogged - last.executed << " after the last of " << last.count
                  << " jogs that were told apart\n";
    }
};

TEST_F(JoggingProcess, EndsWithinItsTimeWhereTheWindowIsStopped) { endsAfter(SIGSTOP); }

TEST_F(JoggingProcess, EndsWithinItsTimeWhereTheWindowIsKilled) { endsAfter(SIGKILL); }

}  // namespace
}  // namespace cortex::test
