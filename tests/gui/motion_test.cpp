// SPDX-License-Identifier: Apache-2.0
// Jogging in the window, with a real agent over DDS: how it begins, and each way in which it ends.
#include "gui/motion_fixture.hpp"
#include "motion/motion_views.hpp"
#include "program/key_repeat.hpp"
#include "views/manual_view.hpp"

#include <QLineEdit>
#include <QMenu>
#include <array>
#include <csignal>
#include <memory>
#include <span>
#include <tuple>

namespace cortex::test {
namespace {

class Jogging : public MotionWindow {
protected:
    explicit Jogging(const std::string& system = motionSystem(), QString lasts = "1")
        : MotionWindow{motionTypes, system}, lasts_{std::move(lasts)} {}
    void holdsButton() {
        ASSERT_NO_FATAL_FAILURE(opensInControl("/jog"));
        QTest::mousePress(&button(0, 1), Qt::LeftButton);
        ASSERT_TRUE(movesByButton([this] { return number("/arm/axes/1", "position") > 0.01; }))
            << said().toStdString() << testing::PrintToString(endings);
        ASSERT_TRUE(
            said().contains("Jogging A1 at +0.100 rad/s. It brakes when you let go, after " +
                            lasts_ + " s at the latest."))
            << said().toStdString();
    }
    bool movesByButton(const std::function<bool()>& hasMoved) {
        return moves([this] { QTest::mouseRelease(&button(0, 1), Qt::LeftButton); },
                     [this] { QTest::mousePress(&button(0, 1), Qt::LeftButton); }, hasMoved);
    }
    void holdsKey() {
        ASSERT_NO_FATAL_FAILURE(opensInControl("/jog"));
        rows().setFocus();
        QTest::keyPress(&rows(), Qt::Key_Left);
        ASSERT_TRUE(moves([this] { QTest::keyRelease(&rows(), Qt::Key_Left); },
                          [this] { QTest::keyPress(&rows(), Qt::Key_Left); },
                          [this] { return number("/arm/axes/1", "position") < -0.01; }))
            << said().toStdString() << testing::PrintToString(endings);
    }

private:
    QString lasts_;
};

TEST(NamesOfAxes, AreToldApartByTheirPathsWhereTheyAreShared) {
    std::vector<explorer::MotionAxis> axes(5);
    const std::array paths{"/left/axes/1", "/right/axes/1", "/lift", "/left/axes/2", ""};
    for (std::size_t i = 0; i < axes.size(); ++i) {
        axes[i].axis = paths[i];
        axes[i].name = i < 2 ? "A1" : i == 2 ? "lift" : i == 3 ? "A2" : "x";
    }
    explorer::tellApart(axes);
    QStringList names;
    for (const explorer::MotionAxis& each : axes) names << each.name;
    EXPECT_EQ(names.join(' '), "left/axes/1 right/axes/1 lift A2 x");
}

TEST(ViewsOfMotion, NameTheirSectionOfTheManual) {
    const explorer::Plugin& plugin = explorer::motionViews();
    gui::ManualView manual;
    for (const explorer::ViewType& each : std::span{plugin.views, plugin.count}) {
        const std::unique_ptr<explorer::View> view{each.make("/x")};
        EXPECT_EQ(gui::ManualView::sectionOf(view.get()), "Moving axes") << each.name;
        EXPECT_TRUE(manual.openAt(gui::ManualView::sectionOf(view.get())));
    }
}

// A late one must expire, or the axis would move on after a standstill of the network.
TEST(OrderOfAJog, ComesThriceInItsHoldTimeAndLivesNoLongerThanIt) {
    using namespace std::chrono_literals;
    const auto orderFor = [](double lasts) {
        explorer::HeldOrder order;
        explorer::Jog jog{
            [](int axis, double velocity) -> explorer::Order {
                return {"/jog", "jog", {{"axis", std::int64_t{axis}}, {"velocity", velocity}}};
            },
            [&](QWidget& /*held*/, const explorer::HeldOrder& begun) {
                order = begun;
                return static_cast<explorer::Hold*>(nullptr);
            }};
        QWidget button;
        jog.start(button, 3, -0.5, lasts);
        return order;
    };
    for (const auto& [holds, period, budget] :
         {std::tuple{0.25, 83ms, 250ms}, {0.06, 20ms, 60ms}, {1.0, 100ms, 1000ms}}) {
        const explorer::HeldOrder order = orderFor(holds);
        EXPECT_EQ(order.every, period) << holds;
        EXPECT_EQ(order.order.budget, budget) << holds;
        EXPECT_EQ(std::get<std::vector<double>>(order.order.arguments.at("velocity")),
                  std::vector{-0.5});
        EXPECT_EQ(std::get<std::vector<double>>(order.atEnd.value().at("velocity")),
                  std::vector{0.0});
        EXPECT_EQ(std::get<std::vector<std::int64_t>>(order.atEnd.value().at("axis")),
                  std::vector<std::int64_t>{3});
    }
}

TEST_F(Jogging, TheAxisMovesWhileAButtonIsHeldAndStopsWhenItIsLetGo) {
    ASSERT_NO_FATAL_FAILURE(holdsButton());
    QTest::mouseRelease(&button(0, 1), Qt::LeftButton);
    ends("let go");
}

TEST_F(Jogging, AnArrowKeyJogsTheChosenAxisWhileItIsHeld) {
    ASSERT_NO_FATAL_FAILURE(holdsKey());
    EXPECT_TRUE(button(0, -1).isDown());
    QTest::keyRelease(&rows(), Qt::Key_Left);
    ends("let go");
    EXPECT_TRUE(comes([this] { return !button(0, -1).isDown(); }));
    QTest::keyClick(&rows(), Qt::Key_Down);
    EXPECT_EQ(rows().selected(), 1);
    QTest::keyPress(&rows(), Qt::Key_Right);
    EXPECT_TRUE(comes([this] { return number("/arm/axes/2", "position") > 0.002; }));
    QTest::keyRelease(&rows(), Qt::Key_Right);
    ends("let go");
}

TEST_F(Jogging, AKeyThatRepeatsItselfBeginsNothing) {
    ASSERT_NO_FATAL_FAILURE(holdsKey());
    QTest::keyClick(&rows(), Qt::Key_Escape);
    EXPECT_TRUE(says("Ended: Esc"));
    QKeyEvent again{QEvent::KeyPress, Qt::Key_Left, Qt::NoModifier, {}, true};
    QApplication::sendEvent(&rows(), &again);
    ends("Esc");
}

// By a release and a press of one moment, which Qt does not mark for certain.
TEST_F(Jogging, AKeyJogsOnWhileX11RepeatsIt) {
    const gui::KeyRepeat filter{*QApplication::instance()};
    ASSERT_NO_FATAL_FAILURE(holdsKey());
    for (ulong moment = 1'000; moment < 1'020; ++moment) {
        for (const QEvent::Type type : {QEvent::KeyRelease, QEvent::KeyPress}) {
            QKeyEvent event{type, Qt::Key_Left, Qt::NoModifier};
            event.setTimestamp(moment);
            QCoreApplication::sendEvent(window.windowHandle(), &event);
        }
        QApplication::processEvents();
        ASSERT_TRUE(button(0, -1).isDown()) << said().toStdString();
    }
    QKeyEvent release{QEvent::KeyRelease, Qt::Key_Left, Qt::NoModifier};
    QCoreApplication::sendEvent(window.windowHandle(), &release);
    ends("let go");
}

TEST_F(Jogging, EndsWithEscape) {
    ASSERT_NO_FATAL_FAILURE(holdsButton());
    QTest::keyClick(&window, Qt::Key_Escape);
    ends("Esc");
}

TEST_F(Jogging, APointerThatLeavesAndComesBackBeginsNothing) {
    ASSERT_NO_FATAL_FAILURE(holdsButton());
    QWidget& held = button(0, 1);
    const auto moveTo = [&](QPoint place) {
        QMouseEvent move{QEvent::MouseMove, place,          held.mapToGlobal(place),
                         Qt::NoButton,      Qt::LeftButton, Qt::NoModifier};
        QApplication::sendEvent(&held, &move);
    };
    moveTo({-50, 5});
    moveTo({5, 5});
    ends("the pointer left the button");
}

TEST_F(Jogging, EndsWhenAnotherKeyIsPressedAndAKeyThatIsStillHeldBeginsNothing) {
    ASSERT_NO_FATAL_FAILURE(holdsKey());
    QTest::keyPress(&rows(), Qt::Key_Shift);
    EXPECT_TRUE(says("Ended: another key was pressed")) << said().toStdString();
    QTest::keyRelease(&rows(), Qt::Key_Shift);
    QKeyEvent again{QEvent::KeyPress, Qt::Key_Left, Qt::NoModifier, {}, true};
    QApplication::sendEvent(&rows(), &again);
    ends("another key was pressed");
}

TEST_F(Jogging, AButtonOfTheMouseEndsWhatAKeyHolds) {
    ASSERT_NO_FATAL_FAILURE(holdsKey());
    QTest::mousePress(view().findChild<MotionBar*>(), Qt::RightButton);
    ends("another button was pressed");
}

TEST_F(Jogging, WhatTheControllerEndsStaysEnded) {
    ASSERT_NO_FATAL_FAILURE(holdsButton());
    const std::int64_t then = cycle();
    EXPECT_TRUE(movesByButton([&] { return cycle() > then + 200; }))
        << testing::PrintToString(endings);
    session.send("/jog", "shutdown");
    EXPECT_TRUE(says("Ended: ")) << said().toStdString();
    // The answer to a repeated order may come before the image that shows what it says.
    EXPECT_TRUE(comes([this] { return number("/jog", "state") != 2; }));
    session.send("/jog", "startup");
    EXPECT_TRUE(comes([this] { return number("/jog", "state") == 2; }));
    const std::int64_t since = cycle();
    bool again = false;
    EXPECT_TRUE(comes([&] {
        again = again || jogs();
        return cycle() > since + 200;
    }));
    EXPECT_FALSE(again);
}

// So short that its agent is not yet taken for lost when a jog ends.
class JoggingForAMoment : public Jogging {
protected:
    JoggingForAMoment() : Jogging{motionSystem(""), "0.25"} {}
};

TEST_F(JoggingForAMoment, AnAgentThatStoodStillForLongerThanTheHoldTimeGoesOnWithoutIt) {
    ASSERT_NO_FATAL_FAILURE(holdsButton());
    agent->send(SIGSTOP);
    EXPECT_TRUE(says("Ended: /jog did not answer for 0.")) << said().toStdString();
    agent->send(SIGCONT);
    const std::int64_t then = cycle();
    EXPECT_TRUE(comes([&] { return cycle() > then && number("/arm/demands/1", "velocity") == 0; }));
    const double rests = number("/arm/demands/1", "position");
    const std::int64_t since = cycle();
    EXPECT_TRUE(comes([&] { return cycle() > since + 300; }));
    EXPECT_EQ(number("/arm/demands/1", "position"), rests);
    EXPECT_FALSE(jogs());
}

TEST_F(Jogging, EndsWhenTheButtonMovesAwayFromUnderThePointer) {
    ASSERT_NO_FATAL_FAILURE(holdsButton());
    const QPoint pointer = button(0, 1).mapToGlobal(button(0, 1).rect().center());
    window.resize(1000, 800);
    QApplication::processEvents();
    ASSERT_FALSE(button(0, 1).rect().contains(button(0, 1).mapFromGlobal(pointer)));
    ends("the button moved away");
}

TEST_F(Jogging, EndsWhenTheWindowIsResizedByOthers) {
    ASSERT_NO_FATAL_FAILURE(holdsButton());
    window.windowHandle()->resize(1280, 801);
    ends("the window was resized");
}

TEST_F(Jogging, AKeyJogsOnWhereTheRowsMoveAsNoPointerHoldsIt) {
    ASSERT_NO_FATAL_FAILURE(holdsKey());
    const QPoint before = button(0, -1).mapTo(&window, {});
    window.resize(1000, 800);
    QApplication::processEvents();
    ASSERT_NE(button(0, -1).mapTo(&window, {}), before);
    EXPECT_TRUE(button(0, -1).isDown()) << said().toStdString();
    QTest::keyRelease(&rows(), Qt::Key_Left);
    ends("let go");
}

TEST_F(Jogging, EndsWhenTheFocusGoesElsewhere) {
    ASSERT_NO_FATAL_FAILURE(holdsKey());
    speed().setFocus();
    ends("focus left");
}

TEST_F(Jogging, EndsWhenAnotherWindowIsActive) {
    ASSERT_NO_FATAL_FAILURE(holdsButton());
    QWidget other;
    other.show();
    QApplication::setActiveWindow(&other);
    ends("focus left");
}

TEST_F(Jogging, EndsWhenAMenuOpens) {
    ASSERT_NO_FATAL_FAILURE(holdsKey());
    QMenu menu;
    menu.addAction("anything");
    menu.popup({10, 10});
    ends("focus left");
}

TEST_F(Jogging, EndsWhenTheProgramIsNotInFront) {
    ASSERT_NO_FATAL_FAILURE(holdsButton());
    QApplicationStateChangeEvent change{Qt::ApplicationInactive};  // as of a locked screen
    QApplication::sendEvent(qApp, &change);
    ends("focus left the program");
}

TEST_F(Jogging, EndsWhenAnotherAxisIsChosen) {
    ASSERT_NO_FATAL_FAILURE(holdsKey());
    QTest::keyPress(&rows(), Qt::Key_Down);
    ends("another key was pressed");
    EXPECT_EQ(rows().selected(), 1);
}

TEST_F(Jogging, EndsWithControlAndSaysSo) {
    ASSERT_NO_FATAL_FAILURE(holdsButton());
    window.control().release();
    ends("control was lost");
    EXPECT_TRUE(says("read-only: take control of /jog")) << said().toStdString();
    EXPECT_FALSE(button(0, 1).isEnabled());
}

TEST_F(Jogging, EndsWhenControlIsHandedOver) {
    ASSERT_NO_FATAL_FAILURE(holdsButton());
    session.handOver("somebody@else.1-000000");
    ends("control was lost");
}

TEST_F(Jogging, EndsWhenTheWindowHangs) {
    ASSERT_NO_FATAL_FAILURE(holdsButton());
    EXPECT_TRUE(comesWithoutEvents([this] { return !jogs(); }));
    ends("the window hung");
}

TEST_F(Jogging, TheSpeedChangesWhileItIsHeld) {
    ASSERT_NO_FATAL_FAILURE(holdsKey());
    speed().setValue(30);
    EXPECT_TRUE(says("Jogging A1 at −0.300 rad/s")) << said().toStdString();
    EXPECT_TRUE(comes([this] { return number("/arm/demands/1", "velocity") < -0.29; }));
    QTest::keyRelease(&rows(), Qt::Key_Left);
    ends("let go");
}

TEST_F(Jogging, WithoutControlNothingIsSentAlthoughTheAgentIsOpen) {
    ASSERT_NO_FATAL_FAILURE(opens("/jog"));
    EXPECT_TRUE(says("read-only: take control of /jog")) << said().toStdString();
    EXPECT_FALSE(button(0, 1).isEnabled());
    const double executed = number("/robot", "commandCount");
    QTest::mousePress(&button(0, 1), Qt::LeftButton);
    rows().setFocus();
    QTest::keyPress(&rows(), Qt::Key_Right);
    EXPECT_TRUE(says("Not jogged: read-only: take control of /jog")) << said().toStdString();
    const std::int64_t then = cycle();
    EXPECT_TRUE(comes([&] { return cycle() > then + 200; }));
    EXPECT_EQ(number("/robot", "commandCount"), executed);
    EXPECT_FALSE(jogs());
}

TEST_F(Jogging, NearALimitTheAxisSlowsDownStopsAndTheRowSaysSo) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/jog"));
    speed().setValue(40);
    QTest::mousePress(&button(1, 1), Qt::LeftButton);
    EXPECT_TRUE(says("Ended: at its upper limit")) << said().toStdString();
    EXPECT_TRUE(comes([this] { return saidOf(1).contains("at its upper limit"); }));
    EXPECT_TRUE(says("A2 is at its upper limit of 0.050 m: + is off until it has left it."))
        << said().toStdString();
    EXPECT_FALSE(button(1, 1).isEnabled());
    EXPECT_TRUE(button(1, -1).isEnabled());
    EXPECT_LE(number("/arm/demands/2", "position"), 0.05);
    QTest::mouseRelease(&button(1, 1), Qt::LeftButton);
    QTest::mousePress(&button(1, -1), Qt::LeftButton);
    EXPECT_TRUE(comes([this] { return !saidOf(1).contains("limit"); }));
    QTest::mouseRelease(&button(1, -1), Qt::LeftButton);
}

TEST_F(Jogging, AnAxisWithoutAStatedSpeedAsksForOneAndSaysWhy) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/jog"));
    EXPECT_TRUE(said().contains("Unstated states no greatest speed.")) << said().toStdString();
    EXPECT_FALSE(button(2, 1).isEnabled());
    QLineEdit* field = nullptr;
    for (auto* each : row(2).findChildren<QLineEdit*>()) {
        if (each->accessibleName() == "Greatest speed of A3") field = each;
    }
    ASSERT_NE(field, nullptr);
    QTest::keyClicks(field, "0,5");
    EXPECT_TRUE(comes([this] { return button(2, 1).isEnabled(); }));
    QTest::mousePress(&button(2, 1), Qt::LeftButton);
    EXPECT_TRUE(says("Jogging A3 at +0.050 rad/s")) << said().toStdString();
    EXPECT_TRUE(comes([this] { return number("/arm/axes/3", "position") > 0.005; }));
    QTest::mouseRelease(&button(2, 1), Qt::LeftButton);
    ends("let go");
}

