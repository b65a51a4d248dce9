// SPDX-License-Identifier: Apache-2.0
// A gripper without a status: its controller limits the force.
#include "cortex/core/error.hpp"

#include "gripper_rig.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

constexpr double fewMillimetres = 0.005;  // m

struct Slide : testing::Test {
    Slide() { rig.begin(); }
    // A work workPiece is held with this force, and nothing is wrong.
    void expectHeld(double force) {
        EXPECT_EQ(rig.object(), GripperRig::StoppedClosing);
        EXPECT_NEAR(rig.width(), workPiece, ofAnOpening);
        EXPECT_NEAR(-rig.effort(), force, 0.1 * force);
        EXPECT_TRUE(rig.isWell());
    }
    SlideRig rig;
};

TEST_F(Slide, OpensClosesAndMovesToAnOpeningWhereNothingIsBetweenItsJaws) {
    ASSERT_TRUE(rig.ask("close").done());
    EXPECT_NEAR(rig.width(), 0, ofAnOpening);
    EXPECT_EQ(rig.object(), GripperRig::AtDemand);
    ASSERT_TRUE(rig.ask("moveTo", "width", 0.03).done());
    EXPECT_NEAR(rig.width(), 0.03, ofAnOpening);
    EXPECT_EQ(rig.object(), GripperRig::AtDemand);
    ASSERT_TRUE(rig.ask("open").done());
    EXPECT_NEAR(rig.width(), 0.1, ofAnOpening);
    EXPECT_EQ(rig.limitCount(), 0);
    EXPECT_EQ(rig.told(), "");
}

TEST_F(Slide, GripsAWorkPieceWithItsForceAndHoldsIt) {
    rig.put(workPiece);
    const CallResult result = rig.ask("grip", "force", 60.0);
    ASSERT_TRUE(result.done()) << result.text();
    EXPECT_NEAR(std::get<std::vector<double>>(result.response.at("width")).front(), workPiece,
                ofAnOpening);
    expectHeld(60);
    rig.go(4000);
    expectHeld(60);
    EXPECT_LT(rig.mostAhead(), fewMillimetres);
    EXPECT_EQ(rig.limitCount(), 0);

    ASSERT_TRUE(rig.ask("open").done());
    EXPECT_NEAR(rig.width(), 0.1, ofAnOpening);
    EXPECT_EQ(rig.object(), GripperRig::AtDemand);
    EXPECT_EQ(rig.limitCount(), 0);
    EXPECT_EQ(rig.told(), "");
}

TEST_F(Slide, PressesNoHarderThanItsForceForMoreThanAMoment) {
    rig.put(workPiece);
    rig.cluster().send("/it", "grip", {{"force", 20.0}});
    double most = 0;
    for (int i = 0; i < 4000; ++i) {
        rig.go();
        most = std::max(most, -rig.effort());
    }
    expectHeld(20);
    EXPECT_LT(most, 40);
}

TEST_F(Slide, ChangesItsForceWithoutLettingTheWorkPieceGo) {
    rig.put(workPiece);
    for (const double force : {20.0, 90.0, 30.0}) {
        ASSERT_TRUE(rig.ask("grip", "force", force).done()) << force;
        rig.go(1000);
        expectHeld(force);
    }
    EXPECT_EQ(rig.told(), "");
}

TEST_F(Slide, FailsToGripNothingAndStaysClosed) {
    const CallResult result = rig.ask("grip");
    EXPECT_EQ(result.outcome, Outcome::Failed);
    EXPECT_EQ(result.why, "the jaws have closed, and nothing is between them");
    EXPECT_NEAR(rig.width(), 0, ofAnOpening);
    EXPECT_EQ(rig.object(), GripperRig::AtDemand);
    EXPECT_TRUE(rig.isWell());
}

TEST_F(Slide, TakesASheetThinnerThanHalfAMillimetreForNothing) {
    rig.put(0.0003);
    EXPECT_EQ(rig.ask("grip", "force", 60.0).why,
              "the jaws have closed, and nothing is between them");
    rig.go(1000);
    EXPECT_EQ(rig.object(), GripperRig::AtDemand);
    EXPECT_LT(-rig.effort(), 66);
}

