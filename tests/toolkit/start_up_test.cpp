// SPDX-License-Identifier: Apache-2.0
// cortex-agent --startup where data is not there at once.
#include "start_up.hpp"

#include "cortex/cs/simplex_cs.hpp"

#include "support/waiting.hpp"
#include "toolkit/rig.hpp"

#include <string>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

class LateAxis final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

    bool answers = false;

private:
    void loopEnd(const Tick&) override {
        if (!answers) setQuality(Quality::Lost);
    }
};

class StartUpTest : public testing::Test {
protected:
    StartUpTest() {
        rig.classes().add<LateAxis>("LateAxis");
        rig.add("/axis", "LimitedAxis");
        rig.add("/wish", "LimitedAxis");
        rig.add("/drive", "LateAxis", {{"demand", "/wish"}, {"observation", "/axis"}});
        rig.add("/hold", "HoldAxisController", {{"axes", "/axis"}, {"demands", "/wish"}});
        testing::internal::CaptureStderr();
    }
    ~StartUpTest() override { said(); }

    void start() {
        rig.start();
        drive = &dynamic_cast<LateAxis&>(rig.tree().at("/drive"));
    }
    std::string said() {
        return std::exchange(captures, false) ? testing::internal::GetCapturedStderr() : "";
    }
    // Looks again and again, with cycles between.
    testing::AssertionResult comes(const std::string& path, State state) {
        return cortex::test::comesTrue(path + " in " + name(state), [&] {
            startUp.look();
            rig.step();
            return rig.state(path) == state;
        });
    }
    void look(int times) {
        for (int i = 0; i < times; ++i) {
            startUp.look();
            rig.step();
        }
    }

    Rig rig;
    StartUp startUp{rig.cluster(), "rig"};
    LateAxis* drive = nullptr;
    bool captures = true;
};

TEST_F(StartUpTest, StartsWhatDidNotFollowOnceItsDataIsGood) {
    start();
    look(50);
    EXPECT_EQ(rig.state("/hold"), State::Standby);
    EXPECT_TRUE(startUp.isOver());
    EXPECT_NE(startUp.endText().find("/hold did not follow"), std::string::npos);

    drive->answers = true;

    EXPECT_TRUE(comes("/hold", State::Active));
    look(50);
    EXPECT_EQ(startUp.endText(), "");
}

TEST_F(StartUpTest, LeavesTheRestToWhoShutSomethingDownMeanwhile) {
    start();
    look(50);
    ASSERT_TRUE(rig.call("/drive", "startup").done());
    look(50);
    ASSERT_TRUE(rig.call("/drive", "shutdown").done());
    look(50);

    drive->answers = true;

    const std::string told = "/drive was shut down since, so the rest is left to you";
    std::string all;
    EXPECT_TRUE(cortex::test::comesTrue("words", [&] {
        look(1);
        all += testing::internal::GetCapturedStderr();
        testing::internal::CaptureStderr();
        return all.find(told) != std::string::npos;
    }));
    look(50);
    EXPECT_EQ(rig.state("/hold"), State::Standby);
    EXPECT_EQ(rig.state("/drive"), State::Standby);
}

}  // namespace
}  // namespace cortex::toolkit::test