TEST_F(Jogging, ADriveThatIsNotActiveIsNotJogged) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/jog"));
    EXPECT_TRUE(saidOf(0).contains("drive Active")) << saidOf(0).toStdString();
    ASSERT_TRUE(comes([this] { return button(0, 1).isEnabled(); }));
    session.send("/drives/1", "shutdown");
    EXPECT_TRUE(comes([this] { return saidOf(0).contains("drive Standby"); }));
    EXPECT_TRUE(comes([this] { return !button(0, 1).isEnabled(); }));
    EXPECT_TRUE(button(1, 1).isEnabled());
}

TEST_F(Jogging, TheSpeedStartsAtATenthEachTime) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/jog"));
    speed().setValue(80);
    window.open("/arm/axes/1");
    window.open("/jog");
    ASSERT_TRUE(comes([this] { return window.current()->findChild<MotionBar*>() != nullptr; }));
    EXPECT_EQ(speed().value(), 10);
}

TEST_F(Jogging, TheSpeedStartsAtATenthWheneverControlIsTakenAnew) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/jog"));
    speed().setValue(80);
    window.control().release();
    ASSERT_TRUE(says("read-only: take control of /jog")) << said().toStdString();
    ASSERT_TRUE(takes("/"));
    ASSERT_TRUE(comes([this] { return button(0, 1).isEnabled(); })) << said().toStdString();
    EXPECT_EQ(speed().value(), 10);
}

}  // namespace
}  // namespace cortex::test
