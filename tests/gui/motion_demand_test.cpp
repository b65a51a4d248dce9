// SPDX-License-Identifier: Apache-2.0
// Demands that are entered for axes, in the window, with a real agent over DDS.
#include "gui/motion_fixture.hpp"
#include "gui/places.hpp"
#include "model/shown_units.hpp"
#include "style/look.hpp"
#include "window/workspace.hpp"

#include <QLineEdit>
#include <cmath>
#include <tuple>

namespace cortex::test {
namespace {

class Demands : public MotionWindow {
protected:
    bool isAt(const std::string& path, double position) {
        return comes([&] { return std::abs(number(path, "position") - position) < 1e-6; });
    }
    bool canMove(const QString& text) {
        return comes([&] { return named(text).isEnabled(); });
    }
    bool hasAmberEdge(int axis) { return row(axis).field().property("wrongInput").toBool(); }
    // The dot before the field.
    bool isMarked(int axis) {
        const QRect field = row(axis).field().geometry();
        const QPoint dot{field.left() - explorer::units(2), field.center().y()};
        return row(axis).grab().toImage().pixelColor(dot) ==
               row(axis).palette().color(QPalette::Highlight);
    }
    static bool isWhole(const QWidget& widget) {
        return widget.isVisible() && widget.visibleRegion() == QRegion{widget.rect()};
    }
    // The sentence that has these words can be read without scrolling.
    bool isSeen(const QString& words) {
        for (const auto* each : view().findChildren<QLabel*>()) {
            if (each->text().contains(words)) return isWhole(*each);
        }
        return false;
    }
};

TEST_F(Demands, AnotherModeIsAskedForByAButtonAndThenFieldsStandInThePlaceOfButtons) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/jog"));
    EXPECT_TRUE(button(0, 1).isVisible());
    named("Position").click();
    EXPECT_TRUE(comes([this] { return row(0).field().isVisible(); })) << said().toStdString();
    EXPECT_FALSE(button(0, 1).isVisible());
    rows().setFocus();
    QTest::keyPress(&rows(), Qt::Key_Right);
    EXPECT_FALSE(said().contains("Jogging"));
    QTest::keyRelease(&rows(), Qt::Key_Right);
    named("Velocity").click();
    EXPECT_TRUE(comes([this] { return button(0, 1).isVisible(); }));
}

TEST_F(Demands, AJogControllerGoesToWhatWasEntered) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/jog"));
    named("Position").click();
    ASSERT_TRUE(comes([this] { return row(0).field().isVisible(); }));
    speed().setValue(100);
    enter(0, "0,25");
    EXPECT_TRUE(says("1 not sent, 100 % of the speed")) << said().toStdString();
    ASSERT_TRUE(canMove("Move A1"));
    named("Move A1").click();
    EXPECT_TRUE(isAt("/arm/axes/1", 0.25)) << said().toStdString();
    EXPECT_TRUE(says("Done")) << said().toStdString();
    EXPECT_TRUE(says("0 not sent"));
}

TEST_F(Demands, ADemandBeyondALimitIsRefusedInTheWordsOfTheController) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/jog"));
    named("Position").click();
    ASSERT_TRUE(comes([this] { return row(0).field().isVisible(); }));
    enter(0, "9");
    ASSERT_TRUE(canMove("Move A1"));
    named("Move A1").click();
    EXPECT_TRUE(says("demandPosition[0] is 9, above 2.6, the limit of /arm/demands/1"))
        << said().toStdString();
}

TEST_F(Demands, ADemandBeyondALimitHasAnAmberEdgeAndItsReasonBeforeItIsSent) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/pose"));
    EXPECT_FALSE(hasAmberEdge(0));
    enter(0, "9");
    EXPECT_TRUE(hasAmberEdge(0));
    EXPECT_TRUE(said().contains("A1: above its limit of 2.600 rad.")) << said().toStdString();
    enter(1, "-1");
    EXPECT_TRUE(hasAmberEdge(1));
    EXPECT_TRUE(said().contains("A2: below its limit of −0.010 m.")) << said().toStdString();
    enter(0, "left");
    EXPECT_TRUE(hasAmberEdge(0));
    enter(0, "2.6");
    enter(1, "0");
    EXPECT_FALSE(hasAmberEdge(0) || hasAmberEdge(1));
    EXPECT_FALSE(said().contains("limit")) << said().toStdString();
}

