// SPDX-License-Identifier: Apache-2.0
#include "live_values.hpp"
#include "live_verbs.hpp"

#include <algorithm>
#include <condition_variable>
#include <iostream>
#include <mutex>
#include <tuple>
#include <utility>

namespace cortex::explorer {
namespace {

using comms::AgentEvent;

// Events on their way from the mirror's thread to ours.
class Arrivals {
public:
    void push(const AgentEvent& event) {
        {
            const std::lock_guard lock{mutex_};
            events_.push_back(event);
        }
        changed_.notify_one();
    }
    // All that have come; waits for one. Empty: none within `limit`.
    std::vector<AgentEvent> take(std::chrono::milliseconds limit) {
        std::unique_lock lock{mutex_};
        changed_.wait_for(lock, limit, [&] { return !events_.empty(); });
        return std::exchange(events_, {});
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<AgentEvent> events_;
};

class Printer {
public:
    Printer(const EventOptions& options, Severity least) : options_{options}, least_{least} {}

    bool shows(const AgentEvent& event) const {
        if (event.severity < least_) return false;
        const std::string& prefix = options_.prefix;
        return prefix == "/" || event.path == prefix || event.path.starts_with(prefix + "/");
    }
    void head() const {
        if (options_.csv)
            std::cout << "time,agent,number,cycle,severity,kind,path,text" << std::endl;
    }
    void line(const AgentEvent& event) const {
        if (options_.csv) {
            std::cout << timeText(event.wallClock) << ',' << csvText(event.agent) << ','
                      << event.number << ',' << event.cycle << ',' << name(event.severity) << ','
                      << csvText(event.kind) << ',' << csvText(event.path) << ','
                      << csvText(event.text) << std::endl;
        } else if (options_.json) {
            std::cout << json(event).dump(-1, ' ', false, Json::error_handler_t::replace)
                      << std::endl;
        } else {
            std::cout << timeText(event.wallClock) << ' ' << name(event.severity) << ' '
                      << printable(event.path.empty() ? event.agent : event.path) << ' '
                      << printable(event.text) << std::endl;
        }
    }
    static Json json(const AgentEvent& event) {
        return {{"time", timeText(event.wallClock)},
                {"agent", event.agent},
                {"number", event.number},
                {"cycle", event.cycle},
                {"severity", name(event.severity)},
                {"kind", event.kind},
                {"path", event.path},
                {"text", event.text}};
    }

private:
    const EventOptions& options_;
    Severity least_;
};

void sort(std::vector<AgentEvent>& events) {
    std::ranges::sort(events, {}, [](const AgentEvent& event) {
        return std::tie(event.wallClock, event.number, event.agent);
    });
}

// Nothing says that the past has come whole: it is taken to be when nothing more comes for a while.
std::vector<AgentEvent> past(Live& live, Arrivals& arrivals) {
    std::vector<AgentEvent> events;
    for (;;) {
        const auto quiet = std::min(live.left(), std::chrono::milliseconds{300});
        const auto more = arrivals.take(quiet);
        events.insert(events.end(), more.begin(), more.end());
        if (more.empty() || live.left() <= std::chrono::milliseconds{1}) break;
    }
    sort(events);
    return events;
}

}  // namespace

Exit showEvents(const EventOptions& options) {
    checkPrefix(options.prefix);
    const auto least = severityFromName(options.severity);
    if (!least) throw Failure{Usage, "--severity is info, warning or error"};
    const Printer printer{options, *least};
    Arrivals arrivals;
    Live live{options.network};
    live.mirror().onEvent([&](const AgentEvent& event) { arrivals.push(event); });
    live.waitForAll();
    std::vector<AgentEvent> events = past(live, arrivals);
    std::erase_if(events, [&](const AgentEvent& event) { return !printer.shows(event); });
    if (options.json && !options.follow) {
        Json list = Json::array();
        for (const AgentEvent& each : events) list.push_back(Printer::json(each));
        print(list);
        return Yes;
    }
    printer.head();
    for (const AgentEvent& each : events) printer.line(each);
    while (options.follow && std::cout) {
        for (const AgentEvent& each : arrivals.take(std::chrono::seconds{1})) {
            if (printer.shows(each)) printer.line(each);
        }
    }
    return Yes;
}

}  // namespace cortex::explorer
