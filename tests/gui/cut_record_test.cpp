// SPDX-License-Identifier: Apache-2.0
// What a plot keeps and draws of an agent at 1 kHz, beside what that agent itself wrote down, while
// the link between them is cut, and the agent is started again.
#include "cortex/comms/dds_interface.hpp"

#include "gui/window_fixture.hpp"
#include "network/host.hpp"
#include "plots/plot_panel.hpp"
#include "plots/plot_view.hpp"
#include "plots/time_ticks.hpp"
#include "style/look.hpp"
#include "support/probe.hpp"

#include <QFile>
#include <QTemporaryDir>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace std::chrono_literals;

comms::NetworkOptions onHost(const std::string& address) {
    comms::NetworkOptions options;
    options.domain = std::stoi(domain);
    options.interfaces = {address};
    return options;
}

// At 1 kHz, with a value that nobody can guess from its neighbours. It writes each cycle down.
struct WritingAgent : ProbeCluster {
    struct Cycle {
        double value = std::nan("");
        std::int64_t time = 0;  // ns, nominal: a busy machine skips some
    };

    WritingAgent() : ProbeCluster{{}, "quick"}, written(200'000) {
        trigger = nullptr;
        cluster->setTriggerSource<cs::InternalClock>(1ms);
        cluster->addInterface<comms::DdsInterface>(onHost("10.77.0.2"));
        Probe& ctl = probe("/ctl");
        ctl.onPopulate = [this](Probe& of) { result = of.data<double>("result"); };
        ctl.onLoopStart = [this](Probe& of, const Tick& tick) {
            of.setQuality(Quality::Good);
            const auto cycle = static_cast<std::size_t>(tick.cycle);
            result = static_cast<double>(cycle * 2'654'435'761U % 1'000'003);
            if (cycle < written.size()) written[cycle] = {result, tick.nominalTime};
        };
        start();
    }

    Data<double> result;
    std::vector<Cycle> written;
};

struct Row {
    std::int64_t utc = 0;  // ns
    std::size_t start = 0, cycle = 0;
    double value = 0;
};

// Cycles that have no row, between two that have one.
struct Missing {
    Row before, after;
    double from() const { return static_cast<double>(before.utc) * 1e-9; }
    double to() const { return static_cast<double>(after.utc) * 1e-9; }
};

class RecordedCut : public testing::Test {
protected:
    void SetUp() override {
        if (const std::string why = whyNoHosts(); !why.empty()) GTEST_SKIP() << why;
        hosts.emplace();
        startAgent();
        // Its thread stays on the host that it is started on.
        hosts->first.within([&] { session = std::make_unique<Session>(onHost("10.77.0.1")); });
        window = std::make_unique<MainWindow>(*session);
        window->resize(1400, 900);
        window->show();
        window->openPlot({{"quick", "/ctl", "result", 0}});
        ASSERT_TRUE(comesAnew());
    }
    void startAgent() {
        hosts->second.within([&] { agents.push_back(std::make_unique<WritingAgent>()); });
    }
    void endAgent() { agents.back()->cluster->stop(); }

