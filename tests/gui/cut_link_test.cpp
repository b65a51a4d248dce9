// SPDX-License-Identifier: Apache-2.0
// A window and an agent on two hosts, while the link between them is cut and joined again.
#include "cli/live_agent.hpp"
#include "gui/window_fixture.hpp"
#include "network/host.hpp"
#include "plots/plot_panel.hpp"
#include "plots/plot_view.hpp"
#include "views/simplex_header.hpp"
#include "widgets/text_label.hpp"

#include <QElapsedTimer>
#include <QImage>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <optional>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace std::chrono_literals;

const QString item = QStringLiteral("cycleDurationLast");  // another one in each cycle

class CutLink : public testing::Test {
protected:
    void SetUp() override {
        if (const std::string why = whyNoHosts(); !why.empty()) GTEST_SKIP() << why;
        hosts.emplace();
        folder.write("mixer.xml", mixerSystem());
        const std::string file = (folder.path() / "mixer.xml").string();
        agent.emplace(std::vector<std::string>{"/usr/bin/nsenter", "--net=" + hosts->second.path(),
                                               CORTEX_BINARY_DIR "/bin/cortex-agent", file,
                                               "--domain", domain, "--interface", "10.77.0.2"});
        comms::NetworkOptions options;
        options.domain = std::stoi(domain);
        options.interfaces = {"10.77.0.1"};
        // Its thread stays on the host that it is started on.
        hosts->first.within([&] { session = std::make_unique<Session>(options); });
        window = std::make_unique<MainWindow>(*session);
        window->show();
        ASSERT_TRUE(comes([this] { return window->ready(); }));
        window->open("/mixer");
        ASSERT_TRUE(comes([this] { return isLive(); })) << value().toStdString();
    }

    ItemTable& table() { return *window->current()->findChild<ItemTable*>(); }
    QModelIndex cell() {
        const QAbstractItemModel& rows = *table().model();
        for (int group = 0; group < rows.rowCount(); ++group) {
            const QModelIndex above = rows.index(group, 0);
            for (int row = 0; row < rows.rowCount(above); ++row) {
                if (rows.index(row, ItemModel::Name, above).data() != item) continue;
                return rows.index(row, ItemModel::Value, above);
            }
        }
        return {};
    }
    QString value() { return cell().data(Qt::AccessibleTextRole).toString(); }
    bool isInBrackets() { return value().startsWith('[') && value().endsWith(']'); }
    bool isLive() { return !value().isEmpty() && value().front().isDigit(); }
    // A value that is shown now gives way to another one.
    bool isLiveAgain() {
        if (!comes([this] { return isLive(); })) return false;
        const QString first = value();
        return comes([&] { return isLive() && value() != first; });
    }
    bool isLost() { return session->frame()->agents.front().lost(); }
    bool says(const QString& text) {
        const auto labels =
            window->current()->findChild<SimplexHeader*>()->findChildren<TextLabel*>();
        return std::ranges::any_of(labels, [&](const auto* each) {
            return each->isVisible() && each->accessibleName().contains(text);
        });
    }
    QString notice() {
        for (const auto* each :
             window->current()->findChild<SimplexHeader*>()->findChildren<TextLabel*>()) {
            if (each->isVisible() && each->text().contains("is not heard for")) return each->text();
        }
        return {};
    }
    // Pixels of the cell of the value that have the colour of what is lost.
    int lostPixels() {
        table().scrollTo(cell());
        const QRect place = table().visualRect(cell());
        EXPECT_FALSE(place.isEmpty());
        const QImage picture = table().viewport()->grab(place).toImage();
        const QColor lost = Look::colours().dataText;
        int count = 0;
        for (int y = 0; y < picture.height(); ++y) {
            for (int x = 0; x < picture.width(); ++x) {
                const QColor pixel = picture.pixelColor(x, y);
                count += std::abs(pixel.red() - lost.red()) < 30 &&
                         std::abs(pixel.green() - lost.green()) < 30 &&
                         std::abs(pixel.blue() - lost.blue()) < 30;
            }
        }
        return count;
    }
    // Of the plot that is in front: samples that came, and how many of them no longer.
    const Ring* ring() const {
        return session->recorder().ring({"mixer", "/mixer", item.toStdString(), 0});
    }

