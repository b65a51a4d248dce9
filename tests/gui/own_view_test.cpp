// SPDX-License-Identifier: Apache-2.0
// Views of plug-ins in the window, with a real agent over DDS.
#include "gui/controlling.hpp"
#include "gui/window_fixture.hpp"
#include "widgets/text_label.hpp"

#include <QLabel>
#include <QPushButton>
#include <QTabBar>

#include <QtTest/QTest>

namespace cortex::test {
namespace {

class OwnViews : public Window {
protected:
    QString said() {
        const auto* label = window.current()->findChild<QLabel*>("said");
        return label == nullptr ? QString{} : label->text();
    }
    bool anyLabelSays(const QString& text) {
        for (const auto* label : window.current()->findChildren<TextLabel*>()) {
            if (label->isVisible() && label->text().contains(text)) return true;
        }
        return false;
    }
    QTabBar& tabs() { return *window.current()->findChild<QTabBar*>(); }
};

TEST_F(OwnViews, AViewOfAPlugInIsTheFirstTabAndKnowsValuesAndRelationships) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    EXPECT_TRUE(comes([this] { return said() == "0.5000rad|live|Standby|1|/drive|—|—"; }))
        << said().toStdString();
    EXPECT_EQ(tabs().tabText(tabs().currentIndex()), "All");
    EXPECT_EQ(live({"call", "/drive", "startup"}).exit, 0);
    EXPECT_TRUE(comes([this] { return said().contains("|live|Active|"); })) << said().toStdString();
}

TEST_F(OwnViews, ASimplexWithoutOneShowsItsData) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    EXPECT_TRUE(comes([this] { return !said().isEmpty(); }));
    window.open("/axis/observed");
    EXPECT_TRUE(comes([this] { return tabs().currentIndex() == 1; }));
    EXPECT_FALSE(tabs().isTabVisible(0));
    window.open("/drive");
    EXPECT_TRUE(comes([this] { return tabs().currentIndex() == 0; }));
}

TEST_F(OwnViews, OneThatThrowsIsClosedWithWhatItThrew) {
    ASSERT_TRUE(everythingComes());
    window.open("/controller");
    EXPECT_TRUE(comes([this] { return anyLabelSays("it threw “out of paper”"); }));
}

// A view of a controller that jogs, in a window that may hold control.
class OwnOrders : public Controlling {
protected:
    OwnOrders() : Controlling{"JogController", longHold} {}
    void begin() {
        ASSERT_TRUE(everythingComes());
        ASSERT_EQ(live({"call", "/mixer", "startup", "prefix=/"}).exit, 0);
        window.open("/controller");
        ASSERT_TRUE(comes([this] { return isIn("/controller", State::Active); }));
        ASSERT_TRUE(comes([this] { return find<QPushButton>("jog") != nullptr; }));
    }
    template <class T>
    T* find(const char* name) {
        return window.current()->findChild<T*>(name);
    }
    QString textOf(const char* name) { return find<QLabel>(name)->text(); }
    QString valueIn(const char* path, const char* item) {
        const auto frame = session.frame();
        return explorer::SystemNow{*frame}.at(path).text(item);
    }
    int executed() { return valueIn("/mixer", "commandCount").toInt(); }
    void press() {
        QApplication::setActiveWindow(&window);
        find<QPushButton>("jog")->setFocus();
        QTest::mousePress(find<QPushButton>("jog"), Qt::LeftButton);
    }
    void jogs() {
        begin();
        ASSERT_TRUE(takes("/controller"));
        const int before = executed();
        press();
        ASSERT_TRUE(comes([&] { return executed() >= before + 3; }))
            << textOf("held").toStdString();
        EXPECT_EQ(textOf("held"), "runs");
    }
    bool ends(const QString& why) {
        return comes([&] { return textOf("held") == why; });
    }
};

TEST_F(OwnOrders, AreSentWithControlWhichTheWindowOffersToTake) {
    begin();
    const auto sends = [this] {
        find<QPushButton>("send")->click();
        return textOf("said").toStdString();
    };
    EXPECT_EQ(sends(), "needs Standby");
    EXPECT_EQ(live({"call", "/mixer", "shutdown", "prefix=/"}).exit, 0);
    ASSERT_TRUE(comes([this] { return isIn("/controller", State::Standby); }));
    EXPECT_EQ(sends(), "read-only: take control of /controller");
    ASSERT_TRUE(window.control().panel() != nullptr && window.control().panel()->isVisible());
    ASSERT_TRUE(takes("/controller"));
    sends();
    EXPECT_TRUE(comes([this] { return textOf("said").startsWith("Done"); }))
        << textOf("said").toStdString();
    EXPECT_TRUE(comes([this] { return valueIn("/controller", "holdTime").contains("0.2"); }));
}

TEST_F(OwnOrders, AHeldOneIsRepeatedUntilTheButtonIsLetGo) {
    jogs();
    QTest::mouseRelease(find<QPushButton>("jog"), Qt::LeftButton);
    EXPECT_TRUE(ends("let go"));
    EXPECT_TRUE(comes([this] { return valueIn("/controller", "jogging") == "false"; }));
}

TEST_F(OwnOrders, AHeldOneDoesNotBeginWithoutControl) {
    begin();
    press();
    EXPECT_TRUE(ends("read-only: take control of /controller")) << textOf("held").toStdString();
}

TEST_F(OwnOrders, AHeldOneEndsWhenTheFocusLeaves) {
    jogs();
    find<QPushButton>("send")->setFocus();
    EXPECT_TRUE(ends("focus left")) << textOf("held").toStdString();
}

TEST_F(OwnOrders, AHeldOneEndsWithEscape) {
    jogs();
    QTest::keyClick(&window, Qt::Key_Escape);
    EXPECT_TRUE(ends("Esc")) << textOf("held").toStdString();
}

TEST_F(OwnOrders, AHeldOneEndsWithControl) {
    jogs();
    window.control().release();
    EXPECT_TRUE(ends("control was lost")) << textOf("held").toStdString();
}

TEST_F(OwnOrders, AHeldOneEndsWhenTheWindowHangs) {
    jogs();
    EXPECT_TRUE(
        comesWithoutEvents([this] { return valueIn("/controller", "jogging") == "false"; }));
    EXPECT_TRUE(ends("the window hung")) << textOf("held").toStdString();
}

}  // namespace
}  // namespace cortex::test