    const Ring* ring() const { return session->recorder().ring({"quick", "/ctl", "result", 0}); }
    PlotView& plot() { return *qobject_cast<PlotView*>(window->current()); }
    bool comesAnew() {  // half a second of samples
        const std::int64_t before = ring() == nullptr ? 0 : ring()->end();
        return comes([&] {
            if (ring() == nullptr || ring()->end() < before + 500) return false;
            std::int64_t came = 0;
            for (std::int64_t i = ring()->end(); --i >= ring()->begin() && came < 500;) {
                if (ring()->quality(i) == Ring::notCome) return false;
                ++came;
            }
            return came == 500;
        });
    }
    void cutFor(std::chrono::milliseconds time) {
        hosts->cut();
        QElapsedTimer timer;
        timer.start();
        comes([&] { return timer.elapsed() >= time.count(); });
        hosts->join();
        ASSERT_TRUE(comesAnew());
    }
    std::vector<Row> exported() {
        plot().range().show(plot().kept());
        const QTemporaryDir folder;
        QFile file{folder.filePath(QStringLiteral("plot.csv"))};
        EXPECT_EQ(plot().exportTo(file.fileName()), "");
        EXPECT_TRUE(file.open(QIODevice::ReadOnly));
        EXPECT_EQ(file.readLine(), "time_utc,cycle,/ctl.result,quality\n");
        std::vector<Row> rows;
        while (!file.atEnd()) {
            const QList<QByteArray> fields = file.readLine().trimmed().split(',');
            EXPECT_EQ(fields.size(), 4);
            Row row;
            const QByteArray& time = fields[0];  // "2026-11-25T12:14:46.123456789Z"
            row.utc = QDateTime::fromString(time.left(19) + 'Z', Qt::ISODate).toSecsSinceEpoch() *
                          1'000'000'000 +
                      time.mid(20, 9).toLongLong();
            row.cycle = fields[1].toULongLong();
            row.value = fields[2].toDouble();
            if (!rows.empty()) {
                row.start = rows.back().start + (row.cycle <= rows.back().cycle ? 1 : 0);
            }
            if (fields[3] == "good") {
                rows.push_back(row);
            } else {
                EXPECT_EQ(fields[2], "") << "no value is told that was not known";
                if (!rows.empty()) ++unknown;
            }
        }
        return rows;
    }
    // Beside the record of the agent.
    std::vector<Missing> missingIn(const std::vector<Row>& rows) {
        std::vector<Missing> missing;
        std::size_t lost = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const Row& row = rows[i];
            const auto& written = agents.at(row.start)->written;
            EXPECT_EQ(row.value, written.at(row.cycle).value)
                << "cycle " << row.cycle << ": none is invented";
            if (i == 0) continue;
            const Row& before = rows[i - 1];
            EXPECT_GT(row.utc, before.utc);
            if (row.start != before.start) {
                missing.push_back({before, row});
            } else if (row.cycle != before.cycle + 1) {
                lost += row.cycle - before.cycle - 1;
                missing.push_back({before, row});
                const auto passed = written[row.cycle].time - written[before.cycle].time;
                EXPECT_NEAR(static_cast<double>(row.utc - before.utc), static_cast<double>(passed),
                            5e6);  // of the clocks
            }
        }
        EXPECT_LE(lost, session->recorder().time("quick")->skipped + unknown)
            << "each is counted, or has a row without a value";
        return missing;
    }
    // Whether a column of the picture has so many pixels of a colour.
    static int pixels(const QImage& image, const QRect& canvas, int x, const QColor& colour) {
        int count = 0;
        for (int y = canvas.top(); y <= canvas.bottom(); ++y) {
            count += image.pixelColor(x, y).rgb() == colour.rgb();
        }
        return count;
    }
    void expectThatItIsHatched(const Missing& gap) {
        const double length = gap.to() - gap.from();
        plot().range().show({gap.from() - length / 2, gap.to() + length / 2});
        plot().redraw();
        const PlotPanel& panel = *plot().panels().front();
        const QImage image = const_cast<PlotPanel&>(panel).grab().toImage();
        const QRect canvas = panel.canvasBox();
        const QRect lower = canvas.adjusted(0, canvas.height() / 2, 0, 0);  // below the words
        const QColor line = plot().drawn().front().line.pen(1).color();
        const auto hatched = [&](int x) {
            return x >= canvas.left() && x <= canvas.right() &&
                   pixels(image, lower, x, Look::colours().dataBg) >= lower.height() / 3;
        };
        int first = canvas.center().x(), last = first - 1, crossed = 0;
        // Over lines of the grid, also over one that stands a pixel or two before the end.
        const auto goesOn = [&](int x, int to) {
            return hatched(x + to) || hatched(x + 2 * to) || hatched(x + 3 * to);
        };
        while (goesOn(first, -1)) --first;
        while (goesOn(last, 1)) ++last;
        ASSERT_LT(first, last) << "a gap of " << length << " s is not hatched";
        for (int x = first + 2; x <= last - 2; ++x) crossed += pixels(image, canvas, x, line);
        EXPECT_EQ(crossed, 0) << "a line crosses the gap of " << length << " s";
        const double pixel = 2 * length / canvas.width();
        EXPECT_NEAR((last - first + 1) * pixel, length, 3 * pixel);
        EXPECT_NEAR((first - canvas.left()) * pixel, length / 2, 2 * pixel);
        const auto tells = [&](double seconds) {  // which are rounded
            return panel.accessibleName().contains("no data " + durationText(seconds));
        };
        EXPECT_TRUE(tells(length - 0.001) || tells(length + 0.001))
            << panel.accessibleName().toStdString() << length;
    }

    std::optional<TwoHosts> hosts;
    std::vector<std::unique_ptr<WritingAgent>> agents;  // each start
    std::unique_ptr<Session> session;
    std::unique_ptr<MainWindow> window;
    std::size_t unknown = 0;  // rows of cycles that came, on a busy machine, with no good value
};

TEST_F(RecordedCut, ItsCsvIsTheRecordOfTheAgentButForGapsThatAreHatchedToTheirLength) {
    std::vector<std::chrono::milliseconds> cuts{200ms, 3s};
    if (std::getenv("CORTEX_LONG_CUTS") != nullptr) cuts.push_back(30s);
    for (const auto time : cuts) ASSERT_NO_FATAL_FAILURE(cutFor(time));
    endAgent();
    startAgent();
    ASSERT_TRUE(comesAnew());
    endAgent();

    const std::vector<Row> rows = exported();
    ASSERT_FALSE(rows.empty());
    const std::vector<Missing> missing = missingIn(rows);
    EXPECT_EQ(rows.back().start, 1U);
    std::size_t told = 0;
    for (const Missing& gap : missing) {
        if (gap.to() - gap.from() < 0.1) continue;  // of a busy machine
        ++told;
        expectThatItIsHatched(gap);
    }
    EXPECT_GE(told, cuts.size() + 1) << "the cuts, and the new start";
    std::cout << rows.size() << " rows, " << missing.size() - told << " gaps of the machine\n";
}

}  // namespace
}  // namespace cortex::test