TEST_F(Slide, TellsThatAWorkPieceIsLostAndCloses) {
    rig.put(workPiece);
    ASSERT_TRUE(rig.ask("grip", "force", 60.0).done());
    rig.put(0);
    rig.go(5000);
    EXPECT_EQ(rig.told(), "the work piece was lost at an opening of 0.03791 m\n");
    EXPECT_EQ(rig.object(), GripperRig::AtDemand);
    EXPECT_NEAR(rig.width(), 0, ofAnOpening);
    EXPECT_TRUE(rig.isWell());
}

TEST_F(Slide, TellsThatAGripEndsWithoutACommand) {
    const std::string notFollowed =
        "the force on the work piece is kept no more: /axis does not follow: its drive says ";
    rig.put(workPiece);
    struct End {
        std::string path, command, told;
        std::vector<std::string> back;
    };
    for (const auto& [path, command, told, back] :
         {End{"/processor", "quickStop", notFollowed + "Disabled", {"enable"}},
          End{"/drive",
              "injectFault",
              notFollowed + "Fault",
              {"resetFault", "clearFaults", "startup"}},
          End{"/processor", "shutdown", notFollowed + "Disabled", {"startup"}},
          End{"/it",
              "shutdown",
              "the force on the work piece is kept no more: this controller is not Active",
              {"startup"}}}) {
        ASSERT_TRUE(rig.ask("grip", "force", 60.0).done()) << path << command;
        expectHeld(60);
        const std::string before = rig.told();
        ASSERT_TRUE(rig.call(path, command).done()) << path << command;
        rig.step(1000);
        const std::string news = rig.told().substr(before.size());
        EXPECT_NE(news.find(told), std::string::npos) << path << command << news;
        EXPECT_EQ(news.find("work piece"), news.rfind("work piece")) << "twice: " << news;
        EXPECT_EQ(rig.object(), GripperRig::Lost) << path << command;
        for (const std::string& each : back) {
            rig.call(path == "/drive" ? "/processor" : path, each);
            rig.step(2000);
        }
        EXPECT_EQ(rig.object(), GripperRig::Lost) << "until somebody commands anew";
    }
}

TEST_F(Slide, HoldsAWorkPieceFromInsideByOpening) {
    ASSERT_TRUE(rig.ask("close").done());
    rig.stops(-1, 0.06);
    ASSERT_TRUE(rig.ask("moveTo", {{"width", 0.09}, {"force", 40.0}}).done());
    EXPECT_EQ(rig.object(), GripperRig::StoppedOpening);
    EXPECT_NEAR(rig.width(), 0.06, ofAnOpening);
    EXPECT_NEAR(rig.effort(), 40, 4);
    rig.go(2000);
    EXPECT_NEAR(rig.effort(), 40, 4);
    EXPECT_TRUE(rig.isWell());
}

TEST_F(Slide, UsesTheLeastForceThatItCanWhereNoneIsGiven) {
    rig.put(workPiece);
    ASSERT_TRUE(rig.ask("close").done());
    EXPECT_EQ(rig.force(), 10) << "5 % of 200 N";
    rig.go(1000);
    expectHeld(10);
}

TEST_F(Slide, TakesANewCommandOnTheWay) {
    rig.cluster().send("/it", "close");
    rig.go(500);
    EXPECT_EQ(rig.object(), GripperRig::Moving);
    ASSERT_TRUE(rig.ask("open").done());
    EXPECT_NEAR(rig.width(), 0.1, ofAnOpening);
    EXPECT_EQ(rig.limitCount(), 0);
}

TEST_F(Slide, MovesNoFasterThanItIsTold) {
    rig.cluster().send("/it", "moveTo", {{"width", 0.05}, {"speed", 0.02}, {"force", 200.0}});
    double most = 0;
    for (int i = 0; i < 1000; ++i) {
        rig.go();
        most = std::max(most, std::abs(rig.get<double>("/demand", "velocity")));
    }
    EXPECT_NEAR(most, 0.02, 1e-6);
}

