// SPDX-License-Identifier: Apache-2.0
// The window at its smallest, with the largest text.
#include "gui/window_fixture.hpp"
#include "style/look.hpp"
#include "views/event_list.hpp"
#include "views/system_tree.hpp"
#include "widgets/text_label.hpp"
#include "window/control_bar.hpp"
#include "window/status_bar.hpp"
#include "window/stop_button.hpp"

#include <QPushButton>

#include <QtTest/QTest>
#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace cortex::gui;

class SmallWindow : public Window {
protected:
    SmallWindow() {
        Look::apply(Theme::Light, 1.5, QStringLiteral("Open Sans"));
        window.resize(800, 600);
        QApplication::processEvents();
    }
    ~SmallWindow() override { Look::apply(Theme::Light, 1, QStringLiteral("Open Sans")); }
    bool hasWhole(const QString& text) {
        for (const auto* label : window.findChildren<TextLabel*>()) {
            if (label->isVisible() && label->text() == text)
                return label->width() >= label->sizeHint().width();
        }
        return false;
    }
};

TEST_F(SmallWindow, LeavesOutOfTheStatusLineWhatHasNoRoom) {
    ASSERT_TRUE(everythingComes());
    window.refresh();
    QApplication::processEvents();
    const auto* status = window.findChild<StatusBar*>();
    for (const auto* each : status->findChildren<TextLabel*>()) {
        if (!each->isVisible()) continue;
        EXPECT_LE(each->sizeHint().width(), each->width()) << each->text().toStdString();
    }
}

TEST_F(SmallWindow, HasItsStateLeaseAndStopWhole) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    QApplication::processEvents();
    EXPECT_TRUE(hasWhole("Standby"));
    EXPECT_TRUE(hasWhole("Read-only"));
    EXPECT_GE(window.stopButton().width(), window.stopButton().sizeHint().width());
    session.isAlive();
    session.takeControl("/drive");
    EXPECT_TRUE(comes([this] { return window.control().holds(); }));
    EXPECT_TRUE(comes([this] { return hasWhole("You control /drive"); }));
    EXPECT_GE(window.stopButton().width(), window.stopButton().sizeHint().width());
    EXPECT_LE(window.minimumSizeHint().width(), 800) << "nothing is pushed out of it";
}

TEST_F(SmallWindow, HasItsTreeBehindAButtonUntilSomethingIsChosen) {
    ASSERT_TRUE(everythingComes());
    EXPECT_FALSE(window.tree().isVisible());
    ASSERT_TRUE(window.arrangement().treeButton().isVisible());
    window.arrangement().treeButton().click();
    EXPECT_TRUE(window.tree().isVisible());
    EXPECT_FALSE(window.current()->isVisible());
    Q_EMIT window.tree().chosen("/drive");
    EXPECT_FALSE(window.tree().isVisible());
    EXPECT_TRUE(window.current()->isVisible());
    QApplication::setActiveWindow(&window);
    QTest::keyClick(&window, Qt::Key_F, Qt::ControlModifier);
    EXPECT_TRUE(window.tree().isVisible()) << "its filter is in it";
}

TEST_F(SmallWindow, HasAllRegionsAgainWhenItIsLarge) {
    window.resize(1700, 1100);
    QApplication::processEvents();
    EXPECT_TRUE(window.tree().isVisible());
    EXPECT_FALSE(window.arrangement().treeButton().isVisible());
    EXPECT_TRUE(window.findChild<EventList*>()->isVisible());
}

}  // namespace
}  // namespace cortex::test
