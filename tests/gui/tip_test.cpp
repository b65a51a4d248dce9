// SPDX-License-Identifier: Apache-2.0
// Jogging the tip of a chain in the window, with a real agent over DDS.
#include "gui/motion_fixture.hpp"
#include "gui/places.hpp"
#include "motion/tip_pad.hpp"

#include <functional>

namespace cortex::test {
namespace {

using explorer::tipElbow;
using explorer::TipPad;

// Three sliding axes, along x, along y and downwards; the last one is short.
const char* const slides = R"(<ontology name="plant" version="1.0">
  <include file="robotics.xml"/>
  <type name="Slide" extends="LinearAxisConcept" version="1.0" description="An axis that slides along a rail.">
    <data name="position" min="-2" max="2" rate="0.5"/>
    <data name="velocity" min="-0.5" max="0.5" rate="4"/>
    <data name="acceleration" min="-4" max="4" rate="80"/>
  </type>
  <type name="Along" extends="Slide" version="1.0" description="An axis that slides along the hall.">
    <data name="direction" default="1 0 0"/>
  </type>
  <type name="Across" extends="Slide" version="1.0" description="An axis that slides across the hall.">
    <data name="direction" default="0 1 0"/>
  </type>
  <type name="Down" extends="LinearAxisConcept" version="1.0" description="An axis that slides downwards, not far.">
    <data name="position" min="0" max="0.05" rate="0.5"/>
    <data name="velocity" min="-0.5" max="0.5" rate="4"/>
    <data name="acceleration" min="-4" max="4" rate="80"/>
    <data name="direction" default="0 0 -1"/>
  </type>
</ontology>)";

std::string kinematics(const std::string& path, const std::string& tip, const std::string& axes,
                       const std::string& tipPosition) {
    return "<simplex path=\"" + tip + "\" type=\"CartesianObservation\"/><simplex path=\"" + path +
           "\" type=\"ForwardKinematics\">" + axes + "<relate rule=\"tip\" to=\"" + tip +
           "\"/><set data=\"tipPosition\" value=\"" + tipPosition + "\"/></simplex>";
}

// The place of the hook in the frame of the last axis; `sling`: another tip at its origin.
std::string crane(const std::string& hook = "0 0 0", bool sling = false) {
    std::string text =
        "<system name=\"robot\"><ontology file=\"plant.xml\"/>"
        "<morphology file=\"cortex-morphology.xml\"/>";
    std::string axes, demands;
    const std::vector<std::pair<std::string, std::string>> all{
        {"1", "Along"}, {"2", "Across"}, {"3", "Down"}};
    for (const auto& [name, type] : all) {
        for (const char* kind : {"axes", "demands"})
            text += "<simplex path=\"/arm/" + std::string{kind} + "/" + name + "\" type=\"" + type +
                    "\"/>";
        const std::string axis = "to=\"/arm/axes/" + name + "\"/>";
        const std::string demand = "to=\"/arm/demands/" + name + "\"/>";
        text += "<simplex path=\"/drives/" + name +
                "\" type=\"SimulatedAxis\"><relate rule=\"demand\" " + demand +
                "<relate rule=\"observation\" " + axis + "</simplex>";
        axes += "<relate rule=\"axes\" " + axis;
        demands += "<relate rule=\"demands\" " + demand;
    }
    return text + kinematics("/kinematics", "/hook", axes, hook) +
           (sling ? kinematics("/sling", "/end", axes, "0 0 0") : "") +
           "<simplex path=\"/tip\" type=\"CartesianJogController\">" + axes + demands + longHold +
           R"(<set data="directions" value="true true true false false false"/></simplex>)" +
           R"(<cluster name="robot" frequency="500" overflow="skip" control="open"/></system>)";
}

class JoggingTheTip : public MotionWindow {
protected:
    explicit JoggingTheTip(const std::string& system = crane()) : MotionWindow{slides, system} {
        jogger = "/tip";
    }

