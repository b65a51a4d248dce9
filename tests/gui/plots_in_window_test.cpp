// SPDX-License-Identifier: Apache-2.0
// Several plots in a window, units and zones that a view is told to, and what a layout keeps.
#include "gui/window_fixture.hpp"
#include "model/shown_time.hpp"
#include "plots/plot_view.hpp"
#include "views/base_view.hpp"
#include "views/compare_view.hpp"
#include "widgets/drop_zone.hpp"
#include "widgets/item_drag.hpp"
#include "window/layout_keeper.hpp"
#include "window/workspace.hpp"

#include <QAction>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QMenu>
#include <QTabBar>
#include <QTemporaryDir>
#include <memory>

#include <QtTest/QTest>

namespace cortex::test {
namespace {

class Plots : public Window {
protected:
    ~Plots() override { showLocalTime(false); }

    QStringList titles() {
        QStringList all;
        const Pane& shown = pane();
        for (int tab = 0; tab < shown.count(); ++tab) all << shown.title(tab);
        return all;
    }
    Pane& pane() { return *window.workspace().panes()[0]; }
    void press(const char* combination) {
        QApplication::setActiveWindow(&window);
        QTest::keySequence(&window, QKeySequence{QLatin1String{combination}});
    }
    PlotView* plot() { return qobject_cast<PlotView*>(window.current()); }
    int lines() { return plot() == nullptr ? -1 : static_cast<int>(plot()->lines().all().size()); }
    ItemTable& table() { return *window.current()->findChild<ItemTable*>(); }
    void choose(const QString& item) {
        const auto& rows = *table().model();
        for (int group = 0; group < rows.rowCount(); ++group) {
            const QModelIndex above = rows.index(group, 0);
            for (int row = 0; row < rows.rowCount(above); ++row) {
                const QModelIndex name = rows.index(row, ItemModel::Name, above);
                if (name.data() == item) return table().setCurrentIndex(name);
            }
        }
        FAIL() << "no " << item.toStdString();
    }
    // The entries of a submenu of the table, as if it were opened.
    QMenu* submenu(const QString& title) {
        for (QAction* each : table().actions()) {
            if (each->text() != title || each->menu() == nullptr) continue;
            Q_EMIT each->menu()->aboutToShow();
            return each->menu();
        }
        throw std::runtime_error{"no such menu"};
    }
    static QStringList entries(const QMenu& menu) {
        QStringList texts;
        for (const QAction* each : menu.actions()) {
            if (!each->isSeparator()) texts << each->text();
        }
        return texts;
    }
    static void trigger(const QMenu& menu, const QString& text) {
        for (QAction* each : menu.actions()) {
            if (each->text() == text) return each->trigger();
        }
        FAIL() << "no " << text.toStdString() << " in " << entries(menu).join(", ").toStdString();
    }
    void openData(const char* path) {
        window.open(path);
        window.openPart("data");
        window.refresh();
    }
    QString overTabs(const QPoint& at) {
        data.reset(mimeOf({{{}, "/axis/observed", "position", 0}}));
        QDragEnterEvent enter{at, Qt::CopyAction, data.get(), Qt::LeftButton, {}};
        QApplication::sendEvent(&pane().tabs(), &enter);
        return pane().zone().isVisible() ? pane().zone().words() : QStringLiteral("nothing");
    }
    void dropOnTabs(const QPoint& at) {
        overTabs(at);
        QDropEvent drop{at, Qt::CopyAction, data.get(), Qt::LeftButton, {}};
        QApplication::sendEvent(&pane().tabs(), &drop);
        window.refresh();
    }

