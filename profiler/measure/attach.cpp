// SPDX-License-Identifier: Apache-2.0
#include "attach.hpp"

#include "cortex/comms/mirror.hpp"
#include "cortex/core/error.hpp"

#include "measure/run.hpp"
#include "measure/sweep.hpp"
#include "measure/terminal_progress.hpp"
#include "report/comparison.hpp"
#include "report/machine_facts.hpp"
#include "report/number_text.hpp"
#include "report/results_files.hpp"
#include "report/summary_text.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <iostream>
#include <set>
#include <thread>
#include <utility>

namespace cortex::profiler {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::size_t mostTasks = 8;  // in the figure: those that take longest

struct Metric {
    const char *item, *title, *unit;
    bool logarithmic;
};
constexpr std::array metrics{
    Metric{"cycleDuration", "Time between beginnings of cycles", "us", false},
    Metric{"jitter", "Jitter: how far these times are from the period", "us", true},
    Metric{"lateness", "Lateness: how late cycles begin", "us", true},
    Metric{"dutyCycle", "Duty cycle", "%", true},
    Metric{"commandLatency", "Latency of commands", "us", true}};
constexpr std::array statistics{"Last", "P50", "P99", "P999", "Max"};

struct TaskTimes {
    std::uint32_t simplex;
    Series series;
    double greatest = 0, sum = 0;
    double mean() const {
        return series.points.empty() ? 0 : sum / static_cast<double>(series.points.size());
    }
};

// Samples of one agent.
class Attached {
public:
    Attached(comms::Mirror& mirror, std::string agent);
    void sample(double seconds);
    void report(const std::string& setup, Results& results);
    bool empty() const { return overflow_.points.empty(); }
    double lasted() const { return overflow_.points.back().x; }  // s, until the last values came

private:
    void view();
    void addTasks(const std::string& setup, Results& results);

