// SPDX-License-Identifier: Apache-2.0
// Plots of an agent that is made by hand: what is seen, and what the user does.
#include "plot_fixture.hpp"
#include "plots/lane_strip.hpp"
#include "plots/plot_csv.hpp"
#include "plots/plot_legend.hpp"
#include "plots/plot_panel.hpp"
#include "plots/statistics.hpp"
#include "plots/time_ticks.hpp"
#include "style/look.hpp"

#include <QFile>
#include <QMouseEvent>
#include <QTemporaryDir>
#include <QTest>
#include <QWheelEvent>
#include <algorithm>
#include <sstream>

namespace cortex::test {
namespace {

constexpr auto wave = [](double seconds) { return std::sin(seconds * 3); };
constexpr auto still = [](double) { return 0.5; };

class Plot : public Plotted {
protected:
    // The rows of the canvas, of the picture, that have this colour at a moment.
    int rowsOf(const QImage& image, const QColor& colour, double seconds) {
        const QRect canvas = view.panels().front()->canvasBox();
        const QPoint corner = view.panels().front()->mapTo(&view, canvas.topLeft());
        const TimeSpan span = view.range().shown();
        const int x =
            corner.x() + static_cast<int>((seconds - span.from) / span.length() * canvas.width());
        int rows = 0;
        for (int y = corner.y(); y < corner.y() + canvas.height(); ++y) {
            rows += image.pixelColor(std::clamp(x, 0, image.width() - 1), y).rgb() == colour.rgb();
        }
        return rows;
    }
    QColor lineColour() { return line(1).line.pen(1).color(); }
    double at(std::int64_t cycle) {
        return (static_cast<double>(MadeAgent::start) + static_cast<double>(cycle) * 1e6) * 1e-9;
    }
    // A notch of the wheel over the middle of the first panel.
    void wheel() {
        QWidget& canvas = *view.panels().front()->canvas();
        const QPointF middle = canvas.rect().center();
        QWheelEvent event{middle,
                          canvas.mapToGlobal(middle.toPoint()),
                          {},
                          {0, 120},
                          Qt::NoButton,
                          Qt::NoModifier,
                          Qt::NoScrollPhase,
                          false};
        QApplication::sendEvent(&canvas, &event);
    }
    void key(Qt::Key key) { QTest::keyClick(&view, key); }
};

TEST_F(Plot, HatchesAGapSaysItsLengthAndDrawsNoLineAcrossIt) {
    view.add({position});
    show();
    run(8'000, still);
    agent.skip(3'000);
    run(8'000, still);
    show();
    const QImage image = picture();
    EXPECT_GT(rowsOf(image, Look::colours().dataBg, at(9'500)), 20);
    EXPECT_EQ(rowsOf(image, lineColour(), at(9'500)), 0);
    EXPECT_EQ(rowsOf(image, Look::colours().dataBg, at(6'000)), 0);
    EXPECT_GT(rowsOf(image, lineColour(), at(6'000)), 0);
    ASSERT_EQ(view.panels().front()->gaps().size(), 1U);
    const Gap gap = view.panels().front()->gaps().front();
    EXPECT_NEAR(gap.from, at(8'001), 2e-3);
    EXPECT_NEAR(gap.to - gap.from, 3.0, 5e-3);
    EXPECT_TRUE(view.panels().front()->accessibleName().contains("no data 3.00 s"))
        << view.panels().front()->accessibleName().toStdString();
}

TEST_F(Plot, AStandstillOfItsAgentIsHatchedAlthoughNoCycleIsLost) {
    view.add({position, mode});
    show();
    run(8'000, still);
    agent.wait(3'000);
    run(8'000, still);
    show();
    const QImage image = picture();
    EXPECT_GT(rowsOf(image, Look::colours().dataBg, at(9'500)), 20);
    EXPECT_EQ(rowsOf(image, lineColour(), at(9'500)), 0);
    EXPECT_TRUE(view.panels().front()->accessibleName().contains("no data 3.00 s"))
        << view.panels().front()->accessibleName().toStdString();
    EXPECT_TRUE(std::isnan(line(1).valueAt(at(9'500)))) << "a cursor tells no value there";
    const auto words = view.findChild<LaneStrip*>()->words(0);
    EXPECT_TRUE(std::ranges::any_of(words, [&](const LaneWord& each) {
        return each.missing && std::abs(each.to - each.from - 3) < 0.1;
    })) << "nor does a lane";
}

TEST_F(Plot, ASpikeOfOneSampleIsSeenAmongTenMinutes) {
    Ring ring;
    AgentTime time;
    for (std::int64_t i = 0; i < 600'000; ++i) {
        ring.put(i, i == 250'123 ? 1 : 0, 0);
        time.table.add(i, MadeAgent::start + i * MadeAgent::period, MadeAgent::period);
    }
    PlotPanel panel;
    panel.resize(600, 300);
    DrawnLine drawn{PlotLine{}, &ring, &time, 0};
    panel.show({drawn}, {at(0), at(600'000)}, false);
    const QImage image = panel.grab().toImage();
    const QRect canvas = panel.canvasBox();
    const int x = canvas.left() + 250'123 * canvas.width() / 600'000;
    int most = 0;
    for (int column = x - 2; column <= x + 2; ++column) {
        int rows = 0;
        for (int y = canvas.top(); y < canvas.bottom(); ++y) {
            rows += image.pixelColor(column, y).rgb() == drawn.line.pen(1).color().rgb();
        }
        most = std::max(most, rows);
    }
    EXPECT_GT(most, canvas.height() / 2);
}

TEST_F(Plot, TheWheelHoldsAndFFollowsAgain) {
    view.add({position});
    show();
    run(30'000, wave);
    show();
    EXPECT_TRUE(view.range().follows());
    const TimeSpan before = view.range().shown();
    wheel();
    EXPECT_FALSE(view.range().follows());
    const TimeSpan held = view.range().shown();
    EXPECT_LT(held.length(), before.length());
    EXPECT_NEAR((held.from + held.to) / 2, (before.from + before.to) / 2, 0.1);
    run(2'000, wave);
    show();
    EXPECT_EQ(view.range().shown(), held) << "while data keep coming";
    EXPECT_GT(view.range().behind(), 2);
    key(Qt::Key_F);
    EXPECT_TRUE(view.range().follows());
    EXPECT_EQ(view.range().behind(), 0);
}

TEST_F(Plot, ArrowsPanAndZoomAndSpaceHolds) {
    view.add({position});
    show();
    run(30'000, wave);
    show();
    key(Qt::Key_Space);
    EXPECT_FALSE(view.range().follows());
    const TimeSpan held = view.range().shown();
    key(Qt::Key_Left);
    EXPECT_NEAR(held.to - view.range().shown().to, held.length() / 10, 1e-6);
    key(Qt::Key_Down);
    EXPECT_GT(view.range().span(), held.length());
    key(Qt::Key_Space);
    EXPECT_TRUE(view.range().follows());
}

TEST_F(Plot, CursorsSayWhatIsThereAndTheirDifference) {
    view.add({position});
    show();
    run(20'000, [](double seconds) { return seconds * 0.1; });
    show();
    key(Qt::Key_C);
    ASSERT_TRUE(view.cursors().shown);
    view.cursors().a = at(10'000);
    view.cursors().b = at(14'000);
    view.redraw();
    const QString row = view.legend().texts().front();
    EXPECT_TRUE(row.contains("A 1 B 1.4 B − A 0.4")) << row.toStdString();
    view.toggleStatistics();
    const QStringList texts = view.legend().texts();
    EXPECT_TRUE(texts.contains("samples 4001")) << texts.join('\n').toStdString();
    EXPECT_TRUE(texts.contains("1, A to B: 4.00 s")) << texts.join('\n').toStdString();
    EXPECT_TRUE(texts.contains("slope 0.1 rad per s")) << texts.join('\n').toStdString();
    key(Qt::Key_B);
    key(Qt::Key_Right);
    EXPECT_GT(view.cursors().b, at(14'000));
}

TEST_F(Plot, StatisticsAreOfEverySampleAndCountWhatIsMissing) {
    view.add({position});
    show();
    run(1'000, [](double seconds) { return seconds < 0.5005 ? 1.0 : 3.0; });
    agent.skip(100);
    run(1'000, still);
    show();
    const Statistics found = statisticsOf(line(1), {at(2), at(1'201)});
    EXPECT_EQ(found.count + found.missing, 1'200);
    EXPECT_GE(found.missing, 100);
    EXPECT_EQ(found.min, 0.5);
    EXPECT_EQ(found.max, 3);
    const Statistics steps = statisticsOf(line(1), {at(2), at(1'000)});
    EXPECT_NEAR(steps.mean, 2, 0.01);
    EXPECT_NEAR(steps.deviation, 1, 0.01);
}

// As a busy agent, which runs every second period only, and then every one.
TEST_F(Plot, TheSlopeIsByTheTimesOfTheSamples) {
    view.add({position});
    show();
    for (std::int64_t i = 0; i < 300; ++i) {
        agent.wait(i < 200 ? 1 : 0);
        agent.put("/axes/1", "position", 2 * agent.seconds() + 1);
        recorder.hear("far", *agent.now().image);
    }
    show();
    const Statistics found = statisticsOf(line(1), {at(2), at(499)});
    EXPECT_NEAR(found.slope, 2, 0.01);
}

TEST_F(Plot, TheLegendTellsTheValueBelowThePointerAndAtTheEndOfWhatIsHeld) {
    view.add({position});
    show();
    run(20'000, [](double seconds) { return seconds; });
    show();
    QWidget& canvas = *view.panels().front()->canvas();
    EXPECT_TRUE(view.legend().texts().front().contains("newest 20"));
    QMouseEvent over{QEvent::MouseMove,
                     {canvas.width() / 2.0 + 8, 40.0},
                     Qt::NoButton,
                     Qt::NoButton,
                     Qt::NoModifier};
    QApplication::sendEvent(&canvas, &over);
    show();
    EXPECT_TRUE(view.legend().texts().front().contains("pointer 10"))
        << view.legend().texts().front().toStdString();
    QEvent leave{QEvent::Leave};
    QApplication::sendEvent(&canvas, &leave);
    key(Qt::Key_Space);
    run(5'000, still);
    show();
    EXPECT_TRUE(view.legend().texts().front().contains("at end 20"))
        << view.legend().texts().front().toStdString();
}

TEST_F(Plot, LabelsTruthsAndTextsAreLanesOfWords) {
    view.add({mode, {{}, "/probe", "on", 0}, {{}, "/probe", "names", 1}});
    show();
    agent.put("/probe", "names", std::string{"first"});
    for (int i = 0; i < 2'000; ++i) {
        agent.put("/switch", "mode", std::int64_t{i < 1'000 ? 0 : 1});
        recorder.hear("far", *agent.now().image);
    }
    show();
    EXPECT_TRUE(view.panels().empty());
    const auto* lanes = view.findChild<LaneStrip*>();
    const auto modes = lanes->words(0);
    ASSERT_GE(modes.size(), 2U);
    EXPECT_EQ(modes.front().text, "Off");
    EXPECT_EQ(modes.back().text, "On");
    EXPECT_NEAR(modes.back().from, at(1'001), 0.05);
    EXPECT_EQ(lanes->words(1).front().text, "false");
    EXPECT_TRUE(lanes->accessibleDescription().contains("/switch.mode: On"));
}

TEST_F(Plot, LinesOfOneUnitShareAPanelAndADemandIsDashedInTheColourOfItsObservation) {
    view.add({position, demand, velocity});
    show();
    ASSERT_EQ(view.panels().size(), 2U);
    const auto& lines = view.lines().all();
    EXPECT_EQ(lines[0].panel, lines[1].panel);
    EXPECT_NE(lines[0].panel, lines[2].panel);
    run(100, wave);
    show();
    EXPECT_EQ(view.panels()[0]->canvasBox().left(), view.panels()[1]->canvasBox().left());
    EXPECT_EQ(view.panels()[0]->canvasBox().width(), view.panels()[1]->canvasBox().width());
}

TEST_F(Plot, NothingIsDrawnUpToNowOfALineThatIsSilent) {
    view.add({position});
    show();
    run(5'000, still);
    show();
    DrawnLine silent = line(1);
    silent.silentUntil = at(9'000);
    const auto gaps = gapsOf({silent}, {at(1'000), at(9'000)}, 0.01);
    ASSERT_EQ(gaps.size(), 1U);
    EXPECT_NEAR(gaps[0].from, at(agent.cycle() - 1), 0.01);
    EXPECT_EQ(gaps[0].to, at(9'000));
}

TEST_F(Plot, TheCsvHasEveryCycleThatCameWithItsQuality) {
    view.add({position, mode});
    show();
    run(3, [](double seconds) { return seconds / 3; });
    agent.degrade("/axes/1", Quality::Stale);
    run(1, still);
    agent.skip(2);
    run(1, still);
    recorder.take();
    std::ostringstream text;
    writeCsv(text, view.drawn(), recorder, {at(0), at(1'000)});
    std::istringstream rows{text.str()};
    std::string row;
    std::getline(rows, row);
    EXPECT_EQ(row, "time_utc,cycle,/axes/1.position[rad],quality,/switch.mode,quality");
    std::vector<std::string> found;
    while (std::getline(rows, row)) found.push_back(row);
    ASSERT_EQ(found.size(), 5U) << text.str();
    EXPECT_EQ(found[0], "2023-11-14T22:13:20.002000000Z,2,0.0006666666666666666,good,0,good");
    EXPECT_EQ(found[3], "2023-11-14T22:13:20.005000000Z,5,,stale,0,good");
    EXPECT_EQ(found[4], "2023-11-14T22:13:20.008000000Z,8,,stale,0,good");
}

TEST_F(Plot, TheCsvWritesAWholeNumberThatIsRoundedAsSuch) {
    view.add({mode});
    show();
    for (const std::int64_t value :
         {9'007'199'254'740'991, 9'007'199'254'740'993, std::int64_t{-7}}) {
        agent.put("/switch", "mode", value);
        run(1, still);
    }
    recorder.take();
    std::ostringstream text;
    writeCsv(text, view.drawn(), recorder, {at(0), at(1'000)});
    for (const char* row : {",9007199254740991,good", ",9.007199254740992e+15,good", ",-7,good"})
        EXPECT_NE(text.str().find(row), std::string::npos) << text.str();
}

TEST_F(Plot, IsExportedAsCsvPngAndSvg) {
    view.add({position});
    show();
    run(1'000, wave);
    show();
    const QTemporaryDir folder;
    for (const char* name : {"a.csv", "a.png", "a.svg"}) {
        const QString file = folder.filePath(QString::fromLatin1(name));
        EXPECT_EQ(view.exportTo(file), "");
        EXPECT_GT(QFile{file}.size(), 1'000) << name;
    }
    EXPECT_GE(QImage{folder.filePath("a.png")}.width(), 2 * (view.width() - 2 * Look::units(3)));
    QFile svg{folder.filePath("a.svg")};
    ASSERT_TRUE(svg.open(QIODevice::ReadOnly));
    EXPECT_TRUE(svg.readAll().contains("/axes/1.position"));
    EXPECT_EQ(view.exportTo(folder.filePath("no/a.csv")), "No such file or directory");
}

TEST_F(Plot, IsTheSameAgainFromWhatWasSaved) {
    view.add({position, demand, mode});
    show();
    view.range().setSpan(60);
    const QJsonObject saved = view.saved();
    PlotView other{recorder};
    other.restore(saved);
    other.refresh(frameOf({agent.now()}));
    EXPECT_EQ(other.saved(), saved);
    EXPECT_EQ(other.lines().all().size(), 3U);
}

TEST_F(Plot, WhatIsClosedIsNoLongerRecorded) {
    {
        PlotView other{recorder};
        other.add({position});
        other.refresh(frameOf({agent.now()}));
        EXPECT_EQ(recorder.viewed(), std::vector<std::string>{"/axes/1"});
    }
    EXPECT_TRUE(recorder.viewed().empty());
}

TEST_F(Plot, UnknownItemsWaitAndHostileNamesAreText) {
    view.add({{{}, "/nobody", "here", 0}, {{}, "/<b>bold</b>\u202e", "x", 4}});
    show();
    EXPECT_TRUE(view.panels().empty());
    EXPECT_TRUE(view.legend().texts()[0].contains("not heard of"));
    EXPECT_FALSE(view.legend().texts()[1].contains(QChar{0x202e}));
    EXPECT_FALSE(recordedItem("/a.b[-1]"));
    EXPECT_FALSE(recordedItem("/a.b[x]"));
    EXPECT_FALSE(recordedItem("a.b"));
    EXPECT_FALSE(recordedItem("/a"));
    EXPECT_FALSE(recordedItem("/a."));
    EXPECT_FALSE(recordedItem("]"));
    EXPECT_EQ(recordedItem("/a.b[3]")->element, 3U);
}

TEST(TimeTicks, AreOneTwoFiveOfNaturalUnits) {
    EXPECT_EQ(tickStep(20, 6), 5);
    EXPECT_EQ(tickStep(600, 6), 120);
    EXPECT_DOUBLE_EQ(tickStep(0.1, 6), 0.02);
    EXPECT_EQ(timeTicks({10.5, 20.1}, 5), (QList<double>{15, 20}));
    EXPECT_EQ(timeText(44'086, 1), "12:14:46");
    EXPECT_EQ(timeText(44'086.25, 0.05), "12:14:46.25");
}

}  // namespace
}  // namespace cortex::test
