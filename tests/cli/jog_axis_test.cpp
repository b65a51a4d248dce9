// SPDX-License-Identifier: Apache-2.0
// The plant examples/jog_axis, with the programs that users start.
#include "cortex/comms/mirror.hpp"

#include "cli/live_agent.hpp"
#include "cli/typed_shell.hpp"
#include "comms/network_agent.hpp"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <csignal>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

constexpr int frequency = 200;     // Hz: enough for a jog, little for a build with sanitizers
constexpr double holdTime = 0.25;  // s, of JogController
constexpr double deceleration = 2, jerk = 20;  // of the axis
constexpr int active = 2;                      // of a state

struct JogAxis : testing::Test {
    JogAxis()
        : agent{agentCommand(CORTEX_SOURCE_DIR "/examples/jog_axis/jog_axis.xml") +
                Words{"--startup", "--priority", "0", "--frequency", std::to_string(frequency)}} {
        for (const char* each : {"/drive", "/jog"}) {
            const json state = lookUntil([each] { return valueOf(each, "state"); },
                                         [](const json& now) { return now == active; });
            EXPECT_EQ(state, active) << "of " << each;
        }
    }
    static json valueOf(const std::string& path, const std::string& item) {
        const json shown = json::parse(live({"show", path, "--json"}).output, nullptr, false);
        return shown.contains("data") ? shown["data"][item]["value"] : json{};
    }
    // The arrays of a JogController have places for 16 axes.
    static std::string forAxis1(const std::string& item, const std::string& value) {
        return item + "=" + value + " 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0";
    }
    static double angle() { return valueOf("/turntable/axis", "position").get<double>(); }
    static Outcome call(const std::string& command, const Words& arguments = {}) {
        return live(Words{"call", "/jog", command} + arguments);
    }
    static void setMode(const std::string& mode) {
        const Outcome outcome = call("setMode", {"mode=" + mode});
        EXPECT_EQ(outcome.exit, 0) << outcome.errors << outcome.output;
    }
    // Goes there in mode Position. It tries again, as a motion fails where the loop stood still.
    static bool goesTo(double position) {
        setMode("Position");
        EXPECT_EQ(live({"set", "/jog", forAxis1("demandPosition", std::to_string(position))}).exit,
                  0);
        return becomesTrue([] { return call("go").exit == 0; }) && standsAt(position);
    }
    static bool standsAt(double position) {  // the axis follows its demand a little later
        return becomesTrue([&] { return std::abs(angle() - position) < 0.001; });
    }

    Background agent;
};

TEST_F(JogAxis, GoesToAPositionAndStepsFromIt) {
    EXPECT_EQ(live({"set", "/jog", "speedShare=1", forAxis1("stepSize", "0.2")}).exit, 0);

    EXPECT_TRUE(becomesTrue([] {  // again from where it began, where the loop stood still
        EXPECT_TRUE(goesTo(0.5)) << angle();
        setMode("Step");
        return call("step", {"direction=-1"}).exit == 0;
    }));

    EXPECT_TRUE(standsAt(0.3)) << angle();
}

TEST_F(JogAxis, RefusesInWordsWhatItsModeOrItsLimitForbids) {
    setMode("Position");
    EXPECT_EQ(live({"set", "/jog", forAxis1("demandPosition", "9")}).exit, 0);

    const Outcome far = call("go");
    const Outcome jogged = call("jog", {"velocity=0.1"});

    EXPECT_NE(far.exit, 0);
    EXPECT_TRUE(contains(far.output, "demandPosition[0] is 9, above 2.6"))
        << far.errors << far.output;
    EXPECT_NE(jogged.exit, 0);
    EXPECT_TRUE(contains(jogged.output, "jog needs the mode Velocity, and it is Position"))
        << jogged.errors << jogged.output;
    EXPECT_EQ(angle(), 0);
}

// What each cycle says of the jog, as the agent counts its cycles.
class EachCycle {
public:
    struct Seen {
        std::int64_t cycle;
        bool jogging;
        double asked, velocity;
    };
    using All = std::vector<Seen>;

    static double askedOf(const Value& speeds) {  // of the first axis
        return std::get<std::vector<double>>(speeds).front();
    }

    EachCycle() : mirror_{"watcher", comms::loopback()} {
        mirror_.onImage([this](const std::string&, const comms::AgentImage& image) {
            const std::scoped_lock lock{mutex_};
            all_.push_back({image->cycle(), image->get<bool>("/jog", "jogging"),
                            askedOf(image->value("/jog", "demandVelocity")),
                            image->get<double>("/turntable/demand", "velocity")});
            changed_.notify_all();
        });
        mirror_.view({"/jog", "/turntable"}, 0);
        EXPECT_TRUE(mirror_.waitForValues(patience));
    }
    bool show(const std::function<bool(const All&)>& condition, std::chrono::milliseconds limit) {
        std::unique_lock lock{mutex_};
        return changed_.wait_for(lock, limit, [&] { return condition(all_); });
    }
    All all() const {
        const std::scoped_lock lock{mutex_};
        return all_;
    }

private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    All all_;
    comms::Mirror mirror_;
};

TEST_F(JogAxis, EndsWithinItsTimeWhereWhoeverJogsIsKilled) {
    const ModelFolder home;
    TypedShell shell{home};
    shell.run("take /jog --timeout " + patient, "you control /jog");
    EachCycle cycles;

    double asked = 0.5;  // each jog asks for a speed of its own, so that it is known when it came
    const auto isOfLastJog = [&](const EachCycle::Seen& each) { return each.asked == asked; };
    const auto isFast = [](const EachCycle::All& all) {
        return std::ranges::any_of(all, [](const auto& each) { return each.velocity > 0.3; });
    };
    do {
        asked += 1.0 / 64;  // to_string() keeps all of its digits
        shell.run("call /jog jog velocity=" + std::to_string(asked), "Done");
    } while (!HasFailure() && !cycles.show(isFast, std::chrono::milliseconds{50}));
    shell.signal(SIGKILL);
    EXPECT_TRUE(cycles.show(
        [&](const EachCycle::All& all) {
            return std::ranges::any_of(all, isOfLastJog) && all.back().velocity == 0;
        },
        patience));

    const EachCycle::All all = cycles.all();
    const auto came = std::ranges::find_if(all, isOfLastJog);
    ASSERT_NE(came, all.end()) << "no image of the last jog";
    std::int64_t jogging = 0, moving = 0;
    double fastest = 0;
    for (const auto& each : all) {
        if (each.jogging) jogging = each.cycle;
        if (each.velocity > 0) moving = each.cycle;
        fastest = std::max(fastest, each.velocity);
    }
    EXPECT_LE(static_cast<double>(jogging - came->cycle), holdTime * frequency + 1);
    const double braking = fastest / deceleration + deceleration / jerk;
    EXPECT_LE(static_cast<double>(moving - jogging), 1.2 * braking * frequency);
}

}  // namespace
}  // namespace cortex::test