TEST_F(Demands, WhatTheControllerRefusedStaysMarkedAndIsMarkedNoMoreOnceItIsReached) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/pose"));
    speed().setValue(100);
    enter(0, "9");
    enter(1, "0.01");
    EXPECT_TRUE(isMarked(0));
    ASSERT_TRUE(canMove("Move"));
    named("Move").click();
    ASSERT_TRUE(says("above 2.6, the limit of")) << said().toStdString();
    EXPECT_TRUE(says("0 not sent, 2 not reached")) << said().toStdString();
    EXPECT_TRUE(isMarked(0) && isMarked(1));
    EXPECT_TRUE(hasAmberEdge(0));
    EXPECT_EQ(row(0).field().text(), "9.000");
    enter(0, "0.1");
    ASSERT_TRUE(canMove("Move"));
    named("Move").click();
    EXPECT_TRUE(isAt("/arm/axes/1", 0.1)) << said().toStdString();
    EXPECT_TRUE(says("Done")) << said().toStdString();
    EXPECT_TRUE(comes([this] { return !isMarked(0) && !isMarked(1); }));
    EXPECT_FALSE(said().contains("not reached")) << said().toStdString();
}

TEST_F(Demands, WhatCameOfAMoveIsSeenWithoutScrolling) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/pose"));
    speed().setValue(100);
    for (const QSize size : {QSize{1280, 800}, QSize{1270, 765}, QSize{800, 600}}) {
        window.resize(size);
        enter(0, "9");
        ASSERT_TRUE(canMove("Move"));
        named("Move").click();
        EXPECT_TRUE(says("Rejected")) << said().toStdString();
        EXPECT_TRUE(comes([this] { return isSeen("Rejected"); })) << size.width();
        enter(0, "0.01");
        named("Move").click();
        EXPECT_TRUE(says("Done")) << said().toStdString();
        EXPECT_TRUE(comes([this] { return isSeen("Done"); })) << size.width();
        EXPECT_TRUE(isWhole(named("Move")) && isWhole(named("Halt"))) << size.width();
    }
}

TEST_F(Demands, ADemandThatIsNotSentIsShownInTheUnitThatIsChosen) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/pose"));
    enter(0, "0.5");
    named("deg").click();
    EXPECT_TRUE(comes([this] { return row(0).field().text() == "28.65"; }))
        << row(0).field().text().toStdString();
    EXPECT_TRUE(says("1 not sent")) << said().toStdString();
}

TEST_F(Demands, WhatIsNoNumberIsNotSent) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/pose"));
    enter(0, "left");
    EXPECT_TRUE(says("What was entered is no number")) << said().toStdString();
    EXPECT_FALSE(named("Move").isEnabled());
    named("Discard").click();
    EXPECT_TRUE(says("enter a target, or Copy current")) << said().toStdString();
    EXPECT_FALSE(named("Move").isEnabled());
}

TEST_F(Demands, NothingMovesToATargetThatNobodyGave) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/pose"));
    EXPECT_TRUE(says("enter a target, or Copy current")) << said().toStdString();
    EXPECT_FALSE(named("Move").isEnabled());
    named("Copy current").click();
    ASSERT_TRUE(canMove("Move"));
    named("Discard").click();
    EXPECT_TRUE(comes([this] { return !named("Move").isEnabled(); }));
    enter(1, "0.02");
    ASSERT_TRUE(canMove("Move"));
    named("Move").click();
    EXPECT_TRUE(isAt("/arm/axes/2", 0.02)) << said().toStdString();
    EXPECT_TRUE(says("Done")) << said().toStdString();
    EXPECT_TRUE(canMove("Move")) << "what was given once can be gone to again";
}

TEST_F(Demands, OneAxisIsMovedToWhatWasEnteredForIt) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/jog"));
    named("Position").click();
    ASSERT_TRUE(comes([this] { return row(0).field().isVisible(); }));
    EXPECT_FALSE(named("Move A1").isEnabled());
    enter(1, "0.02");
    ASSERT_TRUE(canMove("Move A2"));
    rows().setFocus();
    QTest::keyClick(&rows(), Qt::Key_Up);
    EXPECT_TRUE(says("enter a target, or Copy current")) << said().toStdString();
    EXPECT_FALSE(named("Move A1").isEnabled());
}

TEST_F(Demands, HaltNeedsNoControlWhereNobodyHasIt) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/jog"));
    named("Position").click();
    ASSERT_TRUE(comes([this] { return row(0).field().isVisible(); }));
    window.control().release();
    EXPECT_TRUE(says("read-only: take control of /jog")) << said().toStdString();
    ASSERT_TRUE(named("Halt").isEnabled());
    named("Halt").click();
    EXPECT_TRUE(comes([] { return contains(live({"events"}).output, "halt(): Done"); }))
        << live({"events"}).output;
}

