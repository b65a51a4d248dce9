// SPDX-License-Identifier: Apache-2.0
#include "rig.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

// Two axes with the limits of LimitedAxis: 3 rad either way, 2 rad/s, 10 rad/s2, 100 rad/s3.
class JogControllerTest : public testing::Test {
protected:
    static constexpr double period = 1e-3;
    enum Mode : std::int64_t { Hold, Position, Velocity, Step };

    JogControllerTest() {
        Rig::Pairs relates;
        for (const char* number : {"1", "2"}) {
            const std::string demand = std::string{"/demand"} + number;
            const std::string axis = std::string{"/axis"} + number;
            rig_.add(demand, "LimitedAxis");
            rig_.add(axis, "RotaryAxisObservation");
            rig_.add(std::string{"/drive"} + number, "SimulatedAxis",
                     {{"demand", demand}, {"observation", axis}});
            relates.emplace_back("axes", axis);
            relates.emplace_back("demands", demand);
        }
        rig_.add("/jog", "JogController", relates);
        rig_.start();
        rig_.startUp();
        last_ = velocity();
    }
    // Every cycle, as a person's window does ten times a second.
    void jog(double wanted, int cycles) {
        for (int i = 0; i < cycles; ++i) {
            if (i % 100 == 0) send("jog", {{"axis", std::int64_t{1}}, {"velocity", wanted}});
            step();
        }
    }
    CallResult call(const std::string& command, const Rig::Arguments& arguments = {}) {
        return rig_.call("/jog", command, arguments);
    }
    void send(const std::string& command, const Rig::Arguments& arguments) {
        rig_.cluster().send("/jog", command, arguments);
    }
    CallResult setMode(std::int64_t mode) {
        return call("setMode", {{"mode", Value{std::vector{mode}}}});
    }
    void set(const std::string& item, double first) {
        std::vector<double> values(16, 0.5);
        values[0] = first;
        ASSERT_TRUE(call("set", {{item, Value{values}}}).done());
    }
    void step(int cycles = 1) {
        for (int i = 0; i < cycles; ++i) {
            rig_.step();
            EXPECT_LE(std::abs(velocity() - last_), 10 * period * (1 + 1e-9));
            EXPECT_LE(std::abs(position()), 3);
            last_ = velocity();
        }
    }
    double position() { return rig_.get<double>("/demand1", "position"); }
    double velocity() { return rig_.get<double>("/demand1", "velocity"); }
    void expectNothingWasLimited() { EXPECT_EQ(rig_.get<std::int64_t>("/rig", "limitCount"), 0); }

    Rig rig_;
    double last_ = 0;
};

TEST_F(JogControllerTest, JogsNoMoreWhereItIsNotActive) {
    jog(0.5, 20);
    EXPECT_TRUE(rig_.get<bool>("/jog", "jogging"));
    rig_.cluster().send("/jog", "shutdown");
    step(2);
    EXPECT_FALSE(rig_.get<bool>("/jog", "jogging"));
}

TEST_F(JogControllerTest, RejectsACommandOfAnotherModeWithTheNamesOfBoth) {
    const CallResult go = call("go");
    EXPECT_EQ(go.outcome, Outcome::Rejected);
    EXPECT_EQ(go.reason, Reason::State);
    EXPECT_EQ(go.why, "go needs the mode Position, and it is Velocity: call setMode first");

    ASSERT_TRUE(setMode(Hold).done());
    const CallResult jog = call("jog", {{"velocity", 0.1}});
    EXPECT_EQ(jog.why, "jog needs the mode Velocity, and it is Hold: call setMode first");
    EXPECT_EQ(call("step").outcome, Outcome::Rejected);
}

TEST_F(JogControllerTest, SlowsDownBeforeALimitAndStopsAtIt) {
    jog(2, 1000);
    EXPECT_NEAR(velocity(), 2, 1e-6);
    jog(2, 2000);

    EXPECT_NEAR(position(), 3, 1e-9);
    EXPECT_EQ(velocity(), 0);
    jog(-0.5, 1000);
    EXPECT_NEAR(velocity(), -0.5, 1e-6);
    EXPECT_LT(position(), 2.7);
    expectNothingWasLimited();
}

TEST_F(JogControllerTest, StandsStillWhereItIsJoggedAgainstALimit) {
    jog(2, 3000);
    step(500);
    jog(1, 500);

    EXPECT_NEAR(position(), 3, 1e-9);
    EXPECT_EQ(velocity(), 0);
    expectNothingWasLimited();
}

TEST_F(JogControllerTest, BrakesWhenTheJogIsNotRepeated) {
    jog(1, 500);
    step(250);
    EXPECT_FALSE(rig_.get<bool>("/jog", "jogging"));
    step(200);  // 1/10 + 10/100 s

    EXPECT_EQ(velocity(), 0);
}

TEST_F(JogControllerTest, JogsAgainOnlyWithANewPressOnceTheJogWasEnded) {
    ASSERT_TRUE(setMode(Velocity).done());
    const auto press = [&](double wanted) {
        const Outcome outcome =
            call("jog", {{"axis", std::int64_t{1}}, {"velocity", wanted}}).outcome;
        last_ = velocity();
        return outcome;
    };
    EXPECT_EQ(press(0.5), Outcome::Done);
    step(100);
    EXPECT_TRUE(call("halt").done());
    last_ = velocity();
    for (int i = 0; i < 8; ++i) {
        EXPECT_EQ(press(0.5), Outcome::Rejected) << i;
        step(100);
    }
    EXPECT_EQ(velocity(), 0);
    EXPECT_FALSE(rig_.get<bool>("/jog", "jogging"));
    step(300);  // let go
    EXPECT_EQ(press(0.5), Outcome::Done);
    step(100);
    EXPECT_GT(velocity(), 0);
}

