// SPDX-License-Identifier: Apache-2.0
// Lines that are dragged into a plot and between its panels, and what Ctrl+Z brings back.
#include "plot_fixture.hpp"
#include "plots/plot_panel.hpp"
#include "plots/tag_strip.hpp"
#include "widgets/drop_zone.hpp"
#include "widgets/item_drag.hpp"

#include <QDragEnterEvent>
#include <QDragLeaveEvent>
#include <QDropEvent>
#include <QMenu>
#include <QTest>
#include <memory>

namespace cortex::test {
namespace {

constexpr auto atRest = [](double) { return 0.5; };
constexpr auto rising = [](double seconds) { return seconds; };

class Arranged : public Plotted {
protected:
    Arranged() {
        view.add({position});
        show();
        run(500, rising);  // so that its tag is near the edge of its panel
        show();
    }
    QRect canvas(int panel) {
        const PlotPanel& of = *view.panels()[static_cast<std::size_t>(panel)];
        return of.canvasBox().translated(of.mapTo(&view, QPoint{}));
    }
    QPoint middle(int panel) { return canvas(panel).center(); }
    QPoint above(int panel) { return {canvas(panel).center().x(), canvas(panel).top() + 2}; }
    QPoint below(int panel) { return {canvas(panel).center().x(), canvas(panel).bottom() - 2}; }

    // What the outline says while these are over a place.
    QString over(const std::vector<RecordedItem>& items, const QPoint& at) {
        data.reset(mimeOf(items));
        QDragEnterEvent enter{at, Qt::CopyAction, data.get(), Qt::LeftButton, {}};
        QApplication::sendEvent(&view, &enter);
        QDragMoveEvent move{at, Qt::CopyAction, data.get(), Qt::LeftButton, {}};
        QApplication::sendEvent(&view, &move);
        return view.zone().isVisible() ? view.zone().words() : QStringLiteral("nothing");
    }
    void drop(const std::vector<RecordedItem>& items, const QPoint& at) {
        over(items, at);
        QDropEvent event{at, Qt::CopyAction, data.get(), Qt::LeftButton, {}};
        QApplication::sendEvent(&view, &event);
        show();
    }
    // Takes the tag of a line to a place, without letting it go.
    TagStrip& hold(int tag, const QPoint& at) {
        auto& strip = *view.findChildren<TagStrip*>()[line(tag).line.panel];
        EXPECT_FALSE(strip.boxOf(tag).isEmpty());
        QTest::mousePress(&strip, Qt::LeftButton, {}, strip.boxOf(tag).center());
        QMouseEvent move{QEvent::MouseMove, strip.mapFrom(&view, at), view.mapToGlobal(at),
                         Qt::NoButton,      Qt::LeftButton,           {}};
        QApplication::sendEvent(&strip, &move);
        return strip;
    }
    void dragTag(int tag, const QPoint& at) {
        TagStrip& strip = hold(tag, at);
        QMouseEvent release{QEvent::MouseButtonRelease,
                            strip.mapFrom(&view, at),
                            view.mapToGlobal(at),
                            Qt::LeftButton,
                            Qt::NoButton,
                            {}};
        QApplication::sendEvent(&strip, &release);
        show();
    }
    QStringList panels() {
        QStringList titles;
        for (int i = 0; i < view.lines().panels(); ++i) titles << view.lines().titleOf(i);
        return titles;
    }
    void undo() {
        QTest::keyClick(&view, Qt::Key_Z, Qt::ControlModifier);
        show();
    }

