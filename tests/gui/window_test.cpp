// SPDX-License-Identifier: Apache-2.0
// The whole window, offscreen, with a real agent over DDS.
#include "gui/window_fixture.hpp"
#include "model/item_model.hpp"
#include "plots/plot_view.hpp"
#include "style/look.hpp"
#include "views/base_view.hpp"
#include "views/event_list.hpp"
#include "views/event_table.hpp"
#include "views/graph_canvas.hpp"
#include "views/graph_view.hpp"
#include "views/system_tree.hpp"
#include "widgets/item_table.hpp"
#include "widgets/text_label.hpp"
#include "window/main_window.hpp"
#include "window/stop_button.hpp"

#include <QAbstractItemModelTester>
#include <QAction>
#include <QApplication>
#include <QElapsedTimer>
#include <QImage>
#include <QKeyEvent>
#include <QLineEdit>
#include <QTreeView>
#include <algorithm>
#include <csignal>
#include <functional>
#include <ranges>

#include <QtTest/QTest>

namespace cortex::test {
namespace {

using namespace gui;

TEST_F(Window, ShowsEverySimplexOfAnAgentItHasNeverHeardOf) {
    ASSERT_TRUE(everythingComes());
    const auto frame = session.frame();
    for (const AgentFrame& each : frame->agents) {
        for (const SimplexInfo& info : each.structure->simplexes) {
            EXPECT_TRUE(tree().indexOf(info.path).isValid()) << info.path;
        }
    }
}

TEST_F(Window, ShowsTheValuesThatTheAgentHas) {
    ASSERT_TRUE(everythingComes());
    const std::string path = anActiveSimplex();
    window.open(path);
    EXPECT_TRUE(comes([this] { return valueOf("state") == "Standby (0)"; }))
        << valueOf("state").toStdString();
    EXPECT_EQ(live({"call", path, "startup"}).exit, 0);
    EXPECT_TRUE(comes([this] { return valueOf("state") == "Active (2)"; }))
        << valueOf("state").toStdString();
    EXPECT_TRUE(wordOf(path).contains("Active")) << wordOf(path).toStdString();
}

TEST_F(Window, SaysThatAnAgentIsLostAndPutsItsLastValuesInBrackets) {
    ASSERT_TRUE(everythingComes());
    const std::string path = anActiveSimplex();
    window.open(path);
    ASSERT_TRUE(comes([this] { return valueOf("state") == "Standby (0)"; }));
    agent->end(SIGKILL);
    EXPECT_TRUE(comes([&] { return wordOf(path).contains("lost"); })) << wordOf(path).toStdString();
    EXPECT_TRUE(comes([this] { return valueOf("state") == "[Standby (0)]"; }))
        << "the last value stays, and never looks live: " << valueOf("state").toStdString();
    const auto says = [this](const QString& text) {
        const auto labels = window.current()->findChildren<TextLabel*>();
        return std::ranges::any_of(labels, [&](const auto* each) {
            return each->isVisible() && each->text().contains(text);
        });
    };
    EXPECT_TRUE(says("Values are the last ones, in brackets."));
    EXPECT_TRUE(says(" old")) << "with their age";
}

TEST_F(Window, FillsItselfAgainWhenTheAgentComesBack) {
    ASSERT_TRUE(everythingComes());
    const std::string path = anActiveSimplex();
    window.open(path);
    agent->end(SIGKILL);
    ASSERT_TRUE(comes([&] { return wordOf(path).contains("lost"); }));
    start();
    EXPECT_TRUE(comes([this] { return valueOf("state") == "Standby (0)"; }))
        << valueOf("state").toStdString();
    EXPECT_FALSE(wordOf(path).contains("lost"));
}

TEST_F(Window, FiltersTheTreeAndNamesWhatIsWrongWithAFilter) {
    ASSERT_TRUE(everythingComes());
    const int before = tree().rowCount();
    window.tree().filter(QStringLiteral("agent:nobody"));
    EXPECT_EQ(tree().rowCount(), 0);
    window.tree().filter({});
    EXPECT_EQ(tree().rowCount(), before);
}

TEST_F(Window, DrawsWhatIsRelatedAndOpensItByKey) {
    ASSERT_TRUE(everythingComes());
    window.openKind("system");
    window.refresh();
    const SystemGraph& graph = qobject_cast<GraphView*>(window.current())->graph();
    ASSERT_FALSE(graph.edges.empty());
    const auto frame = session.frame();
    for (const GraphNode& node : graph.nodes) {
        for (const std::string& path : node.paths) EXPECT_TRUE(frame->find(path)) << path;
    }
    auto* canvas = window.current()->findChild<GraphCanvas*>();
    const std::string path = graph.nodes.front().paths.front();
    canvas->select(0);
    QKeyEvent enter{QEvent::KeyPress, Qt::Key_Return, Qt::NoModifier};
    QApplication::sendEvent(canvas, &enter);
    const auto* shown = qobject_cast<BaseView*>(window.current());
    ASSERT_NE(shown, nullptr) << "Enter opens the simplex that is chosen";
    EXPECT_EQ(shown->path(), path);
}

TEST_F(Window, FiltersByTheValuesThatAreThere) {
    ASSERT_TRUE(everythingComes());
    const auto finds = [this](const char* filter, const std::string& path) {
        window.tree().filter(QString::fromUtf8(filter));
        return tree().indexOf(path).isValid();
    };
    const std::string path = anActiveSimplex();
    EXPECT_TRUE(finds("state=Standby", path)) << "a label";
    EXPECT_TRUE(finds("state<1", path)) << "its number";
    EXPECT_FALSE(finds("state>=1", path));
    EXPECT_FALSE(finds("state=Active", path));
    EXPECT_TRUE(finds("state!=Active", path));
    EXPECT_FALSE(finds("state<1furlong", path)) << "a unit that the item does not have";
    EXPECT_FALSE(finds("outside", path));
    window.tree().filter({});
}

TEST_F(Window, ShowsEventsInATabInPlaceOfTheStripWithTheSameFilter) {
    ASSERT_TRUE(everythingComes());
    ASSERT_EQ(live({"call", "/mixer", "startup"}).exit, 0);
    const auto* strip = window.findChild<EventList*>();
    EXPECT_TRUE(strip->isVisible());
    window.openKind("events");
    EXPECT_FALSE(strip->isVisible());
    const auto& rows = *window.current()->findChild<EventTable*>()->model();
    EXPECT_TRUE(comes([&] { return rows.rowCount() > 4; }));
    window.current()->findChild<QLineEdit*>()->setText("in:/drive kind:\"state change\"");
    const auto isActive = [&](int row) {
        return rows.index(row, EventModel::Text).data().toString().contains("-> Active");
    };
    ASSERT_TRUE(
        comes([&] { return std::ranges::any_of(std::views::iota(0, rows.rowCount()), isActive); }));
    for (int row = 0; row < rows.rowCount(); ++row) {
        EXPECT_EQ(rows.index(row, EventModel::Path).data(), "/drive");
    }
    window.open("/drive");
    EXPECT_TRUE(strip->isVisible());
    const auto& same = *strip->findChild<EventTable*>()->model();
    EXPECT_TRUE(comes([&] { return same.rowCount() == rows.rowCount(); }))
        << same.rowCount() << " and " << rows.rowCount();
}

// Labels end with … only where their text is whole in the tooltip.
TEST_F(Window, CutsNoTextWithoutATooltipInAnyThemeOrSize) {
    ASSERT_TRUE(everythingComes());
    window.open(anActiveSimplex());
    for (const Theme theme : allThemes) {
        for (const double scale : {1.0, 1.25, 1.5}) {
            Look::apply(theme, scale, QStringLiteral("Open Sans"));
            QApplication::processEvents();  // lays everything out anew
            const QImage image = window.grab().toImage();
            EXPECT_EQ(image.size(), window.size());
            for (const auto* label : window.findChildren<TextLabel*>()) {
                if (!label->isVisible() || label->text().isEmpty()) continue;
                EXPECT_GE(label->font().pointSizeF(), 9);
                const bool fits = label->sizeHint().width() <= label->width();
                EXPECT_TRUE(fits || !label->toolTip().isEmpty()) << label->text().toStdString();
                EXPECT_GE(label->height(), label->fontMetrics().height())
                    << label->text().toStdString();
            }
        }
    }
    Look::apply(Theme::Light, 1, QStringLiteral("Open Sans"));
}

// Whether all of it can be seen, and nothing of its text is cut.
void expectWhole(const MainWindow& window, const QWidget& widget, const QString& what) {
    ASSERT_TRUE(widget.isVisibleTo(&window)) << what.toStdString();
    EXPECT_GE(widget.width(), widget.sizeHint().width()) << what.toStdString();
    const QRect place{widget.mapTo(&window, QPoint{}), widget.size()};
    EXPECT_TRUE(window.rect().contains(place))
        << what.toStdString() << " ends at " << place.right();
}

TEST_F(Window, NeverCutsStateQualityStopAndControl) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    for (const char* family : {"Open Sans", "DejaVu Sans"}) {
        for (const double scale : {1.0, 1.25, 1.5}) {
            for (const QSize size : {QSize{800, 600}, QSize{1280, 800}}) {
                Look::apply(Theme::Light, scale, QString::fromLatin1(family));
                window.resize(size);
                window.refresh();
                QApplication::processEvents();
                window.grab();
                const QString what =
                    QStringLiteral("%1 %2 %3 ").arg(family).arg(scale).arg(size.width());
                expectWhole(window, window.stopButton(), what + "Stop");
                for (const auto* label : window.findChildren<TextLabel*>()) {
                    const QString text = label->text();
                    const bool never = text == "Standby" || text.startsWith("quality ") ||
                                       text.endsWith("Stop works");
                    if (never) expectWhole(window, *label, what + text);
                }
            }
        }
    }
    Look::apply(Theme::Light, 1, QStringLiteral("Open Sans"));
}

TEST_F(Window, ShowsTheTreeInPlaceOfTheViewsWhereItIsNarrow) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    EXPECT_TRUE(window.tree().isVisible());
    window.resize(800, 600);
    QApplication::processEvents();
    EXPECT_FALSE(window.tree().isVisible());
    EXPECT_TRUE(window.current()->isVisible());
    QTest::keyClick(&window, Qt::Key_B, Qt::ControlModifier);
    EXPECT_TRUE(window.tree().isVisible());
    EXPECT_FALSE(window.current()->isVisible());
    QTest::keyClick(window.tree().findChild<QTreeView*>(), Qt::Key_Down);
    EXPECT_TRUE(window.tree().isVisible()) << "arrows only go through it";
    QTest::keyClick(window.tree().findChild<QTreeView*>(), Qt::Key_Return);
    EXPECT_FALSE(window.tree().isVisible()) << "something was chosen";
    EXPECT_TRUE(window.current()->isVisible());
    window.resize(1280, 800);
    QApplication::processEvents();
    EXPECT_TRUE(window.tree().isVisible());
}

