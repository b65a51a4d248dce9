// SPDX-License-Identifier: Apache-2.0
// Keys as X11 repeats them: by a release and a press of one moment.
#include "program/key_repeat.hpp"

#include "gui/controlling.hpp"

#include <QApplication>
#include <QWidget>
#include <string>

#include <gtest/gtest.h>

namespace cortex::gui {
namespace {

// Notes what a widget hears of keys: "+1 " pressed, "~1 " pressed by repetition, "-1 " let go.
class Keys : public QWidget {
public:
    std::string heard;

protected:
    void keyPressEvent(QKeyEvent* event) override {
        heard += (event->isAutoRepeat() ? "~" : "+") + event->text().toStdString() + ' ';
    }
    void keyReleaseEvent(QKeyEvent* event) override {
        heard += (event->isAutoRepeat() ? "." : "-") + event->text().toStdString() + ' ';
    }
};

class RepeatedKeys : public testing::Test {
protected:
    RepeatedKeys() {
        keys.show();
        keys.setFocus();
        QApplication::setActiveWindow(&keys);
        QApplication::processEvents();
        keys.heard.clear();
    }
    void key(QEvent::Type type, int key, ulong moment, bool repeats = false) {
        QKeyEvent event{type, key, Qt::NoModifier, QString{QChar{key}}, repeats};
        event.setTimestamp(moment);
        QCoreApplication::sendEvent(keys.windowHandle(), &event);
    }
    void press(int which, ulong moment) { key(QEvent::KeyPress, which, moment); }
    void release(int which, ulong moment) { key(QEvent::KeyRelease, which, moment); }
    bool hears(const std::string& all) {
        return test::comes([&] { return keys.heard == all; });
    }

    Keys keys;
    KeyRepeat filter{*QApplication::instance()};
};

TEST_F(RepeatedKeys, AReleaseAndAPressOfOneMomentAreARepetition) {
    press('1', 100);
    for (const ulong moment : {700UL, 740UL, 780UL}) {
        release('1', moment);
        press('1', moment);
    }
    EXPECT_EQ(keys.heard, "+1 ~1 ~1 ~1 ");
    release('1', 800);
    EXPECT_TRUE(hears("+1 ~1 ~1 ~1 -1 ")) << keys.heard;
}

TEST_F(RepeatedKeys, AKeyThatIsPressedAgainIsNone) {
    press('1', 100);
    release('1', 150);
    press('1', 151);
    EXPECT_EQ(keys.heard, "+1 -1 +1 ") << "the release comes first, without waiting longer";
    release('1', 200);
    EXPECT_TRUE(hears("+1 -1 +1 -1 ")) << keys.heard;
}

TEST_F(RepeatedKeys, AKeyThatWasPressedElsewhereOnlyRepeatsHere) {
    release('1', 100);
    press('1', 100);
    EXPECT_EQ(keys.heard, "~1 ");
}

TEST_F(RepeatedKeys, AnotherKeyDoesNotOvertakeARelease) {
    press('1', 100);
    release('1', 150);
    press('2', 150);
    EXPECT_EQ(keys.heard, "+1 -1 +2 ");
}

TEST_F(RepeatedKeys, WhatIsMarkedAlreadyPasses) {
    press('1', 100);
    key(QEvent::KeyRelease, '1', 700, true);
    key(QEvent::KeyPress, '1', 700, true);
    EXPECT_EQ(keys.heard, "+1 .1 ~1 ");
}

TEST_F(RepeatedKeys, AReleaseComesBeforeTheFocusGoes) {
    press('1', 100);
    release('1', 150);
    QFocusEvent leaves{QEvent::FocusOut};
    QCoreApplication::sendEvent(keys.windowHandle(), &leaves);
    EXPECT_EQ(keys.heard, "+1 -1 ");
}

}  // namespace
}  // namespace cortex::gui
