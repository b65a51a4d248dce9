// SPDX-License-Identifier: Apache-2.0
#include "program/measure.hpp"

#include "plots/plot_panel.hpp"
#include "plots/plot_view.hpp"
#include "window/main_window.hpp"

#include <QApplication>
#include <QElapsedTimer>
#include <QFile>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTimer>
#include <algorithm>
#include <ctime>
#include <iostream>
#include <vector>

#include <unistd.h>

namespace cortex::gui {

namespace {

constexpr int framePeriod = 33;  // ms

double threadMilliseconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

double residentMegabytes() {
    QFile file{QStringLiteral("/proc/self/statm")};
    if (!file.open(QIODevice::ReadOnly)) return 0;
    const auto fields = file.readAll().split(' ');
    const double pages = fields.size() > 1 ? fields[1].toDouble() : 0;
    return pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

double percentile(const std::vector<double>& sorted, double share) {
    if (sorted.empty()) return 0;
    const auto last = static_cast<double>(sorted.size() - 1);
    return sorted[static_cast<std::size_t>(share * last)];
}

// The view in front, and what all plots that are seen have.
QJsonObject shownIn(MainWindow& window) {
    std::size_t panels = 0, lines = 0;
    std::int64_t samples = 0;
    for (const PlotView* plot : window.findChildren<PlotView*>()) {
        if (!plot->isVisible()) continue;
        panels += plot->panels().size();
        lines += plot->lines().all().size();
        for (const DrawnLine& each : plot->drawn()) {
            if (each.any()) samples += each.ring->end() - each.ring->begin();
        }
    }
    return {
        {QStringLiteral("width"), window.width()},
        {QStringLiteral("height"), window.height()},
        {QStringLiteral("view"), QString::fromLatin1(window.current()->metaObject()->className())},
        {QStringLiteral("panels"), static_cast<int>(panels)},
        {QStringLiteral("lines"), static_cast<int>(lines)},
        {QStringLiteral("samples"), static_cast<double>(samples)}};
}

}  // namespace

int measure(MainWindow& window, const Options& options) {
    QElapsedTimer timer;
    timer.start();
    const auto passed = [&](double seconds) {
        return static_cast<double>(timer.elapsed()) >= seconds * 1e3;
    };
    while (!window.ready() && !passed(options.timeout)) {
        QApplication::processEvents(QEventLoop::WaitForMoreEvents);
    }
    const double before = residentMegabytes();
    std::vector<double> frames;
    double last = threadMilliseconds();
    QTimer tick;
    QObject::connect(&tick, &QTimer::timeout, [&] {
        const double now = threadMilliseconds();
        frames.push_back(now - last);
        last = now;
    });
    tick.start(framePeriod);
    timer.restart();
    while (!passed(options.measureSeconds)) {
        QApplication::processEvents(QEventLoop::WaitForMoreEvents);
    }
    tick.stop();
    std::ranges::sort(frames);
    const QJsonObject result{
        {QStringLiteral("seconds"), options.measureSeconds},
        {QStringLiteral("frames"), static_cast<int>(frames.size())},
        {QStringLiteral("cpu_ms_of_a_frame"),
         QJsonObject{{QStringLiteral("median"), percentile(frames, 0.5)},
                     {QStringLiteral("p99"), percentile(frames, 0.99)}}},
        {QStringLiteral("memory_mb"), QJsonObject{{QStringLiteral("begin"), before},
                                                  {QStringLiteral("end"), residentMegabytes()}}},
        {QStringLiteral("shown"), shownIn(window)}};
    QFile file{QString::fromStdString(options.measureFile)};
    const QByteArray text = QJsonDocument{result}.toJson();
    if (file.open(QIODevice::WriteOnly) && file.write(text) == text.size()) return 0;
    std::cerr << "error: " << options.measureFile << " cannot be written: is its folder there?\n";
    return 1;
}

}  // namespace cortex::gui