// A window repeats its order until it has heard of the end, and one may be on its way that long.
TEST_F(JogControllerTest, OrdersThatCameWhileItWasNotActiveCountAsRepeatedOnceItIs) {
    const auto press = [&] {
        const Outcome outcome = call("jog", {{"axis", std::int64_t{1}}, {"velocity", 0.5}}).outcome;
        last_ = velocity();
        return outcome;
    };
    ASSERT_EQ(press(), Outcome::Done);
    step(50);
    ASSERT_TRUE(call("shutdown").done());
    for (int i = 0; i < 5; ++i) {  // longer than an order lasts
        EXPECT_EQ(press(), Outcome::Rejected) << i;
        step(80);
    }
    ASSERT_TRUE(call("startup").done());
    for (int i = 0; i < 5; ++i) {
        EXPECT_EQ(press(), Outcome::Rejected) << i;
        EXPECT_FALSE(rig_.get<bool>("/jog", "jogging")) << i;
        step(240);
    }
    step(20);  // let go
    EXPECT_EQ(press(), Outcome::Done);
}

TEST_F(JogControllerTest, AJogThatRanOutLongAgoIsNoReasonToRefuseOneAfterAStartup) {
    jog(0.5, 100);
    step(600);
    ASSERT_TRUE(call("shutdown").done());
    ASSERT_TRUE(call("startup").done());
    step();
    EXPECT_EQ(call("jog", {{"axis", std::int64_t{1}}, {"velocity", 0.5}}).outcome, Outcome::Done);
}

TEST_F(JogControllerTest, GoesToAPositionAndSaysWhenItIsThere) {
    ASSERT_TRUE(setMode(Position).done());
    set("demandPosition", -1.5);

    EXPECT_TRUE(call("go").done());
    EXPECT_EQ(position(), -1.5);
    EXPECT_EQ(rig_.get<double>("/demand2", "position"), 0);
    EXPECT_EQ(rig_.get<std::int64_t>("/jog", "axis"), 1);
}

TEST_F(JogControllerTest, RejectsAPositionBeyondALimitWithItemValueAndLimit) {
    ASSERT_TRUE(setMode(Position).done());
    set("demandPosition", 3.5);

    const CallResult answer = call("go");
    EXPECT_EQ(answer.outcome, Outcome::Rejected);
    EXPECT_EQ(answer.reason, Reason::Range);
    EXPECT_EQ(answer.why, "demandPosition[0] is 3.5, above 3, the limit of /demand1");
}

TEST_F(JogControllerTest, GoesElsewhereWhileItMoves) {
    ASSERT_TRUE(setMode(Position).done());
    set("demandPosition", 2);
    send("go", {{"axis", std::int64_t{1}}});
    step(300);
    ASSERT_GT(velocity(), 0.1);
    set("demandPosition", -1);

    EXPECT_TRUE(call("go").done());
    EXPECT_EQ(position(), -1);
    expectNothingWasLimited();
}

TEST_F(JogControllerTest, SaysHowMuchOfTheWayIsDone) {
    ASSERT_TRUE(setMode(Position).done());
    set("demandPosition", 2);
    send("go", {{"axis", std::int64_t{1}}});
    step(2000);
    EXPECT_GT(rig_.get<double>("/jog", "progress"), 0.3);
    EXPECT_LT(rig_.get<double>("/jog", "progress"), 0.7);
    step(3000);

    EXPECT_EQ(position(), 2);
    EXPECT_EQ(rig_.get<double>("/jog", "progress"), 1);
}

TEST_F(JogControllerTest, MovesByStepsToBothSides) {
    ASSERT_TRUE(setMode(Step).done());
    set("stepSize", 0.2);

    for (const double expected : {0.2, 0.4}) {
        EXPECT_TRUE(call("step").done());
        EXPECT_NEAR(position(), expected, 1e-12);
    }
    EXPECT_TRUE(call("step", {{"direction", Value{std::vector<std::int64_t>{-1}}}}).done());
    EXPECT_NEAR(position(), 0.2, 1e-12);
}

TEST_F(JogControllerTest, ComesToRestBeforeItsModeChanges) {
    jog(2, 500);
    send("setMode", {{"mode", std::int64_t{Position}}});
    step(100);
    EXPECT_GT(velocity(), 0.5);
    EXPECT_NE(rig_.get<std::int64_t>("/jog", "mode"), Position);
    step(250);

    EXPECT_EQ(velocity(), 0);
    EXPECT_EQ(rig_.get<std::int64_t>("/jog", "mode"), Position);
}

TEST_F(JogControllerTest, ComesToRestAtAHaltWhichEndsWhatRuns) {
    ASSERT_TRUE(setMode(Position).done());
    set("demandPosition", 2);
    send("go", {{"axis", std::int64_t{1}}});
    step(500);
    EXPECT_TRUE(call("halt").done());
    step(300);

    EXPECT_EQ(velocity(), 0);
    EXPECT_LT(position(), 1.9);
    EXPECT_EQ(rig_.get<std::int64_t>("/jog", "outcome"), static_cast<int>(Outcome::Failed));
}

TEST_F(JogControllerTest, BrakesWhenWhatRunsIsCancelled) {
    ASSERT_TRUE(setMode(Position).done());
    set("demandPosition", 2);
    send("go", {{"axis", std::int64_t{1}}});
    step(500);
    EXPECT_TRUE(call("cancel").done());
    step(300);

    EXPECT_EQ(velocity(), 0);
    EXPECT_LT(position(), 1.9);
}

}  // namespace
}  // namespace cortex::toolkit::test