TEST_F(Slide, StopsWhereItIsWhenItsCommandIsCancelled) {
    rig.cluster().send("/it", "close");
    rig.go(500);
    EXPECT_TRUE(rig.call("/it", "cancel").done());
    const double there = rig.width();
    rig.go(1000);
    EXPECT_NEAR(rig.width(), there, 0.003);
    EXPECT_EQ(rig.object(), GripperRig::AtDemand);
}

TEST_F(Slide, RejectsAnOpeningAndAForceThatItsAxisHasNot) {
    struct Row {
        Rig::Arguments arguments;
        const char* why;
    };
    for (const Row& row : {Row{{{"width", 0.11}}, "width is 0.11, above 0.1, the limit of /demand"},
                           Row{{{"width", -0.01}}, "width is -0.01, below 0, the limit of /demand"},
                           Row{{{"width", 0.05}, {"force", 250.0}},
                               "force is 250, above 200, the limit of /demand"}}) {
        const CallResult result = rig.ask("moveTo", row.arguments);
        EXPECT_EQ(result.outcome, Outcome::Rejected);
        EXPECT_EQ(result.reason, Reason::Range);
        EXPECT_EQ(result.why, row.why);
    }
    for (const char* command : {"close", "grip"})
        EXPECT_EQ(rig.ask(command, "force", 250.0).why,
                  "force is 250, above 200, the limit of /demand");
    EXPECT_NEAR(rig.width(), 0.1, ofAnOpening);
}

TEST_F(Slide, RejectsMotionAndFailsOnTheWayWhereItsDriveDoesNotFollow) {
    rig.cluster().send("/it", "close");
    rig.go(300);
    ASSERT_TRUE(rig.call("/drive", "injectFault").done());
    rig.step(300);
    EXPECT_EQ(rig.get<std::int64_t>("/it", "outcome"), static_cast<std::int64_t>(Outcome::Failed));
    const CallResult result = rig.call("/it", "open");
    EXPECT_EQ(result.outcome, Outcome::Rejected);
    EXPECT_EQ(result.reason, Reason::State);
    EXPECT_EQ(result.why, "/axis does not follow: its drive says Fault");
}

TEST(GripperController, DoesNotStartWithAnAxisWhoseGreatestOpeningIsNotKnown) {
    Rig rig;
    rig.add("/axis", "LinearAxisObservation");
    rig.add("/demand", "LinearAxisConcept");
    rig.add("/it", "GripperController", {{"axes", "/axis"}, {"demands", "/demand"}});
    try {
        rig.start();
        FAIL() << "it started";
    } catch (const Error& error) {
        EXPECT_NE(std::string{error.what()}.find("/it: how far /demand opens is not known: state "
                                                 "position.max in its type"),
                  std::string::npos)
            << error.what();
    }
}

// A drive without an integral part: its effort is in proportion to how far the demand is ahead.
class SoftSlide : public Rig {
public:
    SoftSlide() {
        for (const char* path : {"/axis", "/demand"})
            add(path, "SlideGripperAxis", {}, {{"position", "0.1"}});
        add("/it", "GripperController", {{"axes", "/axis"}, {"demands", "/demand"}});
        start();
        startUp();
    }
    void go(int cycles) {
        for (int i = 0; i < cycles; ++i) {
            const double demand = get<double>("/demand", "position");
            const double place = std::max(demand, workPiece);
            tree().at("/axis").data<double>("position") = place;
            tree().at("/axis").data<double>("effort") = stiffness * (demand - place);
            step();
            mostAhead = std::max(mostAhead, place - demand);
        }
    }
    static constexpr double stiffness = 500;  // N/m
    double mostAhead = 0;                     // m
};