    std::unique_ptr<QMimeData> data;
};

TEST_F(Plots, CtrlGPlotsTheRowThatIsChosenOtherwiseAllNumbersOfTheSimplex) {
    ASSERT_TRUE(everythingComes());
    openData("/axis/observed");
    press("Ctrl+G");
    const int all = lines();
    EXPECT_GT(all, 1);
    press("Ctrl+W");
    openData("/axis/observed");
    choose("velocity");
    press("Ctrl+G");
    ASSERT_EQ(lines(), 1);
    EXPECT_EQ(plot()->lines().all()[0].item.item, "velocity");
}

TEST_F(Plots, CtrlGPlotsTheRowsOfAComparison) {
    ASSERT_TRUE(everythingComes());
    window.openKind("compare");
    qobject_cast<CompareView*>(window.current())->compare("position");
    window.refresh();
    press("Ctrl+G");
    EXPECT_EQ(lines(), 2);
}

TEST_F(Plots, CtrlGSaysWhereNothingIsChosen) {
    ASSERT_TRUE(everythingComes());
    window.openKind("agents");
    press("Ctrl+G");
    EXPECT_EQ(plot(), nullptr);
    EXPECT_EQ(titles().filter("Plot").size(), 0);
}

TEST_F(Plots, PlotInListsThePanelsOfEachPlotAndANewOne) {
    ASSERT_TRUE(everythingComes());
    window.openPlot({{{}, "/axis/observed", "position", 0}});
    ASSERT_TRUE(comes([this] { return plot()->lines().panels() == 1; }));
    window.workspace().newPlot({});
    EXPECT_EQ(titles().filter("Plot"), (QStringList{"Plot", "Plot 2"}));
    openData("/axis/observed");
    choose("velocity");
    QMenu* places = submenu("Plot in…");
    EXPECT_EQ(entries(*places),
              (QStringList{"Plot: position (rad)", "Plot: new panel", "Plot 2", "New plot"}));
    trigger(*places, "Plot: position (rad)");
    ASSERT_NE(plot(), nullptr);
    EXPECT_EQ(plot()->lines().panels(), 1);
    EXPECT_EQ(plot()->lines().titleOf(0), "position (rad), velocity (rad/s)");
    openData("/axis/observed");
    choose("effort");
    trigger(*submenu("Plot in…"), "New plot");
    EXPECT_EQ(titles().filter("Plot"), (QStringList{"Plot", "Plot 2", "Plot 3"}));
    EXPECT_EQ(lines(), 1);
}

TEST_F(Plots, ValuesOnTheBarOfTabsOpenANewPlotAndOnTheTabOfAPlotGoThere) {
    ASSERT_TRUE(everythingComes());
    const QPoint first = pane().tabs().tabRect(0).center();
    EXPECT_EQ(overTabs(first), "new plot");
    dropOnTabs(first);
    ASSERT_EQ(lines(), 1);
    EXPECT_FALSE(pane().zone().isVisible());
    window.workspace().newPlot({});
    ASSERT_EQ(lines(), 0);
    const int tab = static_cast<int>(titles().indexOf("Plot 2"));
    const QPoint second = pane().tabs().tabRect(tab).center();
    EXPECT_EQ(overTabs(second), "add to Plot 2");
    dropOnTabs(second);
    EXPECT_EQ(lines(), 1);
    EXPECT_EQ(titles().filter("Plot").size(), 2);
}

TEST_F(Plots, CtrlZInAPlotUndoesItsLinesAndNoItemThatWasSet) {
    ASSERT_TRUE(everythingComes());
    openData("/drive");
    window.workspace().split();
    window.openPlot({{{}, "/axis/observed", "position", 0}});
    window.openPlot({{{}, "/axis/observed", "velocity", 0}});
    ASSERT_EQ(lines(), 2);
    QApplication::setActiveWindow(&window);
    plot()->setFocus();
    QTest::keyClick(plot(), Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(lines(), 1);
}

TEST_F(Plots, ALayoutKeepsPlotsTheirUnitsAndTheZone) {
    ASSERT_TRUE(everythingComes());
    ShownUnits degrees;
    degrees.choose(0, "deg");
    openData("/axis/observed");
    window.workspace().units().choose(degrees);
    window.openPlot({{{}, "/axis/observed", "position", 0}});
    window.workspace().units().choose(degrees);
    window.workspace().newPlot({});
    showLocalTime(true);
    const QTemporaryDir kept;
    const QString file = kept.filePath("a.json");
    window.layouts().saveAs(file);
    window.layouts().reset();
    showLocalTime(false);

    window.layouts().open(file);

    window.refresh();
    EXPECT_TRUE(showsLocalTime());
    EXPECT_EQ(titles().filter("Plot"), (QStringList{"Plot", "Plot 2"}));
    pane().choose(static_cast<int>(titles().indexOf("Plot")));
    EXPECT_EQ(plot()->units(), degrees);
    openData("/axis/observed");
    EXPECT_EQ(qobject_cast<BaseView*>(window.current())->units(), degrees);
}

TEST_F(Plots, TheMenuOfTheWindowChoosesUnitsOfTheViewInFrontAndTheZone) {
    ASSERT_TRUE(everythingComes());
    openData("/axis/observed");
    const auto opened = [this](const QString& title) {
        const QObject* own = window.current()->findChild<ItemTable*>();  // with menus of its own
        for (QMenu* each : window.findChildren<QMenu*>()) {
            if (each->title() != title || (own != nullptr && each->parent() == own)) continue;
            Q_EMIT each->aboutToShow();
            return each;
        }
        throw std::runtime_error{"no such menu"};
    };
    trigger(*opened("Units of this view"), "Lengths in mm");
    EXPECT_EQ(qobject_cast<BaseView*>(window.current())->units().chosen(1), "mm");
    window.openKind("agents");
    EXPECT_EQ(entries(*opened("Units of this view")), QStringList{"This view shows no units"});
    const QStringList zones = entries(*opened("Times"));
    ASSERT_EQ(zones.size(), 2);
    trigger(*opened("Times"), zones[1]);
    EXPECT_TRUE(showsLocalTime());
}

}  // namespace
}  // namespace cortex::test
