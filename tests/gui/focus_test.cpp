// SPDX-License-Identifier: Apache-2.0
// The window by keyboard alone, with a real agent over DDS.
#include "gui/window_fixture.hpp"
#include "motion/jog_button.hpp"
#include "views/base_view.hpp"
#include "views/compare_view.hpp"
#include "widgets/focus_edge.hpp"
#include "window/control_bar.hpp"

#include <QAbstractItemView>
#include <QApplication>
#include <QLayout>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QTabBar>
#include <QTimer>
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

TEST_F(ByKeyboard, TheWindowBeginsInTheRowsOfTheViewInFront) {
    const QWidget* first = window.focusWidget();
    EXPECT_NE(qobject_cast<const QTabBar*>(first), nullptr) << "no agent is known yet";
    ASSERT_TRUE(everythingComes());
    ASSERT_TRUE(comes([&] { return window.focusWidget() != first; }));
    const auto* rows = qobject_cast<const QAbstractItemView*>(window.focusWidget());
    ASSERT_NE(rows, nullptr);
    EXPECT_TRUE(window.current()->isAncestorOf(rows));
    EXPECT_GT(rows->model()->rowCount(), 0);
    QTest::keyClick(window.focusWidget(), Qt::Key_Down);
    EXPECT_TRUE(rows->currentIndex().isValid());
}

TEST_F(ByKeyboard, TheKeyboardStaysWhereAPersonHasPutItWhateverComes) {
    window.tree().focusFilter();
    const QWidget* filter = window.focusWidget();
    ASSERT_TRUE(everythingComes());
    for (int i = 0; i < 3; ++i) window.refresh();
    EXPECT_EQ(window.focusWidget(), filter);
}

TEST_F(ByKeyboard, EnterPressesWhatHasTheKeyboard) {
    ASSERT_TRUE(everythingComes());
    window.activateWindow();
    window.openKind("events");
    const auto buttons = window.current()->findChildren<QPushButton*>();
    const auto back =
        std::ranges::find_if(buttons, [](const auto* each) { return each->menu() != nullptr; });
    ASSERT_NE(back, buttons.end());
    bool opened = false;
    QObject::connect((*back)->menu(), &QMenu::aboutToShow, &window, [&] {
        opened = true;
        QTimer::singleShot(0, (*back)->menu(), &QWidget::close);
    });
    (*back)->setFocus();
    press(Qt::Key_Return);
    EXPECT_TRUE(opened);
}

TEST_F(ByKeyboard, EnterDoesNotJog) {
    explorer::JogButton jog{"+"};
    int pressed = 0;
    QObject::connect(&jog, &QPushButton::pressed, [&] { ++pressed; });
    jog.setParent(&window);
    jog.show();
    jog.setFocus();
    for (const Qt::Key key : {Qt::Key_Return, Qt::Key_Enter}) QTest::keyClick(&jog, key);
    EXPECT_EQ(pressed, 0);
    jog.setParent(nullptr);
}

TEST_F(ByKeyboard, F6WalksThePartsOfTheWindowAndShiftF6GoesBack) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    window.activateWindow();
    window.tree().focusFilter();
    QWidget* filter = QApplication::focusWidget();
    press(Qt::Key_F6);
    EXPECT_EQ(QApplication::focusWidget(), window.tree().findChild<QTreeView*>());
    press(Qt::Key_F6);
    EXPECT_NE(qobject_cast<QTabBar*>(QApplication::focusWidget()), nullptr);
    press(Qt::Key_F6);
    EXPECT_TRUE(window.current()->isAncestorOf(QApplication::focusWidget()));
    press(Qt::Key_F6, Qt::ShiftModifier);
    EXPECT_NE(qobject_cast<QTabBar*>(QApplication::focusWidget()), nullptr);
    press(Qt::Key_F6, Qt::ShiftModifier);
    press(Qt::Key_F6, Qt::ShiftModifier);
    EXPECT_EQ(QApplication::focusWidget(), filter);
    EXPECT_GE(walked(Qt::Key_F6).size(), 5U);
}

TEST_F(ByKeyboard, F6ReachesTheRowsOfEachViewInAHandfulOfPresses) {
    ASSERT_TRUE(everythingComes());
    window.activateWindow();
    for (int i = 0; i < 9; ++i) window.plotChosen();  // events: it says that nothing is chosen
    const auto reaches = [&](const std::string& view) {
        window.refresh();
        window.tree().focusFilter();
        for (int presses = 1; presses <= 5; ++presses) {
            press(Qt::Key_F6);
            const QWidget* now = QApplication::focusWidget();
            if (qobject_cast<const QAbstractItemView*>(now) != nullptr &&
                window.current()->isAncestorOf(now))
                return;
        }
        ADD_FAILURE() << view;
    };
    for (const char* kind : {"overview", "agents", "events", "compare"}) {
        window.openKind(kind);
        if (auto* compare = qobject_cast<CompareView*>(window.current())) compare->compare("state");
        reaches(kind);
        if (std::string_view{kind} != "events") continue;
        press(Qt::Key_F6, Qt::ShiftModifier);
        EXPECT_NE(qobject_cast<QLineEdit*>(QApplication::focusWidget()), nullptr)
            << "and back to its filter";
    }
    window.open("/drive");
    for (const char* part : {"data", "relationships", "type"}) {
        window.openPart(part);
        reaches(part);
    }
}

// What it paints with the focus, and without it.
TEST_F(ByKeyboard, EachStopOfTabShowsThatItHasTheFocus) {
    ASSERT_TRUE(everythingComes());
    window.activateWindow();
    const auto walk = [&](const std::string& view) {
        window.refresh();
        QApplication::processEvents();
        window.tree().focusFilter();
        std::vector<QWidget*> all;
        for (int i = 0; i < 100; ++i) {
            press(Qt::Key_Tab);
            QWidget* now = QApplication::focusWidget();
            if (std::ranges::find(all, now) != all.end()) break;
            all.push_back(now);
            const QRect place{now->mapTo(&window, QPoint{}), now->size()};
            const QImage focused = window.grab(place).toImage();
            now->clearFocus();
            EXPECT_NE(window.grab(place).toImage(), focused)
                << view << ": " << now->metaObject()->className() << ' '
                << now->accessibleName().toStdString();
            now->setFocus(Qt::TabFocusReason);
        }
        EXPECT_GT(all.size(), 2U) << view;
    };
    for (const char* kind :
         {"overview", "system", "agents", "events", "plot", "compare", "manual"}) {
        window.openKind(kind);
        walk(kind);
    }
    window.open("/drive");
    for (const char* part : {"data", "relationships", "commands", "type"}) {
        window.openPart(part);
        walk(part);
    }
}

TEST_F(ByKeyboard, TabGoesFromTopToBottomInEachPartAndReachesEverything) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    window.activateWindow();
    if (QWidget* now = QApplication::focusWidget()) now->clearFocus();
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