TEST(GripperController, FailsToGripWithAForceThatItsDriveDoesNotReach) {
    SoftSlide rig;
    rig.cluster().send("/it", "grip", {{"force", 50.0}});
    rig.go(4000);
    EXPECT_EQ(rig.get<std::int64_t>("/it", "outcome"), static_cast<std::int64_t>(Outcome::Failed));
    EXPECT_EQ(rig.get<std::int64_t>("/it", "object"), GripperRig::StoppedClosing);
    EXPECT_LT(rig.mostAhead, 0.012);
}

TEST(GripperController, DoesNotGoOnByItselfAfterItsAxisWasLost) {
    SoftSlide rig;
    rig.cluster().send("/it", "close");
    rig.go(500);
    rig.tree().at("/axis").slot().quality = Quality::Lost;
    rig.go(5);
    EXPECT_EQ(rig.get<std::int64_t>("/it", "outcome"), static_cast<std::int64_t>(Outcome::Failed));
    rig.tree().at("/axis").slot().quality = Quality::Good;
    rig.go(300);
    const double stands = rig.get<double>("/demand", "position");
    EXPECT_GT(stands, 0.06);
    rig.go(300);
    EXPECT_EQ(rig.get<double>("/demand", "position"), stands);
}

TEST(GripperController, DoesNothingForACommandThatCameWhileItsAxisWasLost) {
    SoftSlide rig;
    rig.go(100);
    rig.tree().at("/axis").slot().quality = Quality::Lost;
    rig.go(5);
    const double stands = rig.get<double>("/demand", "position");
    rig.cluster().send("/it", "close");
    rig.go(5);
    rig.tree().at("/axis").slot().quality = Quality::Good;
    rig.go(300);
    EXPECT_EQ(rig.get<double>("/demand", "position"), stands);
}

TEST(GripperController, SaysAgainWhatItHoldsOnceItsAxisIsBackAfterALoss) {
    SoftSlide rig;
    rig.cluster().send("/it", "grip", {{"force", 50.0}});
    rig.go(4000);
    ASSERT_EQ(rig.get<std::int64_t>("/it", "object"), GripperRig::StoppedClosing);
    rig.tree().at("/axis").slot().quality = Quality::Lost;
    rig.go(5);
    EXPECT_EQ(rig.get<std::int64_t>("/it", "object"), GripperRig::Lost);
    rig.tree().at("/axis").slot().quality = Quality::Good;
    rig.go(2000);
    EXPECT_EQ(rig.get<std::int64_t>("/it", "object"), GripperRig::StoppedClosing);
}

struct Drive {
    const char* ratedEffort;  // N; 100 of them have an inertia of 1 kg
    int period;               // ms
};

void PrintTo(const Drive& drive, std::ostream* stream) {
    *stream << drive.ratedEffort << " N, " << drive.period << " ms";
}

class SlideOfAnyDrive : public testing::TestWithParam<Drive> {};

TEST_P(SlideOfAnyDrive, GripsWithItsForceAndHoldsIt) {
    SlideRig rig{GetParam().ratedEffort, std::chrono::milliseconds{GetParam().period}};
    rig.begin();
    rig.put(workPiece);
    const CallResult result = rig.ask("grip", "force", 50.0);
    ASSERT_TRUE(result.done()) << result.text();
    double least = 50, most = 50;
    for (int i = 0; i < 2000 / GetParam().period; ++i) {
        rig.go();
        least = std::min(least, -rig.effort());
        most = std::max(most, -rig.effort());
    }
    EXPECT_GT(least, 45);
    EXPECT_LT(most, 55);
    EXPECT_LT(rig.mostAhead(), fewMillimetres);
    EXPECT_TRUE(rig.isWell());
}

INSTANTIATE_TEST_SUITE_P(WithInertiaAndPeriod, SlideOfAnyDrive,
                         testing::Values(Drive{"20", 1}, Drive{"200", 1}, Drive{"70", 4},
                                         Drive{"200", 5}, Drive{"70", 10}, Drive{"200", 10}));

}  // namespace
}  // namespace cortex::toolkit::test
