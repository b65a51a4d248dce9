// SPDX-License-Identifier: Apache-2.0
// The window at its smallest, with the largest text.
#include "gui/window_fixture.hpp"
#include "style/look.hpp"
#include "views/event_list.hpp"
#include "views/event_table.hpp"
#include "views/event_view.hpp"
#include "views/system_tree.hpp"
#include "widgets/text_label.hpp"
#include "window/control_bar.hpp"
#include "window/status_bar.hpp"
#include "window/stop_button.hpp"
#include "window/workspace.hpp"

#include <QLineEdit>
#include <QPushButton>
#include <QScrollBar>
#include <QTreeView>
#include <map>
#include <tuple>

#include <QtTest/QTest>
#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace cortex::gui;

struct LargeTexts {
    LargeTexts() { Look::apply(Theme::Light, 1.5, QStringLiteral("Open Sans")); }
    ~LargeTexts() { Look::apply(Theme::Light, 1, QStringLiteral("Open Sans")); }
};

// With large texts from the start.
class SmallWindow : LargeTexts, public Window {
protected:
    SmallWindow() {
        window.resize(800, 600);
        QApplication::processEvents();
    }
    // Where each table and tree of the views stands, and what of it is in sight.
    std::map<QWidget*, std::tuple<QRect, int, int>> viewsAsTheyAre() {
        for (int i = 0; i < 3; ++i) QApplication::processEvents();
        std::map<QWidget*, std::tuple<QRect, int, int>> all;
        for (auto* each : window.workspace().findChildren<QAbstractScrollArea*>()) {
            if (!each->isVisible()) continue;
            all[each] = {{each->mapTo(&window, QPoint{}), each->size()},
                         each->verticalScrollBar()->value(),
                         each->horizontalScrollBar()->value()};
        }
        return all;
    }
    void press(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        QApplication::setActiveWindow(&window);
        QWidget* focused = QApplication::focusWidget();
        QTest::keyClick(focused != nullptr ? focused : &window, key, modifiers);
    }
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
    EXPECT_TRUE(window.control().text().endsWith("Stop works"));
    EXPECT_TRUE(hasWhole(window.control().text()));
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

TEST_F(SmallWindow, LeadsBackFromItsTreeByAButtonAndByEscToViewsThatAreAsTheyWere) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    window.openPart("data");
    QApplication::setActiveWindow(&window);
    window.refresh();
    auto* table = window.current()->findChild<ItemTable*>();
    table->verticalScrollBar()->setValue(table->verticalScrollBar()->maximum());
    table->setFocus();
    const auto before = viewsAsTheyAre();
    ASSERT_FALSE(before.empty());
    auto& back = window.arrangement().backButton();
    EXPECT_FALSE(back.isVisible());

    window.arrangement().treeButton().click();
    ASSERT_TRUE(back.isVisible());
    back.click();
    EXPECT_FALSE(window.tree().isVisible());
    EXPECT_EQ(viewsAsTheyAre(), before);

    press(Qt::Key_F, Qt::ControlModifier);
    window.tree().filter("drive");
    ASSERT_TRUE(window.tree().isAncestorOf(QApplication::focusWidget()));
    press(Qt::Key_Escape);
    EXPECT_TRUE(window.tree().isVisible()) << "the filter is cleared first";
    EXPECT_EQ(window.tree().findChild<QLineEdit*>()->text(), "");
    press(Qt::Key_Escape);
    EXPECT_FALSE(window.tree().isVisible());

    table->setFocus();
    press(Qt::Key_B, Qt::ControlModifier);
    EXPECT_EQ(QApplication::focusWidget(), window.tree().findChild<QTreeView*>());
    press(Qt::Key_Escape);
    EXPECT_FALSE(window.tree().isVisible());
    EXPECT_EQ(QApplication::focusWidget(), table);
    EXPECT_EQ(viewsAsTheyAre(), before);
}

TEST_F(SmallWindow, IsNotLeftForTheViewsByArrowsInItsTreeButByEnter) {
    ASSERT_TRUE(everythingComes());
    window.open("/controller");
    press(Qt::Key_B, Qt::ControlModifier);
    const auto row = [this] {
        return tree().path(window.tree().findChild<QTreeView*>()->currentIndex());
    };
    for (int i = 0; i < 9 && row() != "/drive"; ++i) {
        press(Qt::Key_Down);
        ASSERT_TRUE(window.tree().isVisible());
        EXPECT_EQ(window.workspace().path(), "/controller");
    }
    ASSERT_EQ(row(), "/drive");
    press(Qt::Key_Return);
    EXPECT_FALSE(window.tree().isVisible());
    EXPECT_EQ(window.workspace().path(), "/drive");
}

TEST_F(SmallWindow, ShowsWhatIsOpenedWhileItsTreeIsInFront) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    for (const bool sameTab : {true, false}) {
        window.arrangement().showTree();
        ASSERT_TRUE(window.tree().isVisible());
        sameTab ? window.open("/controller") : window.openKind("events");
        EXPECT_FALSE(window.tree().isVisible());
        EXPECT_TRUE(window.current()->isVisible());
    }
}

TEST_F(SmallWindow, HasItsEventsInATabToWhichCtrlEAndFromWhichCtrlELeads) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    window.openTab("/controller");
    const auto before = viewsAsTheyAre();
    const auto* strip = window.findChild<EventList*>();
    press(Qt::Key_E, Qt::ControlModifier);
    EXPECT_TRUE(window.workspace().shows("events"));
    EXPECT_FALSE(strip->isVisible());
    press(Qt::Key_E, Qt::ControlModifier);
    EXPECT_EQ(window.workspace().path(), "/controller") << "it was in front";
    EXPECT_FALSE(strip->isVisible());
    EXPECT_EQ(viewsAsTheyAre(), before);
    window.arrangement().showTree();
    press(Qt::Key_E, Qt::ControlModifier);
    EXPECT_TRUE(window.workspace().shows("events"));
    EXPECT_TRUE(window.current()->isVisible());
}

TEST_F(SmallWindow, HasSixRowsOfEventsAlsoWithDetails) {
    ASSERT_TRUE(everythingComes());
    window.openKind("events");
    for (int i = 0; i < 9; ++i) window.plotChosen();  // it says that nothing is chosen
    auto& rows = *window.current()->findChild<EventTable*>();
    for (const char* family : {"DejaVu Sans", "Open Sans"}) {
        Look::apply(Theme::Light, 1.5, QLatin1String{family});
        window.refresh();
        QApplication::processEvents();
        const QRect place = rows.geometry();
        ASSERT_GT(rows.model()->rowCount(), 0);
        EXPECT_GE(rows.viewport()->height() / rows.rowHeight(0), 6) << family;
        rows.setCurrentIndex(rows.model()->index(0, 0));
        window.refresh();
        QApplication::processEvents();
        EXPECT_EQ(rows.geometry(), place) << "the row is still under the pointer";
    }
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
