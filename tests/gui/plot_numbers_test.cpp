// SPDX-License-Identifier: Apache-2.0
// The numbers and words of a plot agree with each other and with the samples.
#include "plot_fixture.hpp"
#include "plots/lane_strip.hpp"
#include "plots/lanes.hpp"
#include "plots/plot_legend.hpp"
#include "plots/plot_panel.hpp"
#include "plots/statistics.hpp"
#include "style/look.hpp"
#include "widgets/text_label.hpp"

#include <algorithm>
#include <optional>

namespace cortex::test {
namespace {

class PlotNumbers : public Plotted {
protected:
    static double at(double cycle) {
        return static_cast<double>(MadeAgent::start) * 1e-9 + cycle * 1e-3;
    }
    // The line below the overview.
    QString foot() {
        for (const TextLabel* each : view.findChildren<TextLabel*>()) {
            if (each->text().contains("samples a line")) return each->text();
        }
        return {};
    }
    QString panelText() { return view.panels().front()->accessibleName(); }
    bool legendSays(const QString& text) {
        const QStringList all = view.legend().texts();
        return std::ranges::any_of(all, [&](const QString& each) { return each.contains(text); });
    }
    QString legendText() { return view.legend().texts().join('\n'); }
    void bad(int cycles) {
        agent.degrade("/axes/1", Quality::Bad);
        run(cycles, [](double) { return 1; });
        agent.degrade("/axes/1", Quality::Good);
    }
    void good(int cycles) {
        run(cycles, [](double) { return 1; });
    }
};

// At 20 Hz, where a sample too many is seen: 1 from sample 10 to 76, otherwise 0.
TEST(PlotStatistics, AreOfTheSamplesFromAToBBothIncluded) {
    constexpr std::int64_t period = 50'000'000;
    Ring ring;
    AgentTime time;
    for (std::int64_t i = 0; i < 200; ++i) {
        ring.put(i, i >= 10 && i <= 76 ? 1 : 0, 0);
        time.table.add(i, MadeAgent::start + i * period, period);
    }
    const DrawnLine line{PlotLine{}, &ring, &time, 0};
    const auto moment = [&](double sample) {
        return static_cast<double>(MadeAgent::start) * 1e-9 + sample * 0.05;
    };
    struct Cursor {
        double a, b;
    };
    for (const auto& [a, b] : {Cursor{10, 76}, Cursor{9.1, 76.9}, Cursor{9.5, 76.5},
                               Cursor{9.9, 76.1}, Cursor{10, 76.5}, Cursor{9.5, 76}}) {
        const Statistics found = statisticsOf(line, {moment(a), moment(b)});
        EXPECT_EQ(found.count, 67) << a << " to " << b;
        EXPECT_EQ(found.missing, 0) << a << " to " << b;
        EXPECT_EQ(found.min, 1) << a << " to " << b;
        EXPECT_EQ(found.mean, 1) << a << " to " << b;
        EXPECT_EQ(found.max, 1) << a << " to " << b;
        EXPECT_NEAR(found.length, 66 * 0.05, 1e-6) << a << " to " << b;
    }
    EXPECT_EQ(statisticsOf(line, {moment(20.2), moment(20.8)}).count, 0);
    EXPECT_EQ(statisticsOf(line, {moment(20), moment(20)}).count, 1);
}

TEST_F(PlotNumbers, OfTheLegendAreThoseOfTheStatistics) {
    view.add({position});
    show();
    run(9'000, [](double seconds) { return std::round(seconds * 1e3); });
    show();
    view.range().show({at(1'106.5), at(7'657.5)});
    view.toggleStatistics();
    const QString all = legendText();
    EXPECT_TRUE(legendSays("min 1107 max 7657")) << all.toStdString();
    EXPECT_TRUE(legendSays("min 1107 rad")) << all.toStdString();
    EXPECT_TRUE(legendSays("max 7657 rad")) << all.toStdString();
    EXPECT_TRUE(legendSays("samples 6551")) << all.toStdString();
}

TEST_F(PlotNumbers, TheLineBelowTheOverviewCountsTheValuesOfEachLine) {
    view.add({position});
    show();
    run(100, [](double) { return 1; });
    agent.skip(50);
    bad(10);
    run(100, [](double) { return 1; });
    show();
    EXPECT_TRUE(foot().startsWith("200 samples a line in ")) << foot().toStdString();
    view.add({velocity});
    show();
    run(98, [](double) { return 1; });
    view.range().hold();
    show();
    EXPECT_TRUE(foot().startsWith("98 to 298 samples a line in ")) << foot().toStdString();
    const Statistics found = statisticsOf(line(1), {at(0), at(1'000)});
    EXPECT_EQ(found.count, 298);
    EXPECT_EQ(found.missing, 60 + 2) << "two frames are cycles of the agent, too";
}

TEST_F(PlotNumbers, StatisticsOfMoreThanThereIsSayHowLongItIs) {
    view.add({position});
    show();
    good(5'000);
    view.range().setSpan(60);
    show();
    view.toggleStatistics();
    EXPECT_TRUE(legendSays("1, visible: 60.00 s")) << legendText().toStdString();
    EXPECT_TRUE(legendSays("duration 5.00 s")) << legendText().toStdString();
}

TEST_F(PlotNumbers, AGapInWhichCyclesCameSaysThatTheyWereNotGood) {
    view.add({position});
    show();
    good(1'000);
    bad(110);
    good(1'000);
    show();
    EXPECT_TRUE(panelText().contains("not good 0.11 s")) << panelText().toStdString();
    good(1'000);
    run(220, [](double) { return std::nan(""); });
    good(1'000);
    agent.skip(330);
    good(1'000);
    bad(100);
    agent.skip(340);
    good(1'000);
    show();
    EXPECT_TRUE(panelText().contains("not good 0.22 s")) << panelText().toStdString();
    EXPECT_TRUE(panelText().contains("no data 0.33 s")) << panelText().toStdString();
    EXPECT_TRUE(panelText().contains("no data 0.44 s, in part not good"))
        << panelText().toStdString();
}

TEST_F(PlotNumbers, TheShadeOfALaneBelongsToItsValueAlsoWhereNoWordFits) {
    view.add({position, {{}, "/probe", "on", 0}});
    const std::uint32_t probe = agent.at("/probe");
    const ItemLayout* layout = agent.structure->simplexes[probe].layout->find("on");
    auto* on = static_cast<bool*>(agent.tables->live(probe).at(Kind::Bool, layout->offset));
    const auto toggle = [&](int seconds) {
        for (int i = 0; i < seconds * 1'000; ++i) {
            *on = agent.cycle() / 1'000 % 2 == 1;
            good(1);
        }
    };
    show();
    view.range().setSpan(60);
    const auto* lanes = view.findChild<LaneStrip*>();
    // The middle of each of the first twenty seconds, at the upper edge of the lane.
    const auto shades = [&] {
        show();
        const QImage image = view.grab().toImage();
        const QRect canvas = view.panels().front()->canvasBox();
        const int left = view.panels().front()->mapTo(&view, canvas.topLeft()).x();
        const int y = lanes->mapTo(&view, QPoint{0, 2}).y();
        const TimeSpan span = view.range().shown();
        QList<QRgb> found;
        for (int i = 0; i < 20; ++i) {
            const double share = (at(i * 1'000 + 500) - span.from) / span.length();
            found << image.pixel(left + static_cast<int>(share * canvas.width()), y);
        }
        return found;
    };
    toggle(21);
    const auto before = shades();
    for (int i = 2; i < 20; ++i) EXPECT_EQ(before[i], before[i % 2]) << i;
    EXPECT_GT(qGray(before[0]), qGray(before[1]) + 20) << "false is light, true is dark";
    for (int i = 0; i < 3; ++i) {
        toggle(1);
        EXPECT_EQ(shades(), before) << "while it follows";
    }
}

TEST(Lanes, LabelsHaveShadesInTheirOrderAndTextsByTheirNumber) {
    PlotLine line;
    line.data.kind = Kind::Int;
    line.data.labels = {{-3, "Low"}, {0, "Off"}, {7, "On"}};
    EXPECT_EQ(shadeOf(line, -3), 0);
    EXPECT_EQ(shadeOf(line, 0), 0.5);
    EXPECT_EQ(shadeOf(line, 7), 1);
    PlotLine text;
    text.data.kind = Kind::String;
    EXPECT_EQ(shadeOf(text, 6), shadeOf(text, 1));
    EXPECT_NE(shadeOf(text, 1), shadeOf(text, 2));
}

}  // namespace
}  // namespace cortex::test
