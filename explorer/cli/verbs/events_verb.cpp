// SPDX-License-Identifier: Apache-2.0
#include "live/live_events.hpp"
#include "live/live_json.hpp"
#include "live/live_values.hpp"
#include "text/interrupts.hpp"
#include "verbs/live_verbs.hpp"

#include <algorithm>
#include <iostream>

namespace cortex::cli {
namespace {

using comms::AgentEvent;

class EventPrinter {
public:
    EventPrinter(const EventOptions& options, Severity least) : options_{options}, least_{least} {}

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
            std::cout << common::utcText(event.wallClock) << ',' << csvText(event.agent) << ','
                      << event.number << ',' << event.cycle << ',' << name(event.severity) << ','
                      << csvText(event.kind) << ',' << csvText(event.path) << ','
                      << csvText(event.text) << std::endl;
        } else if (options_.json) {
            printLine(eventJson(event));
        } else {
            std::cout << common::utcText(event.wallClock) << ' ' << name(event.severity) << ' '
                      << printable(event.path.empty() ? event.agent : event.path) << ' '
                      << printable(event.text) << std::endl;
        }
    }

private:
    const EventOptions& options_;
    Severity least_;
};

// Until nothing more comes for a while in which the agents said, of all that has happened by now,
// what they have written, and that is here.
std::vector<AgentEvent> past(Live& live, Arrivals& arrivals) {
    std::vector<AgentEvent> events;
    for (;;) {
        const auto quiet = std::min(live.left(), std::chrono::milliseconds{300});
        throwIfInterrupted();
        const auto more = arrivals.take(quiet);
        events.insert(events.end(), more.begin(), more.end());
        if (live.left() <= std::chrono::milliseconds{1}) break;
        if (more.empty() && live.mirror().eventsComplete()) break;
    }
    sortByTime(events);
    return events;
}

}  // namespace

Exit showEvents(const EventOptions& options) {
    checkPrefix(options.prefix);
    const auto least = severityFromName(options.severity);
    if (!least) throw Failure{Usage, "--severity is info, warning or error"};
    const EventPrinter printer{options, *least};
    Arrivals arrivals;
    Live live{options.network};
    live.listen([&](const AgentEvent& event) { arrivals.push(event); });
    live.waitForAll();
    std::vector<AgentEvent> events = past(live, arrivals);
    std::erase_if(events, [&](const AgentEvent& event) { return !printer.shows(event); });
    if (options.json && !options.follow) {
        Json list = Json::array();
        for (const AgentEvent& each : events) list.push_back(eventJson(each));
        print(list);
        return Yes;
    }
    printer.head();
    for (const AgentEvent& each : events) printer.line(each);
    while (options.follow && std::cout) {
        throwIfInterrupted();
        for (const AgentEvent& each : arrivals.take(interruptSlice)) {
            if (printer.shows(each)) printer.line(each);
        }
    }
    return Yes;
}

}  // namespace cortex::cli