    void isNotHeardWhileCutFor(std::chrono::milliseconds time) {
        ASSERT_EQ(lostPixels(), 0);
        QElapsedTimer timer;
        timer.start();
        hosts->cut();
        // Of one frame of the window: that of the session may be a later one.
        ASSERT_TRUE(comes([this] { return says("quality lost") && isInBrackets(); }));
        EXPECT_TRUE(says("mixer is not heard for"));
        EXPECT_TRUE(says("Values are the last ones, in brackets."));
        EXPECT_TRUE(says(" old"));
        EXPECT_GT(lostPixels(), 0) << "the value has the colour of what is lost";
        const QString last = value(), before = notice();
        EXPECT_TRUE(comes([&] { return notice() != before; })) << "the age grows";
        ASSERT_TRUE(comes([&] { return timer.elapsed() >= time.count(); }));
        EXPECT_TRUE(isLost());
        EXPECT_EQ(value(), last) << "the last value stays as it was";

        hosts->join();
        EXPECT_TRUE(isLiveAgain()) << value().toStdString();
        EXPECT_FALSE(says("is not heard"));
        EXPECT_FALSE(says("quality lost"));
        EXPECT_EQ(lostPixels(), 0);
    }

    const ModelFolder folder;
    std::optional<TwoHosts> hosts;
    std::optional<Background> agent;
    std::unique_ptr<Session> session;
    std::unique_ptr<MainWindow> window;
};

TEST_F(CutLink, APlotHasAGapAsLongAsTheCutAndNoValueInIt) {
    window->openPlot({{{}, "/mixer", item.toStdString(), 0}});
    ASSERT_TRUE(
        comes([this] { return ring() != nullptr && ring()->end() - ring()->begin() > 100; }));
    const auto* plot = qobject_cast<PlotView*>(window->current());
    const auto gaps = [&] { return plot->panels().front()->gaps(); };
    hosts->cut();
    ASSERT_TRUE(comes([this] { return isLost(); }));
    ASSERT_TRUE(comes([&] { return !gaps().empty() && gaps().back().to >= plot->kept().to; }));
    const std::int64_t end = ring()->end();
    QElapsedTimer timer;
    timer.start();
    ASSERT_TRUE(comes([&] { return timer.elapsed() >= 500; }));
    EXPECT_EQ(ring()->end(), end) << "nothing is appended while nothing comes";
    hosts->join();
    ASSERT_TRUE(comes([&] { return ring()->end() > end; }));
    const AgentTime& time = *session->recorder().time("mixer");
    const std::int64_t next = ring()->nextPresent(end, ring()->end());
    EXPECT_GT(time.secondsAt(next) - time.secondsAt(end - 1), 0.5);
    EXPECT_FALSE(ring()->extent(end, next).any());
    EXPECT_GT(time.skipped, 0U);
}

TEST_F(CutLink, LosesNothingInAShortCut) {
    bool wasLost = false;
    const auto watch = [&] { wasLost = wasLost || isLost(); };
    hosts->cut();
    QElapsedTimer timer;
    timer.start();
    comes([&] {
        watch();
        return timer.elapsed() >= 200;
    });
    hosts->join();
    const std::int64_t cycle = session->frame()->agents.front().status.cycle;
    EXPECT_TRUE(comes([&] {
        watch();
        return session->frame()->agents.front().status.cycle > cycle && isLive();
    }));
    EXPECT_TRUE(isLiveAgain());
    EXPECT_FALSE(wasLost);
    EXPECT_FALSE(says("is not heard"));
    EXPECT_EQ(lostPixels(), 0);
}

TEST_F(CutLink, ShowsLastValuesInBracketsUntilTheAgentIsHeardAgain) {
    ASSERT_NO_FATAL_FAILURE(isNotHeardWhileCutFor(3s));
    if (std::getenv("CORTEX_LONG_CUTS") != nullptr) isNotHeardWhileCutFor(30s);
}

}  // namespace
}  // namespace cortex::test