    std::unique_ptr<QMimeData> data;
};

TEST_F(Arranged, WhereAValueWouldGoIsOutlinedAndSaid) {
    EXPECT_EQ(over({demand}, middle(0)), "add to position (rad)");
    EXPECT_TRUE(canvas(0).contains(view.zone().geometry()));
    EXPECT_EQ(over({velocity}, middle(0)), "add to position (rad), at the right");
    EXPECT_EQ(over({demand}, above(0)), "new panel");
    EXPECT_EQ(over({mode}, middle(0)), "add as words below the panels");
    EXPECT_EQ(over({position}, middle(0)), "it is there already");
    QDragLeaveEvent leave;
    QApplication::sendEvent(&view, &leave);
    EXPECT_FALSE(view.zone().isVisible());
}

TEST_F(Arranged, AValueIsDroppedIntoAPanelAndBetweenPanels) {
    drop({demand}, middle(0));
    EXPECT_EQ(panels(), QStringList{"position (rad)"});
    drop({velocity}, above(0));
    EXPECT_EQ(panels(), (QStringList{"velocity (rad/s)", "position (rad)"}));
    EXPECT_FALSE(view.zone().isVisible());
}

TEST_F(Arranged, AThirdUnitIsToldToHaveAPanelOfItsOwn) {
    drop({velocity}, middle(0));
    EXPECT_EQ(panels(), QStringList{"position (rad), velocity (rad/s)"});
    const RecordedItem current{{}, "/demands/1", "current", 0};
    const QString words = over({current}, middle(0));
    EXPECT_EQ(words, "new panel: two other units are here");
}

TEST_F(Arranged, ALineIsDraggedByItsTagAndThePlaceIsSaid) {
    drop({velocity}, below(0));
    run(100, rising);
    show();
    ASSERT_EQ(panels(), (QStringList{"position (rad)", "velocity (rad/s)"}));
    hold(1, middle(1));
    EXPECT_EQ(view.zone().words(), "1 to velocity (rad/s)");
    dragTag(1, middle(1));
    EXPECT_EQ(view.lines().panels(), 1);
    dragTag(1, above(0));
    EXPECT_EQ(panels(), (QStringList{"position (rad)", "velocity (rad/s)"}));
}

TEST_F(Arranged, AClickOnATagMovesNothing) {
    drop({velocity}, below(0));
    auto& strip = *view.findChildren<TagStrip*>()[0];
    QTest::mouseClick(&strip, Qt::LeftButton, {}, strip.boxOf(1).center());
    EXPECT_EQ(panels(), (QStringList{"position (rad)", "velocity (rad/s)"}));
    EXPECT_EQ(view.history().change(), "add /demands/1.velocity");
}

TEST_F(Arranged, CtrlZBringsBackLinesAndPanelsStepByStep) {
    drop({velocity}, below(0));
    drop({demand}, middle(0));
    run(100, rising);
    show();
    dragTag(3, above(0));
    EXPECT_EQ(line(3).line.panel, 0);
    EXPECT_EQ(panels(), (QStringList{"position (rad)", "position (rad)", "velocity (rad/s)"}));
    undo();
    EXPECT_EQ(panels(), (QStringList{"position (rad)", "velocity (rad/s)"}));
    EXPECT_EQ(view.lines().all().size(), 3U);
    undo();
    undo();
    EXPECT_EQ(view.lines().all().size(), 1U);
    EXPECT_EQ(panels(), QStringList{"position (rad)"});
}

TEST_F(Arranged, ALineThatWasRemovedComesBackWithItsSamples) {
    const std::int64_t before = line(1).ring->begin();
    QTest::keyClick(&view, Qt::Key_Delete);
    EXPECT_TRUE(view.lines().all().empty());
    run(500, atRest);
    show();
    undo();
    ASSERT_TRUE(line(1).any());
    EXPECT_EQ(line(1).ring->begin(), before);
    EXPECT_EQ(line(1).ring->value(line(1).ring->end() - 100), 0.5) << "also of while it was away";
}

TEST_F(Arranged, FiftyStepsAreKept) {
    for (int i = 0; i < 60; ++i) {
        view.add({velocity});
        view.removeLine(2);
    }
    int steps = 0;
    for (; !view.history().empty(); ++steps) undo();
    EXPECT_EQ(steps, 50);
}

TEST_F(Arranged, UndoingKeepsTheUnitsThatAreShownNow) {
    view.add({velocity});
    ShownUnits degrees;
    degrees.choose(0, "deg");
    view.setUnits(degrees);
    undo();
    EXPECT_EQ(panels(), QStringList{"position (°)"});
}

}  // namespace
}  // namespace cortex::test
