// SPDX-License-Identifier: Apache-2.0
// Texts of a plot: none hides a line, none is cut so that it reads as another one.
#include "model/value_text.hpp"
#include "plot_fixture.hpp"
#include "plots/overview_strip.hpp"
#include "plots/plot_legend.hpp"
#include "plots/plot_panel.hpp"
#include "plots/plot_report.hpp"
#include "plots/time_axis.hpp"
#include "style/look.hpp"
#include "widgets/rows.hpp"
#include "widgets/text_label.hpp"

#include <QAction>
#include <QFileDialog>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <array>

namespace cortex::test {
namespace {

constexpr std::array families{"Open Sans", "DejaVu Sans"};

void useFont(const char* family) { Look::apply(Theme::Light, 1, QLatin1String{family}); }

double secondsOf(std::int64_t cycle) {
    return (static_cast<double>(MadeAgent::start) + static_cast<double>(cycle) * 1e6) * 1e-9;
}

int inkOf(const QImage& image, const QRect& box) {
    const QRgb ground = image.pixel(box.topLeft());
    int count = 0;
    for (int y = box.top(); y <= box.bottom(); ++y) {
        for (int x = box.left(); x <= box.right(); ++x) count += image.pixel(x, y) != ground;
    }
    return count;
}

class PlotTexts : public Plotted {
protected:
    ~PlotTexts() override { useFont("Open Sans"); }
    CursorOverlay& overlay() { return *view.findChild<CursorOverlay*>(); }
    void key(Qt::Key key) { QTest::keyClick(&view, key); }
    // What is seen of the row of a cursor, from one pixel of the plot to another.
    QImage rowOf(char cursor, int from, int to) {
        view.redraw();
        QApplication::processEvents();
        view.redraw();
        const int height = CursorOverlay::bandHeight() / 2;
        const QPoint corner = overlay().mapTo(&view, QPoint{0, cursor == 'A' ? 0 : height});
        return picture().copy(corner.x() + left() + from, corner.y(), to - from, height);
    }
    int left() {
        const PlotPanel& panel = *view.panels().front();
        return panel.mapTo(overlay().parentWidget(), panel.canvasBox().topLeft()).x();
    }
    double secondsAt(int pixel) {
        const TimeSpan span = view.range().shown();
        return span.from + pixel * span.length() / view.panels().front()->canvasBox().width();
    }
    bool anyLabelSays(const QString& text) {
        return std::ranges::any_of(view.findChildren<TextLabel*>(), [&](const TextLabel* each) {
            return each->isVisible() && each->text().contains(text);
        });
    }
};

// Twenty seconds of one line in a panel of its own.
class LineInAPanel : public testing::Test {
protected:
    static constexpr std::int64_t count = 20'000;

    LineInAPanel() {
        panel.resize(700, 220);
        line.item.item = "position";
        line.data.unit = "m";
    }
    void fill(const std::function<double(std::int64_t)>& value) {
        for (std::int64_t i = 0; i < count; ++i) {
            ring.put(i, value(i), 0);
            time.table.add(i, MadeAgent::start + i * MadeAgent::period, MadeAgent::period);
        }
        time.end = count;
    }
    // The columns, counted from the canvas' left edge, in which nothing of the line is seen.
    std::vector<int> columnsWithoutLine() {
        panel.show({DrawnLine{line, &ring, &time, 0}}, {secondsOf(0), secondsOf(count - 1)}, false);
        const QImage image = panel.grab().toImage();
        const QRect canvas = panel.canvasBox();
        const QRgb colour = line.pen(1).color().rgb();
        std::vector<int> found;
        for (int x = canvas.left() + 2; x < canvas.right() - 2; ++x) {
            bool any = false;
            for (int y = canvas.top(); y <= canvas.bottom(); ++y)
                any = any || image.pixel(x, y) == colour;
            if (!any) found.push_back(x - canvas.left());
        }
        return found;
    }

