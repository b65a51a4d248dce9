// SPDX-License-Identifier: Apache-2.0
// Axes whose drives are off, braked or in fault, in the shipped examples as they are.
#include "cortex/core/agent.hpp"
#include "cortex/cs/testing.hpp"
#include "cortex/toolkit/classes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

constexpr std::int64_t seconds = 1000;  // cycles

class Example : public cs::TestPlant {
public:
    explicit Example(const std::string& name)
        : TestPlant{{CORTEX_SOURCE_DIR "/examples/" + name + "/" + name + ".xml"}}, name_{name} {
        addClasses(classes());
    }
    void begin() {
        start();
        startUp();
        step(20);
    }
    // Shuts all down, waits until nothing moves, and starts all again.
    void shutDownAndStartAgain() {
        ask("shutdown");
        step(2 * seconds);
        ask("startup");
        step(5 * seconds);
    }
    void ask(const std::string& command) {
        cluster().send("/" + name_, command, {{"prefix", std::string{"/"}}});
    }
    double position(std::string_view path) { return get<double>(path, "position"); }

private:
    std::string name_;
};

class Crane : public Example {
public:
    Crane() : Example{"gantry"} {
        begin();
        call("/control", "select", {{"group", std::int64_t{2}}});
    }
    void aim(double x) {
        std::vector<double> pose(16);
        pose[0] = x;
        EXPECT_TRUE(call("/control/pose", "set", {{"pose", pose}}).done());
    }
    CallResult moveTo(double x) {
        aim(x);
        return call("/control/pose", "moveTo", {{"speedShare", 1.0}});
    }
    void setOff(double x) {
        aim(x);
        cluster().send("/control/pose", "moveTo", {{"speedShare", 1.0}});
        step(3 * seconds);
    }
    double demand() { return position("/crane/demands/x"); }
    double axis() { return position("/crane/x"); }
};

bool contains(const CallResult& result, std::string_view words) {
    return result.text().find(words) != std::string::npos;
}

TEST(AGantryThatWasShutDownInMotion, StartsAgainWhereItStands) {
    Crane crane;
    crane.setOff(3.5);
    ASSERT_GT(std::abs(crane.get<double>("/crane/x", "velocity")), 0.4);

    crane.shutDownAndStartAgain();

    EXPECT_EQ(crane.state("/drives/x"), State::Active);
    EXPECT_NEAR(crane.demand(), crane.axis(), 1e-3);
    EXPECT_TRUE(crane.moveTo(3.0).done());
}

TEST(AJoggedAxisThatWasShutDownInMotion, StartsAgainWhereItStands) {
    Example table{"jog_axis"};
    table.begin();
    for (int i = 0; i < 6; ++i) {
        table.call("/jog", "jog", {{"axis", std::int64_t{1}}, {"velocity", 1.0}});
        table.step(seconds / 5);
    }
    ASSERT_GT(table.get<double>("/turntable/axis", "velocity"), 0.9);

    table.shutDownAndStartAgain();

    EXPECT_EQ(table.state("/drive"), State::Active);
    EXPECT_NEAR(table.position("/turntable/demand"), table.position("/turntable/axis"), 1e-3);
}

TEST(AnAxisThatDoesNotFollow, FailsTheMoveInWords) {
    Crane crane;
    crane.setOff(3.5);
    crane.call("/drives/x", "shutdown");
    crane.step(10);

    EXPECT_EQ(crane.get<std::int64_t>("/control/pose", "outcome"),
              static_cast<int>(Outcome::Failed));
}

TEST(AnAxisThatDoesNotFollow, IsNotMovedAndTheRefusalSaysWhy) {
    Crane crane;
    crane.call("/drives/x", "shutdown");
    const double stands = crane.axis();

    const CallResult refused = crane.moveTo(3.5);

    EXPECT_EQ(refused.outcome, Outcome::Rejected);
    EXPECT_TRUE(contains(refused, "/crane/x does not follow: its drive says Braked"))
        << refused.text();
    crane.step(seconds);
    EXPECT_NEAR(crane.demand(), stands, 1e-6);
}

TEST(AnAxisThatDoesNotFollow, HasItsDemandLedBackToItWithinTheLimits) {
    Crane crane;
    crane.setOff(3.5);
    crane.call("/drives/x", "shutdown");
    const auto limits = crane.get<std::int64_t>("/gantry", "limitCount");
    double before = crane.get<double>("/crane/demands/x", "velocity"), most = 0;
    for (std::int64_t i = 0; i < 5 * seconds; ++i) {
        crane.step();
        const double now = crane.get<double>("/crane/demands/x", "velocity");
        most = std::max(most, std::abs(now - before));
        before = now;
    }

    EXPECT_NEAR(crane.demand(), crane.axis(), 1e-6);
    EXPECT_LE(most, 0.5e-3 * (1 + 1e-9));
    EXPECT_EQ(crane.get<std::int64_t>("/gantry", "limitCount"), limits);
    EXPECT_TRUE(crane.call("/drives/x", "startup").done());
    EXPECT_EQ(crane.state("/drives/x"), State::Active);
    EXPECT_TRUE(crane.moveTo(2.5).done());
}

TEST(AnAxisThatDoesNotFollow, LetsTheOthersBeJogged) {
    Crane crane;
    crane.call("/control", "select", {{"group", std::int64_t{1}}});
    crane.call("/drives/x", "shutdown");
    crane.step(10);
    const auto jog = [&](std::int64_t axis) {
        return crane.call("/control/jog", "jog", {{"axis", axis}, {"velocity", 0.2}});
    };
    const CallResult refused = jog(1);
    EXPECT_EQ(refused.outcome, Outcome::Rejected);
    EXPECT_TRUE(contains(refused, "/crane/x does not follow")) << refused.text();

    EXPECT_TRUE(jog(2).done());
    crane.step(seconds);

    EXPECT_GT(crane.position("/crane/y"), 0.03);
}

TEST(ADriveThatDoesNotStart, SaysHowFarItsDemandIsAway) {
    std::string told;  // longer than the plant that tells it
    Example table{"jog_axis"};
    table.cluster().addEventSink(
        [&](const Event& event, const Structure&) { told += event.text.view(); });
    table.begin();
    table.call("/jog", "jog", {{"axis", std::int64_t{1}}, {"velocity", 1.0}});
    table.step(200);
    table.ask("shutdown");
    table.step(2 * seconds);
    table.cluster().send("/drive", "startup");
    table.step(2 * seconds);

    table.cluster().agent().events().flush();
    EXPECT_NE(told.find("it waits for its demand, which is 0."), std::string::npos) << told;
}

}  // namespace
}  // namespace cortex::toolkit::test
