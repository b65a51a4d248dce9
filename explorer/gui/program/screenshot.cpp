// SPDX-License-Identifier: Apache-2.0
#include "program/screenshot.hpp"

#include "cortex/core/nearest_names.hpp"

#include "common/no_agent.hpp"
#include "plots/plot_view.hpp"
#include "session/session.hpp"
#include "window/main_window.hpp"
#include "window/workspace.hpp"

#include <QApplication>
#include <QElapsedTimer>
#include <QPixmap>
#include <algorithm>
#include <iostream>
#include <sstream>

namespace cortex::gui {

namespace {

// In the words of `cortex`, which ends with the same exit code.
constexpr int notFound = 3;
constexpr double secondsOfPlot = 5;

int fail(const std::string& why) {
    std::cerr << "error: " << why << '\n';
    return notFound;
}

bool haveAll(const Frame& frame, const std::vector<std::string>& paths) {
    return std::ranges::all_of(paths,
                               [&](const auto& each) { return frame.find(each).has_value(); });
}

std::string nobodyOn(int domain, const std::string& server) {
    const std::string none = common::noAgent(domain, server);
    if (!server.empty()) return none + " is heard; " + common::serverRemedy(server);
    return none + "; start one (cortex-agent FILE --domain " + std::to_string(domain) +
           "), look at another domain (--domain N or CORTEX_DOMAIN), or name the interface that "
           "the agents are kept to (--interface lo or CORTEX_INTERFACE)";
}

std::string unknown(const Frame& frame, const std::string& path, double limit) {
    if (!frame.complete) {
        std::ostringstream text;
        text << path << " was not found within " << limit
             << " s, which does not mean that it is not there; wait longer (--timeout)";
        return text.str();
    }
    std::vector<std::string> paths;
    for (const AgentFrame& agent : frame.agents) {
        if (!agent.structure) continue;
        for (const SimplexInfo& info : agent.structure->simplexes) paths.push_back(info.path);
    }
    const std::string nearest = nearestNames(path, paths);
    return "no agent has a simplex " + path + (nearest.empty() ? "" : "; " + nearest);
}

// A plot is a picture once it has some seconds to show.
bool hasSomeTime(const MainWindow& window) {
    const auto* plot = qobject_cast<const PlotView*>(window.current());
    return plot == nullptr || plot->kept().length() >= secondsOfPlot;
}

}  // namespace

int writeScreenshot(MainWindow& window, const Session& session, const Options& options) {
    const std::string& file = options.screenshot;
    const double limit = options.timeout;
    QElapsedTimer timer;
    timer.start();
    bool ready = false;
    while (!ready && static_cast<double>(timer.elapsed()) < limit * 1000) {
        QApplication::processEvents(QEventLoop::WaitForMoreEvents);
        const auto now = session.frame();
        ready = window.ready() && !window.asksForPast() && hasSomeTime(window) &&
                (now->complete || haveAll(*now, options.paths));
    }
    const auto frame = session.frame();
    if (!frame->problem.empty()) return fail(frame->problem);
    if (frame->agents.empty())
        return fail(nobodyOn(frame->domain, options.network.discoveryServer));
    for (const std::string& path : options.paths) {
        if (!frame->find(path)) return fail(unknown(*frame, path, limit));
    }
    window.refresh();
    while (!window.workspace().settled() && static_cast<double>(timer.elapsed()) < limit * 1000) {
        QApplication::processEvents(QEventLoop::WaitForMoreEvents);
    }
    if (QWidget* focus = window.focusWidget()) focus->clearFocus();  // nobody types
    QApplication::processEvents();
    if (!window.grab().save(QString::fromStdString(file))) {
        std::cerr << "error: " << file << " cannot be written: is its folder there, and does its "
                  << "name end with .png?\n";
        return 1;
    }
    if (!ready) std::cerr << "warning: not everything had come within " << limit << " s\n";
    return 0;
}

}  // namespace cortex::gui