    comms::Mirror& mirror_;
    std::string agent_, path_;
    std::shared_ptr<const Structure> structure_;
    std::vector<Figure> figures_;
    Series overflow_{"missed ticks", {}, false};
    std::vector<TaskTimes> tasks_;
    std::int64_t lastCycle_ = -1;
};

Attached::Attached(comms::Mirror& mirror, std::string agent)
    : mirror_{mirror}, agent_{std::move(agent)}, path_{"/" + agent_} {
    structure_ = mirror.structure(agent_);
    const std::uint32_t index = structure_ ? structure_->find(path_) : noSimplex;
    if (index == noSimplex || structure_->simplexes[index].layout->find("dutyCycleLast") == nullptr)
        throw Error("agent " + agent_ + " has no loop, so there are no metrics to look at");
    for (const Metric& metric : metrics) {
        Figure figure;
        figure.id = std::string{"attach-"} + metric.item;
        figure.title = std::string{metric.title} + " of " + path_;
        figure.x = {"time", "s", false};
        figure.y = {metric.item, metric.unit, metric.logarithmic};
        for (const char* each : statistics) figure.series.push_back({each, {}, false});
        figures_.push_back(std::move(figure));
    }
    for (std::uint32_t i = 0; i < structure_->simplexes.size(); ++i) {
        const SimplexInfo& info = structure_->simplexes[i];
        if (info.remote || info.layout->find("taskTime") == nullptr) continue;
        tasks_.push_back({i, {info.path, {}, false}});
    }
    view();
}

// The agent's own simplexes, by the first parts of their paths.
void Attached::view() {
    std::set<std::string> prefixes{path_};
    for (const TaskTimes& task : tasks_) {
        const std::string& path = structure_->simplexes[task.simplex].path;
        prefixes.insert(path.substr(0, path.find('/', 1)));
    }
    mirror_.view(std::vector<std::string>{prefixes.begin(), prefixes.end()});
}

void Attached::sample(double seconds) {
    const comms::AgentImage image = mirror_.image(agent_);
    if (!image || &image->structure() != structure_.get()) return;
    const Quality quality = image->quality(path_);
    if (quality == Quality::Lost || image->cycle() == lastCycle_) return;
    lastCycle_ = image->cycle();
    for (std::size_t i = 0; i < metrics.size(); ++i) {
        for (std::size_t k = 0; k < statistics.size(); ++k) {
            const std::string item = std::string{metrics[i].item} + statistics[k];
            figures_[i].series[k].points.push_back({seconds, image->get<double>(path_, item)});
        }
    }
    overflow_.points.push_back(
        {seconds, static_cast<double>(image->get<std::int64_t>(path_, "overflowCount"))});
    for (TaskTimes& task : tasks_) {
        const double time = image->get<double>(task.series.name, "taskTime");
        task.series.points.push_back({seconds, time});
        task.greatest = std::max(task.greatest, time);
        task.sum += time;
    }
}

void Attached::addTasks(const std::string& setup, Results& results) {
    std::ranges::sort(tasks_, std::greater{}, &TaskTimes::mean);
    Figure figure;
    figure.id = "attach-task-times";
    figure.title = "Tasks of " + agent_ + " that take longest";
    figure.setup = setup + " A task is timed in turn: a value stands until it is timed again.";
    figure.x = {"time", "s", false};
    figure.y = {"task time", "us", true};
    for (std::size_t i = 0; i < std::min(tasks_.size(), mostTasks); ++i) {
        figure.series.push_back(tasks_[i].series);
        results.add("attach/task" + tasks_[i].series.name,
                    "task of " + tasks_[i].series.name + ", mean; max " +
                        readable(tasks_[i].greatest) + " us",
                    "us", tasks_[i].mean());
    }
    if (!figure.series.empty()) results.figures.push_back(std::move(figure));
}

void Attached::report(const std::string& setup, Results& results) {
    for (std::size_t i = 0; i < metrics.size(); ++i) {
        figures_[i].setup = setup + " Percentiles and maximum: since the agent's start.";
        for (std::size_t k = 1; k < statistics.size(); ++k) {
            results.add(std::string{"attach/"} + metrics[i].item + '-' + statistics[k],
                        std::string{metrics[i].title} + ", " + statistics[k], metrics[i].unit,
                        figures_[i].series[k].points.back().y);
        }
        results.figures.push_back(figures_[i]);
    }
    results.add("attach/missed-ticks", "ticks missed while it was looked at", "ticks",
                overflow_.points.back().y - overflow_.points.front().y);
    addTasks(setup, results);
}

double since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

void waitFor(comms::Mirror& mirror, const AttachRequest& request) {
    const std::chrono::milliseconds limit{static_cast<std::int64_t>(request.timeout * 1000)};
    if (mirror.waitForOwner("/" + request.agent, limit) == request.agent) return;
    std::string there;
    for (const comms::AgentStatus& each : mirror.agents()) {
        there += (there.empty() ? "" : ", ") + each.name;
    }
    throw Error(
        "there is no agent '" + request.agent + "' in domain " +
        std::to_string(request.network.domain) + "; " +
        (there.empty() ? "none is heard: see --domain and --interface" : "there are " + there));
}

}  // namespace

int attach(const AttachRequest& request) {
    noteStopSignals();
    comms::Mirror mirror{"profiler", request.network};
    waitFor(mirror, request);
    const std::filesystem::path folder = makeFolder(request.folder, request.force);
    std::cerr << "Takes " << durationText(request.seconds) << "; Ctrl-C keeps what there is.\n";
    Results results = newResults(request.command);
    Attached attached{mirror, request.agent};
    mirror.waitForValues(5s);
    {
        TerminalProgress progress{request.seconds};
        progress.begin(request.agent, request.seconds);
        const auto begin = Clock::now();
        for (double now = 0; now < request.seconds && !stopAsked(); now = since(begin)) {
            attached.sample(now);
            progress.step(now / request.seconds, "looking at its metrics");
            std::this_thread::sleep_for(100ms);
        }
        results.complete = !stopAsked();
    }
    if (attached.empty()) throw Error("no values of " + request.agent + " came");
    attached.report("Agent " + request.agent + " over the network, 10 samples a second.", results);
    if (!results.complete) results.notes.push_back("Stopped before its time.");
    if (attached.lasted() < 0.8 * request.seconds && results.complete) {
        results.notes.push_back("The values of " + request.agent + " ended after " +
                                durationText(attached.lasted()) + ".");
    }
    for (Quantity& each : results.quantities) each.group = "Agent " + request.agent;
    save(results, folder);
    return tellResults(results, folder);
}

}  // namespace cortex::profiler
