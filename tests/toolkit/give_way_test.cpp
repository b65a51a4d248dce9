// SPDX-License-Identifier: Apache-2.0
// cortex-agent --wait: what a start does while another one of its name has the devices.
#include "give_way.hpp"

#include "toolkit/rig.hpp"

#include <string>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

using Turn = GiveWay::Turn;

class GiveWayTest : public testing::Test {
protected:
    GiveWayTest() {
        rig.add("/axis/observed", "RotaryAxisConcept");
        rig.add("/axis/demanded", "RotaryAxisConcept");
        rig.add("/drive", "SimulatedAxis",
                {{"demand", "/axis/demanded"}, {"observation", "/axis/observed"}});
        rig.add("/controller", "HoldAxisController",
                {{"axes", "/axis/observed"}, {"demands", "/axis/demanded"}});
        rig.start();
        rig.startUp();
        testing::internal::CaptureStderr();
    }
    ~GiveWayTest() override { said(); }

    std::string said() {
        if (!captures) return "";
        captures = false;
        return testing::internal::GetCapturedStderr();
    }
    bool all(State state) {
        return rig.state("/drive") == state && rig.state("/controller") == state;
    }

    Rig rig;
    bool captures = true;
    GiveWay giveWay{rig.cluster(), "rig", true};
};

TEST_F(GiveWayTest, AloneEverythingStaysActive) {
    for (int look = 0; look < 3; ++look) {
        EXPECT_EQ(giveWay.look(false), Turn::Ours);
        rig.step(10);
    }
    EXPECT_TRUE(all(State::Active));
    EXPECT_EQ(said(), "");
}

TEST_F(GiveWayTest, ASecondStartKeepsItsSimplexesInStandbyAndSaysSoOnce) {
    EXPECT_EQ(giveWay.look(true), Turn::Theirs);
    rig.step(20);
    EXPECT_EQ(giveWay.look(true), Turn::Theirs);
    rig.step(100);

    EXPECT_EQ(giveWay.look(true), Turn::Theirs);
    EXPECT_TRUE(giveWay.isAway());
    EXPECT_TRUE(all(State::Standby));
    EXPECT_EQ(said(),
              "another start of rig has the devices: everything here goes to Standby until that "
              "one has ended; end one of the two\n");
}

TEST_F(GiveWayTest, ItIsToStartUpAgainOnceTheFirstHasEndedAndItsOwnShutdownIsThrough) {
    giveWay.look(true);
    EXPECT_EQ(giveWay.look(false), Turn::Theirs) << "it still shuts down";
    rig.step(20);

    EXPECT_EQ(giveWay.look(false), Turn::OursAgain);
    EXPECT_EQ(giveWay.look(false), Turn::Ours);
    EXPECT_FALSE(giveWay.isAway());
    EXPECT_NE(said().find("the other start of rig has ended: everything is started up, as "
                          "--startup says\n"),
              std::string::npos);
}

TEST_F(GiveWayTest, WithoutStartupItSaysHowToStart) {
    GiveWay asked{rig.cluster(), "rig", false};
    asked.look(true);
    rig.step(20);

    EXPECT_EQ(asked.look(false), Turn::OursAgain);
    EXPECT_TRUE(all(State::Standby));
    EXPECT_NE(said().find("everything is in Standby; cortex call /rig startup prefix=/\n"),
              std::string::npos);
}

}  // namespace
}  // namespace cortex::toolkit::test