TEST_F(Demands, APoseIsCollectedAndAllAxesMoveTogether) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/pose"));
    EXPECT_FALSE(button(0, 1).isVisible()) << "it has no command that jogs";
    speed().setValue(100);
    enter(0, "0.2");
    enter(1, "0.03");
    EXPECT_TRUE(says("2 not sent, 100 % of the speed")) << said().toStdString();
    EXPECT_EQ(number("/arm/demands/1", "position"), 0) << "nothing is sent yet";
    ASSERT_TRUE(canMove("Move"));
    named("Move").click();
    EXPECT_TRUE(isAt("/arm/axes/1", 0.2)) << said().toStdString();
    EXPECT_TRUE(isAt("/arm/axes/2", 0.03));
}

TEST_F(Demands, CopyCurrentEntersWhereTheAxesAreInTheUnitThatIsShown) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/pose"));
    named("deg").click();
    EXPECT_TRUE(comes([this] { return saidOf(0).contains("°"); })) << saidOf(0).toStdString();
    speed().setValue(100);
    enter(0, "30");
    ASSERT_TRUE(canMove("Move"));
    named("Move").click();
    EXPECT_TRUE(isAt("/arm/axes/1", 30 * std::acos(-1) / 180)) << said().toStdString();
    EXPECT_TRUE(comes([this] { return saidOf(0).contains("value 30.00°"); }));
    enter(0, "12");
    named("Copy current").click();
    EXPECT_EQ(row(0).field().text(), "30.00");
    named("mm").click();
    EXPECT_TRUE(comes([this] { return saidOf(1).contains("0.0 mm"); })) << saidOf(1).toStdString();
}

TEST_F(Demands, AMotionIsEndedByHalt) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/pose"));
    enter(0, "2");
    ASSERT_TRUE(canMove("Move"));
    named("Move").click();
    ASSERT_TRUE(comes([this] { return number("/arm/axes/1", "position") > 0.01; }));
    named("Halt").click();
    EXPECT_TRUE(says("ancelled")) << said().toStdString();
    EXPECT_LT(number("/arm/axes/1", "position"), 1.5);
}

class SteadyMotion : public Demands {
protected:
    ~SteadyMotion() override {
        gui::Look::apply(gui::Theme::Light, 1, QStringLiteral("Open Sans"));
    }
    void showAt(QSize size, double scale, const char* family) {
        gui::Look::apply(gui::Theme::Light, scale, QLatin1String{family});
        window.resize(size);
        for (int i = 0; i < 3; ++i) {
            window.refresh();
            QApplication::processEvents();  // what is laid out lays out more
        }
    }
};

TEST_F(SteadyMotion, NothingMovesWhenAJogBeginsAndEndsAndControlIsLost) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/jog"));
    for (const auto& [size, scale, family] :
         {std::tuple{QSize{800, 600}, 1.5, "DejaVu Sans"}, {QSize{1280, 800}, 1.0, "Open Sans"}}) {
        showAt(size, scale, family);
        rows().setFocus();
        for (const Qt::Key key : {Qt::Key_Down, Qt::Key_Up})  // the first row is scrolled to
            QTest::keyClick(&rows(), key);
        const Places before = placesIn(view());
        ASSERT_GE(before.size(), 10U);
        QTest::keyPress(&rows(), Qt::Key_Right);
        EXPECT_TRUE(says("Jogging A1 at ")) << said().toStdString();
        EXPECT_EQ(movedSince(before, view()), "") << "jogs, " << size.width();
        QTest::keyRelease(&rows(), Qt::Key_Right);
        EXPECT_TRUE(says("Ended: "));
        EXPECT_EQ(movedSince(before, view()), "") << "has ended, " << size.width();
    }
    const Places before = placesIn(view());
    window.control().release();
    EXPECT_TRUE(says("read-only: take control of /jog")) << said().toStdString();
    EXPECT_EQ(movedSince(before, view()), "");
}

TEST_F(SteadyMotion, NothingMovesWhenAMoveIsRefused) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/pose"));
    for (const auto& [size, scale, family] :
         {std::tuple{QSize{1280, 800}, 1.0, "DejaVu Sans"}, {QSize{800, 600}, 1.0, "Open Sans"}}) {
        showAt(size, scale, family);
        const Places before = placesIn(view());
        enter(0, "9");
        enter(1, "-9");
        enter(2, "9");
        EXPECT_EQ(movedSince(before, view()), "") << "what is wrong, " << size.width();
        ASSERT_TRUE(canMove("Move"));
        named("Move").click();
        EXPECT_TRUE(says("Rejected")) << said().toStdString();
        EXPECT_EQ(movedSince(before, view()), "") << "what came of it, " << size.width();
        named("Discard").click();
        window.refresh();
    }
}

}  // namespace
}  // namespace cortex::test
