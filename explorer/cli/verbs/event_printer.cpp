// SPDX-License-Identifier: Apache-2.0
#include "verbs/event_printer.hpp"

#include "cortex/core/event.hpp"

#include "live/live_json.hpp"
#include "live/live_values.hpp"

#include <algorithm>
#include <iostream>

namespace cortex::cli {
namespace {

// A word of a command line has no blanks: "state-change".
std::string kindFrom(std::string word) {
    std::ranges::replace(word, '-', ' ');
    if (eventKindFromName(word)) return word;
    std::vector<std::string> kinds;
    for (int i = 0; i <= static_cast<int>(EventKind::ValueChange); ++i) {
        kinds.emplace_back(name(static_cast<EventKind>(i)));
        std::ranges::replace(kinds.back(), ' ', '-');
    }
    throw Failure{Usage, "--kind is one of " + joined(kinds)};
}

}  // namespace

EventPrinter::EventPrinter(const EventOptions& options) : options_{options} {
    const auto least = severityFromName(options.severity);
    if (!least) throw Failure{Usage, "--severity is info, warning or error"};
    least_ = *least;
    for (const std::string& each : options.kinds) kinds_.push_back(kindFrom(each));
}

bool EventPrinter::shows(const comms::AgentEvent& event, const std::string& prefix) const {
    if (event.severity < least_ || !common::concerns(event, prefix)) return false;
    return kinds_.empty() || std::ranges::count(kinds_, event.kind) > 0;
}

void EventPrinter::head() const {
    if (options_.csv) std::cout << "time,agent,number,cycle,severity,kind,path,text" << std::endl;
}

void EventPrinter::line(const comms::AgentEvent& event, const std::string& when,
                        const std::string& remark) const {
    if (options_.csv) {
        std::cout << common::utcText(event.wallClock) << ',' << csvText(event.agent) << ','
                  << event.number << ',' << event.cycle << ',' << name(event.severity) << ','
                  << csvText(event.kind) << ',' << csvText(event.path) << ',' << csvText(event.text)
                  << std::endl;
    } else if (options_.json) {
        printLine(eventJson(event));
    } else {
        std::cout << common::utcText(event.wallClock) << ' ' << when << name(event.severity) << ' '
                  << printable(event.path.empty() ? event.agent : event.path) << ' '
                  << printable(event.text) << printable(remark) << std::endl;
    }
}

}  // namespace cortex::cli