    Ring ring;
    AgentTime time;
    PlotLine line;
    PlotPanel panel;
};

TEST_F(LineInAPanel, IsSeenBelowTheTitle) {
    fill([](std::int64_t i) { return i == 0 ? 0.0 : 1.0; });
    EXPECT_TRUE(columnsWithoutLine().empty()) << columnsWithoutLine().size();
}

TEST_F(LineInAPanel, IsSeenBesideAGapThatIsNarrowerThanItsLength) {
    fill([](std::int64_t i) {
        return i == 0 ? 0 : i == 1 ? 1 : i > 9'000 && i < 9'500 ? missingValue : 0.83;
    });
    const auto columns = columnsWithoutLine();
    EXPECT_FALSE(columns.empty());
    EXPECT_LT(columns.size(), 25U) << "the gap is some 17 columns wide";
}

TEST_F(LineInAPanel, IsSeenUpToItsEndBesideALimit) {
    line.data.max = 3.0;
    fill([](std::int64_t) { return 2.99; });
    EXPECT_TRUE(columnsWithoutLine().empty()) << columnsWithoutLine().size();
}

TEST_F(PlotTexts, NumbersOfTheLegendAreNeverCutAndKeepTheirExponent) {
    for (const char* family : families) {
        useFont(family);
        view.add({position});
        show();
        run(100, [](double) { return 1.23456789e-7; });
        run(100, [](double) { return -4.62145e-301; });
        run(200, [](double) { return -1'234'567.0; });
        view.legend().showStatistics(true);
        show();
        key(Qt::Key_C);
        view.cursors().a = secondsOf(agent.cycle() - 350);
        view.cursors().b = secondsOf(agent.cycle() - 250);
        for (const bool cursors : {true, false}) {
            if (view.cursors().shown != cursors) key(Qt::Key_C);
            view.redraw();
            const QString row = view.legend().texts().front();
            const int room = (view.legend().width() - Look::units(4)) / 3 - Look::units(1);
            QString values = row.mid(row.indexOf(cursors ? " A " : " at end "));
            for (const char* head : {" B − A ", " A ", " B ", " at end ", " min ", " max "})
                values.replace(QString::fromUtf8(head), QStringLiteral("|"));
            const QStringList numbers = values.split('|', Qt::SkipEmptyParts);
            ASSERT_EQ(numbers.size(), 3) << row.toStdString();
            for (const QString& each : numbers)
                EXPECT_LE(textWidth(each), room) << family << row.toStdString();
            if (!cursors) continue;
            EXPECT_TRUE(numbers[0].startsWith("1.2") && numbers[0].endsWith("×10⁻⁷"));
            EXPECT_TRUE((numbers[1].startsWith("−4.6") || numbers[1].startsWith("−5")) &&
                        numbers[1].endsWith("×10⁻³⁰¹"));
        }
        const int names = textWidth(QStringLiteral("samples")) + Look::units(2);
        for (const QString& each : view.legend().texts().mid(2)) {
            const QString value = each.mid(each.indexOf(' ') + 1);
            EXPECT_LE(textWidth(value), view.legend().width() - Look::units(4) - names)
                << family << ' ' << each.toStdString();
        }
        view.removeLine(1);
        view.legend().showStatistics(false);
        key(Qt::Key_F);
    }
}

TEST(FittingNumbers, HaveFewerDigitsButNeverAnotherSize) {
    const auto within = [](int length) {
        return [length](const QString& text) { return text.size() <= length; };
    };
    EXPECT_EQ(fittingNumber({}, 1.23456789e-7, within(20)), "1.23457×10⁻⁷");
    EXPECT_EQ(fittingNumber({}, 1.23456789e-7, within(9)), "1.23×10⁻⁷");
    EXPECT_EQ(fittingNumber({}, -4.62145e-301, within(11)), "−4.6×10⁻³⁰¹");
    EXPECT_EQ(fittingNumber({}, -4.62145e-301, within(1)), "−5×10⁻³⁰¹");
    EXPECT_EQ(fittingNumber({}, 1'234'567, within(7)), "1234567");
    EXPECT_EQ(fittingNumber({}, 1'234'567, within(6)), "1×10⁶");
    EXPECT_EQ(fittingNumber({}, 0.000'123'456, within(8)), "0.000123");
    EXPECT_EQ(fittingNumber({}, 20'000'000, within(5)), "2×10⁷");
    DataItem precise;
    precise.format = "%.12f";
    EXPECT_EQ(fittingNumber(precise, 3.000'000'000'001, within(8)), "3");
    EXPECT_EQ(fittingNumber(precise, 0, within(8)), "0");
}

TEST_F(PlotTexts, TheMomentsOfTwoCursorsNeverCoverEachOther) {
    view.add({position});
    show();
    run(2'000, [](double) { return 0.5; });
    show();
    key(Qt::Key_C);
    view.cursors().a = secondsAt(200);
    view.cursors().b = secondsAt(700);
    const QImage a = rowOf('A', 190, 320);
    EXPECT_GT(inkOf(a, a.rect()), 100);
    for (const int near : {201, 210, 250}) {
        view.cursors().b = secondsAt(near);
        EXPECT_EQ(rowOf('A', 190, 320), a) << near;
    }
    view.cursors().b = secondsAt(200);
    view.cursors().a = secondsAt(700);
    const QImage b = rowOf('B', 190, 280);
    EXPECT_GT(inkOf(b, b.rect()), 100);
    view.cursors().a = secondsAt(230);
    EXPECT_EQ(rowOf('B', 190, 280), b);
}

TEST_F(PlotTexts, ACursorThatIsOutOfViewSaysSo) {
    view.add({position});
    show();
    run(2'000, [](double) { return 0.5; });
    show();
    key(Qt::Key_C);
    view.toggleStatistics();
    const TimeSpan span = view.range().shown();
    view.cursors().a = span.to - 1;
    view.cursors().b = span.to - 0.5;
    view.redraw();
    EXPECT_TRUE(view.legend().texts().front().contains(" A 0.5 B 0.5"));
    view.cursors().a = span.from - 1;
    view.cursors().b = span.to + 1;
    view.redraw();
    EXPECT_TRUE(overlay().texts()[0].startsWith("A ← 22:1")) << overlay().texts()[0].toStdString();
    EXPECT_TRUE(overlay().texts()[0].endsWith(", out of view"));
    EXPECT_TRUE(overlay().texts()[1].endsWith(", out of view →"));
    EXPECT_TRUE(view.legend().texts().front().contains("← A "));
    EXPECT_TRUE(view.legend().texts().front().contains("B → "));
    EXPECT_TRUE(view.legend().texts()[1].startsWith("1, ← A to B →: "))
        << view.legend().texts().join('\n').toStdString();
    const QImage row = rowOf('A', 0, 200);
    EXPECT_GT(inkOf(row, row.rect()), 100) << "its time is at the edge";
    view.resize(330, 500);
    EXPECT_FALSE(rowOf('A', 0, 20).isNull());
    EXPECT_TRUE(overlay().texts()[0].contains("22:1"));
}

TEST_F(PlotTexts, TheLengthOfTheOverviewIsWhole) {
    for (const char* family : families) {
        useFont(family);
        const auto beside = [](int left) {
            OverviewStrip strip;
            strip.resize(500, Look::units(11));
            strip.setEdges(left, 480);
            strip.show({}, {0, 634}, {600, 620});
            return strip.grab().toImage().copy(0, 0, left - Look::units(2), Look::units(11));
        };
        const QImage narrow = beside(Look::units(17)), wide = beside(300);
        EXPECT_EQ(inkOf(narrow, {0, 0, 1, narrow.height()}), 0) << family;
        const double ink = inkOf(wide, wide.rect());
        EXPECT_GT(ink, 50);
        EXPECT_NEAR(inkOf(narrow, narrow.rect()), ink, 0.1 * ink) << family;
    }
}

TEST_F(PlotTexts, APictureHasTheWholeLegendNoBarAndNoNoteOfTheOneBefore) {
    std::vector<RecordedItem> items{position, demand, velocity};
    for (std::size_t i = 0; i < 12; ++i)
        items.push_back({{}, "/nobody/" + std::to_string(i), "x", 0});
    view.resize(1000, 360);
    view.add(items);
    show();
    run(1'000, [](double seconds) { return seconds; });
    view.toggleStatistics();
    show();
    ASSERT_GT(view.legend().sizeHint().height(), view.height());
    const QTemporaryDir folder;
    view.exportTo(folder.filePath("a.png"));
    const QImage image{folder.filePath("a.png")};
    const QSize legend = 2 * view.legend().size();
    EXPECT_GE(legend.height(), 2 * view.legend().sizeHint().height());
    EXPECT_GT(image.height(), legend.height());
    const int edge = 2 * Look::units(3);
    const QRect box{image.width() - edge - legend.width(), image.height() - edge - legend.height(),
                    legend.width(), legend.height()};
    const int line = 2 * Look::units(4.5);
    const QRect last{box.left(), box.bottom() - 3 * line, box.width(), 3 * line};
    EXPECT_GT(inkOf(image, last), 100) << "the last of the statistics";
    EXPECT_EQ(inkOf(image, {box.right() - 4, box.top(), edge, box.height()}), 0) << "no bar";
    EXPECT_EQ(inkOf(image, {0, box.top(), edge, box.height()}), 0) << "nothing at the left edge";
}

TEST_F(PlotTexts, AnExportDoesNotTellOfTheOneBefore) {
    view.add({position});
    show();
    run(100, [](double seconds) { return seconds; });
    show();
    const QTemporaryDir folder;
    for (QAction* each : view.findChildren<QAction*>()) {
        if (each->text() == "PNG") each->trigger();
    }
    auto* dialog = view.findChild<QFileDialog*>();
    ASSERT_NE(dialog, nullptr);
    Q_EMIT dialog->fileSelected(folder.filePath("a.png"));
    EXPECT_TRUE(anyLabelSays("written to "));
    view.exportTo(folder.filePath("b.png"));
    EXPECT_FALSE(anyLabelSays("written to ")) << "while the picture is made";
    Q_EMIT dialog->fileSelected(folder.filePath("no/c.png"));
    EXPECT_TRUE(view.notice().endsWith("no/c.png was not written: No such file or directory."));
    Q_EMIT dialog->fileSelected(folder.filePath("c.png"));
    EXPECT_TRUE(view.notice().isEmpty()) << view.notice().toStdString();
    EXPECT_TRUE(anyLabelSays("written to "));
    dialog->close();
}

TEST_F(PlotTexts, TheTitleOfAPictureNamesAllLinesInAsManyRowsAsTheyNeed) {
    QWidget panels;
    panels.resize(500, 100);
    QStringList names;
    for (int i = 1; i <= 9; ++i)
        names << QStringLiteral("%1 /factory/cell/robot/axes/%1.position").arg(i);
    const PlotReport report{panels, nullptr, QStringLiteral("today"), names};
    const QStringList rows = report.title();
    EXPECT_GT(rows.size(), 3);
    for (const QString& each : names) EXPECT_TRUE(rows.join("").contains(each));
    for (const QString& each : rows) EXPECT_LE(textWidth(each, true), 501);
    EXPECT_GT(report.size().height(), 100 + static_cast<int>(rows.size()) * 10);
}

TEST_F(PlotTexts, ThereAreNoTimesBeforeAnythingCame) {
    view.add({{{}, "/nobody", "here", 0}});
    show();
    QApplication::processEvents();
    auto& axis = *view.findChild<TimeAxis*>();
    const QImage image = axis.grab().toImage();
    EXPECT_GT(image.width(), 100);
    EXPECT_EQ(inkOf(image, image.rect()), 0);
    key(Qt::Key_Left);
    key(Qt::Key_C);
    EXPECT_FALSE(anyLabelSays("Held at"));
    EXPECT_FALSE(view.cursors().shown);
    view.add({position});
    show();
    run(100, [](double seconds) { return seconds; });
    show();
    EXPECT_GT(view.range().shown().to, secondsOf(0)) << "it holds what came first";
}

}  // namespace
}  // namespace cortex::test
