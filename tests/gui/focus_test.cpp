// SPDX-License-Identifier: Apache-2.0
// The window by keyboard alone, with a real agent over DDS.
#include "gui/window_fixture.hpp"
#include "views/base_view.hpp"
#include "widgets/focus_edge.hpp"
#include "window/control_bar.hpp"

#include <QApplication>
#include <QLayout>
#include <QLineEdit>
#include <QPushButton>
#include <QTabBar>
#include <QTreeView>

#include <QtTest/QTest>

namespace cortex::test {
namespace {

class ByKeyboard : public Window {
protected:
    void press(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        QWidget* focused = QApplication::focusWidget();
        QTest::keyClick(focused != nullptr ? focused : &window, key, modifiers);
    }
    std::vector<QWidget*> walked(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        std::vector<QWidget*> all;
        for (int i = 0; i < 200; ++i) {
            press(key, modifiers);
            QWidget* now = QApplication::focusWidget();
            if (std::ranges::find(all, now) != all.end()) break;
            all.push_back(now);
        }
        return all;
    }
};

TEST_F(ByKeyboard, F6WalksThePartsOfTheWindowAndShiftF6GoesBack) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    window.activateWindow();
    window.tree().focusFilter();
    QWidget* filter = QApplication::focusWidget();
    press(Qt::Key_F6);
    EXPECT_NE(qobject_cast<QTabBar*>(QApplication::focusWidget()), nullptr);
    press(Qt::Key_F6);
    EXPECT_TRUE(window.current()->isAncestorOf(QApplication::focusWidget()));
    press(Qt::Key_F6, Qt::ShiftModifier);
    EXPECT_NE(qobject_cast<QTabBar*>(QApplication::focusWidget()), nullptr);
    press(Qt::Key_F6, Qt::ShiftModifier);
    EXPECT_EQ(QApplication::focusWidget(), filter);
    EXPECT_GE(walked(Qt::Key_F6).size(), 5U);
}

TEST_F(ByKeyboard, TabGoesFromTopToBottomInEachPartAndReachesEverything) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    window.activateWindow();
    const auto all = walked(Qt::Key_Tab);
    const auto firstOf = [&](QWidget& part) {
        return std::ranges::find_if(all, [&](QWidget* each) { return part.isAncestorOf(each); });
    };
    EXPECT_LT(firstOf(window.control()), firstOf(window.tree()));
    EXPECT_LT(firstOf(window.tree()), firstOf(*window.current()));
    EXPECT_LT(firstOf(*window.current()), all.end());
    int top = 0;
    for (QWidget* each : all) {
        if (!window.current()->isAncestorOf(each)) continue;
        const int y = each->mapTo(&window, QPoint{}).y();
        EXPECT_GE(y, top - 14) << each->metaObject()->className();
        top = std::max(top, y);
    }
    for (auto* each : window.findChildren<QPushButton*>()) {
        if (!each->isVisible() || !each->isEnabled() || each->focusPolicy() == Qt::NoFocus)
            continue;
        EXPECT_NE(std::ranges::find(all, each), all.end()) << each->text().toStdString();
    }
}

TEST_F(ByKeyboard, ATableThatHasTheFocusHasAnEdge) {
    ASSERT_TRUE(everythingComes());
    window.activateWindow();
    auto* rows = window.tree().findChild<QTreeView*>();
    auto* edge = window.findChild<FocusEdge*>();
    rows->setFocus();
    EXPECT_EQ(edge->around(), rows);
    EXPECT_TRUE(edge->isVisible());
    EXPECT_EQ(edge->size(), rows->size());
    window.layout()->setContentsMargins(0, 40, 0, 0);  // it moves the tree down
    QApplication::processEvents();
    edge->fit();
    EXPECT_EQ(edge->pos(), rows->mapTo(&window, QPoint{}));
    window.tree().focusFilter();
    EXPECT_FALSE(edge->isVisible());
}

TEST_F(ByKeyboard, HandingOverWithTheMouseLeavesTheKeyboardWhereItWas) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    window.activateWindow();
    session.takeControl("/drive");
    ASSERT_TRUE(comes([this] { return window.control().holds(); }));
    auto* rows = window.tree().findChild<QTreeView*>();
    rows->setFocus();
    QPushButton* handOver = nullptr;
    for (auto* each : window.control().findChildren<QPushButton*>())
        if (each->text() == QString::fromUtf8("Hand over…")) handOver = each;
    ASSERT_NE(handOver, nullptr);
    QTest::mouseClick(handOver, Qt::LeftButton);
    ASSERT_NE(window.control().handOverPanel(), nullptr);
    window.control().handOverPanel()->close();
    session.releaseControl();
    ASSERT_TRUE(comes([this] { return !window.control().holds(); }));
    EXPECT_EQ(window.focusWidget(), rows);
}

// Not on to the next button, which a second press of the key would press.
TEST_F(ByKeyboard, AButtonThatGoesGivesTheKeyboardToWhatIsBesideIt) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    window.activateWindow();
    session.takeControl("/drive");
    ASSERT_TRUE(comes([this] { return window.control().holds(); }));
    window.refresh();
    for (auto* each : window.current()->findChildren<QPushButton*>()) {
        if (each->text() != "Startup") continue;
        ASSERT_TRUE(each->isEnabled());
        each->setFocus();
        each->setEnabled(false);
    }
    const QWidget* now = QApplication::focusWidget();
    ASSERT_NE(now, nullptr);
    EXPECT_TRUE(window.current()->isAncestorOf(now));
    EXPECT_EQ(qobject_cast<const QPushButton*>(now), nullptr);
}

TEST_F(ByKeyboard, ARowThatIsChosenAlreadyComesToTheFrontAgain) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    window.openKind("events");
    auto* rows = window.tree().findChild<QTreeView*>();
    const QPoint at = rows->visualRect(window.tree().model().indexOf("/drive")).center();
    QTest::mouseClick(rows->viewport(), Qt::LeftButton, Qt::NoModifier, at);
    EXPECT_NE(qobject_cast<BaseView*>(window.current()), nullptr);
}

}  // namespace
}  // namespace cortex::test