TEST(WindowAlone, SaysThatNobodyIsHeard) {
    Session session{ownNetwork()};
    MainWindow window{session};
    window.show();
    const auto says = [&](const QString& text) {
        for (const auto* label : window.findChildren<TextLabel*>()) {
            if (label->text().contains(text)) return true;
        }
        return false;
    };
    EXPECT_TRUE(comes([&] { return says("Nobody is heard in domain"); }));
}

TEST(WindowAlone, SaysWhyADomainCannotBeJoinedAndPaintsAllTheSame) {
    comms::NetworkOptions options = ownNetwork();
    options.interfaces = {"no-such-interface"};
    Session session{options};
    MainWindow window{session};
    window.show();
    EXPECT_TRUE(comes([&] { return !session.frame()->problem.empty(); }));
    EXPECT_TRUE(contains(session.frame()->problem, "no-such-interface"))
        << session.frame()->problem;
    EXPECT_FALSE(window.grab().isNull());
}

TEST_F(Window, PutsAValueIntoAPlotByPAndAnotherOneIntoTheSame) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    window.refresh();
    const auto* view = window.current();
    auto* table = view->findChild<ItemTable*>();
    const auto plotThe = [&](const QString& item) {
        const auto found = table->model()->match(table->model()->index(0, 0), Qt::DisplayRole, item,
                                                 1, Qt::MatchExactly | Qt::MatchRecursive);
        ASSERT_FALSE(found.isEmpty()) << item.toStdString();
        table->setCurrentIndex(found.front());
        for (QAction* each : table->actions()) {
            if (each->shortcut() == QKeySequence{Qt::Key_P}) each->trigger();
        }
    };
    plotThe(QStringLiteral("position"));
    auto* plot = qobject_cast<PlotView*>(window.current());
    ASSERT_NE(plot, nullptr);
    plotThe(QStringLiteral("state"));
    EXPECT_EQ(window.current(), plot);
    ASSERT_EQ(plot->lines().all().size(), 2U);
    EXPECT_TRUE(comes([&] {
        window.refresh();
        return plot->drawn().front().any() && plot->drawn().back().any();
    }));
}

}  // namespace
}  // namespace cortex::test