    void opensTip() {
        ASSERT_NO_FATAL_FAILURE(opens("/tip"));
        ASSERT_EQ(live({"call", "/kinematics", "startup"}).exit, 0);
        ASSERT_TRUE(comes([this] { return said().contains("Tip in the base"); }));
    }
    void opensTipInControl() {
        ASSERT_NO_FATAL_FAILURE(opensTip());
        ASSERT_TRUE(takes("/"));
        QApplication::setActiveWindow(&window);
        ASSERT_TRUE(comes([this] { return pad().button(0, 1).isEnabled(); }))
            << said().toStdString();
    }
    TipPad& pad() { return *view().findChild<TipPad*>(); }
    double hook(std::size_t element) {
        const auto frame = session.frame();
        return explorer::SystemNow{*frame}
            .at("/hook")
            .number("position", element)
            .value_or(std::nan(""));
    }
    void holds(int motion, int direction, const std::function<bool()>& hasMoved) {
        QPushButton& button = pad().button(motion, direction);
        QTest::mousePress(&button, Qt::LeftButton);
        ASSERT_TRUE(moves([&] { QTest::mouseRelease(&button, Qt::LeftButton); },
                          [&] { QTest::mousePress(&button, Qt::LeftButton); }, hasMoved))
            << said().toStdString();
    }
};

TEST_F(JoggingTheTip, TheTipMovesAlongAnAxisOfTheBaseWhileAButtonIsHeld) {
    ASSERT_NO_FATAL_FAILURE(opensTipInControl());
    EXPECT_TRUE(said().contains("0.025 of 0.250 m/s")) << said().toStdString();
    ASSERT_NO_FATAL_FAILURE(holds(0, 1, [this] { return hook(0) > 0.01; }));
    EXPECT_TRUE(
        said().contains("Jogging X at +0.025 m/s in the frame Base. "
                        "It brakes when you let go, after 1 s at the latest."))
        << said().toStdString();
    EXPECT_TRUE(pad().button(0, 1).isDown());
    EXPECT_NEAR(hook(1), 0, 1e-9);
    QTest::mouseRelease(&pad().button(0, 1), Qt::LeftButton);
    ends("let go");
    EXPECT_TRUE(comes([this] { return !pad().button(0, 1).isDown(); }));
}

TEST_F(JoggingTheTip, KeysMoveItWhileTheyAreHeld) {
    ASSERT_NO_FATAL_FAILURE(opensTipInControl());
    pad().setFocus();
    const auto holdsKey = [&](Qt::Key key, const std::function<bool()>& hasMoved) {
        QTest::keyPress(&pad(), key);
        EXPECT_TRUE(moves([&] { QTest::keyRelease(&pad(), key); },
                          [&] { QTest::keyPress(&pad(), key); }, hasMoved))
            << said().toStdString();
        QTest::keyRelease(&pad(), key);
        ends("let go");
    };
    holdsKey(Qt::Key_Up, [this] { return hook(1) > 0.01; });
    holdsKey(Qt::Key_Left, [this] { return hook(0) < -0.01; });
    holdsKey(Qt::Key_PageDown, [this] { return hook(2) < -0.005; });
    for (const auto& [key, with] : {std::pair{Qt::Key_Left, Qt::ShiftModifier},  // nothing turns
                                    std::pair{Qt::Key_Plus, Qt::KeyboardModifier{}}}) {
        QTest::keyPress(&pad(), key, with);
        bool jogged = false;
        const std::int64_t then = cycle();
        EXPECT_TRUE(comes([&] {
            jogged = jogged || jogs();
            return cycle() > then + 200;
        }));
        EXPECT_FALSE(jogged) << key;
        QTest::keyRelease(&pad(), key, with);
    }
}

TEST_F(JoggingTheTip, DirectionsThatDoNotCountHaveNoButtonsAndAreNamed) {
    ASSERT_NO_FATAL_FAILURE(opensTip());
    for (int motion = 0; motion <= tipElbow; ++motion)
        EXPECT_EQ(pad().button(motion, 1).isVisible(), motion < 3) << motion;
    EXPECT_TRUE(said().contains("RX RY RZ: masked by the item directions")) << said().toStdString();
}

TEST_F(JoggingTheTip, WhereNoTurnCountsNoKeyIsNamedThatWouldTurn) {
    ASSERT_NO_FATAL_FAILURE(opensTipInControl());
    // At its limit an axis takes the line of the help.
    ASSERT_NO_FATAL_FAILURE(holds(2, -1, [this] { return hook(2) < -0.005; }));
    QTest::mouseRelease(&pad().button(2, -1), Qt::LeftButton);
    EXPECT_TRUE(says("Page Up and Page Down for X, Y and Z.")) << said().toStdString();
    EXPECT_FALSE(said().contains("Shift")) << said().toStdString();
}

TEST_F(JoggingTheTip, WhatTheAgentRefusesIsSaidInItsWordsAlone) {
    ASSERT_NO_FATAL_FAILURE(opensTipInControl());
    ASSERT_NO_FATAL_FAILURE(holds(0, 1, [this] { return hook(0) > 0.002; }));
    session.send("/drives/2", "shutdown");
    ends("/arm/axes/2 does not follow");
}

TEST_F(JoggingTheTip, TheFrameIsThatOfTheAgentAndAnotherOneEndsTheJog) {
    ASSERT_NO_FATAL_FAILURE(opensTipInControl());
    EXPECT_TRUE(comes([this] { return named("Base").isChecked(); }));
    ASSERT_NO_FATAL_FAILURE(holds(0, 1, [this] { return hook(0) > 0.002; }));
    session.send("/tip", "set", {{"frame", std::int64_t{1}}});
    ends("the frame was changed");
    EXPECT_TRUE(comes([this] { return named("Tip").isChecked() && !named("Base").isChecked(); }));
    QTest::mouseRelease(&pad().button(0, 1), Qt::LeftButton);
    named("Base").click();
    EXPECT_TRUE(comes([this] { return named("Base").isChecked(); })) << said().toStdString();
    EXPECT_EQ(number("/tip", "frame"), 0);
}

TEST_F(JoggingTheTip, AtALimitOfAnAxisItIsHeldBackAndSaysSo) {
    ASSERT_NO_FATAL_FAILURE(opensTipInControl());
    speed().setValue(100);
    bool heldBack = false;
    std::int64_t since = 0;
    ASSERT_NO_FATAL_FAILURE(holds(2, -1, [&] {
        const QString seen = said();
        heldBack = heldBack || seen.contains("Held back: an axis is near its limit");
        const bool atLimit = seen.contains(
            "Held at a limit: Z asked for −0.250 m/s in the frame Base; "
            "the tip moves at 0.000 m/s. It brakes");
        if (!atLimit || since == 0) since = cycle();
        return atLimit && cycle() > since + 200;
    }));
    EXPECT_TRUE(heldBack);
    EXPECT_FALSE(said().contains("Jogging Z")) << said().toStdString();
    EXPECT_GT(number("/arm/demands/3", "position"), 0.045);
    EXPECT_LE(number("/arm/demands/3", "position"), 0.05);
    QTest::mouseRelease(&pad().button(2, -1), Qt::LeftButton);
    ends("let go");
}

TEST_F(JoggingTheTip, NothingMovesWhenItIsHeldBackAndWhenNobodyComputesTheTip) {
    ASSERT_NO_FATAL_FAILURE(opensTipInControl());
    const Places before = placesIn(view());
    ASSERT_GE(before.size(), 10U);
    speed().setValue(100);
    ASSERT_NO_FATAL_FAILURE(
        holds(2, -1, [this] { return said().contains("Held back: an axis is near its limit"); }));
    EXPECT_EQ(movedSince(before, view()), "");
    QTest::mouseRelease(&pad().button(2, -1), Qt::LeftButton);
    session.send("/kinematics", "shutdown");
    EXPECT_TRUE(says("Not live: these are the last numbers")) << said().toStdString();
    EXPECT_EQ(movedSince(before, view()), "");
}

TEST_F(JoggingTheTip, EndsWithControlAndSaysSo) {
    ASSERT_NO_FATAL_FAILURE(opensTipInControl());
    ASSERT_NO_FATAL_FAILURE(holds(1, -1, [this] { return hook(1) < -0.002; }));
    window.control().release();
    ends("control was lost");
    EXPECT_TRUE(says("read-only: take control of /tip")) << said().toStdString();
    EXPECT_FALSE(pad().button(0, 1).isEnabled());
}

TEST_F(JoggingTheTip, WithoutControlNothingIsSentAlthoughTheAgentIsOpen) {
    ASSERT_NO_FATAL_FAILURE(opensTip());
    EXPECT_TRUE(says("read-only: take control of /tip")) << said().toStdString();
    EXPECT_FALSE(pad().button(0, 1).isEnabled());
    const double executed = number("/robot", "commandCount");
    pad().setFocus();
    QTest::keyPress(&pad(), Qt::Key_Right);
    EXPECT_TRUE(says("Not jogged: read-only: take control of /tip")) << said().toStdString();
    const std::int64_t then = cycle();
    EXPECT_TRUE(comes([&] { return cycle() > then + 200; }));
    EXPECT_EQ(number("/robot", "commandCount"), executed);
}

TEST_F(JoggingTheTip, AChainWithADriveThatIsOffIsNotJogged) {
    ASSERT_NO_FATAL_FAILURE(opensTipInControl());
    session.send("/drives/2", "shutdown");
    EXPECT_TRUE(comes([this] {
        return pad().button(0, 1).toolTip() == QLatin1String{"the drive of A2 is in Standby"};
    })) << pad().button(0, 1).toolTip().toStdString();
    EXPECT_FALSE(pad().button(0, 1).isEnabled());
}

TEST_F(JoggingTheTip, WhereTheTipIsStandsInBracketsWhileNobodyComputesIt) {
    ASSERT_NO_FATAL_FAILURE(opensTip());
    EXPECT_TRUE(comes([this] { return said().contains("|0.000|"); })) << said().toStdString();
    ASSERT_EQ(live({"call", "/kinematics", "shutdown"}).exit, 0);
    EXPECT_TRUE(comes([this] { return said().contains("|[0.000]|"); })) << said().toStdString();
    EXPECT_TRUE(said().contains("Not live: these are the last numbers")) << said().toStdString();
}

class JoggingAnotherTip : public JoggingTheTip {
protected:
    JoggingAnotherTip() : JoggingTheTip{crane("0 0 0.2")} {}
};

TEST_F(JoggingAnotherTip, ATipThatIsNotThatOfTheControllerSaysSo) {
    ASSERT_NO_FATAL_FAILURE(opensTip());
    EXPECT_TRUE(says("The tip of /kinematics, with another tipPosition than /tip"))
        << said().toStdString();
}

class JoggingOneOfTwoTips : public JoggingTheTip {
protected:
    JoggingOneOfTwoTips() : JoggingTheTip{crane("0 0 0.2", true)} {}
};

TEST_F(JoggingOneOfTwoTips, TheTipOfTheControllerIsShown) {
    ASSERT_NO_FATAL_FAILURE(opensTip());
    EXPECT_TRUE(says("): /end")) << said().toStdString();
    EXPECT_FALSE(said().contains("tipPosition")) << said().toStdString();
}

}  // namespace
}  // namespace cortex::test
