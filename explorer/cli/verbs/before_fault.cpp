// SPDX-License-Identifier: Apache-2.0
#include "common/past_events.hpp"
#include "live/live_json.hpp"
#include "verbs/event_printer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <set>

namespace cortex::cli {
namespace {

using common::AgentEvents;

// Faults at or below the prefix that agents keep, until there is one: backwards, as all that they
// keep may be much.
AgentEvents newestKept(KeptPast& past, const std::string& prefix, std::int64_t until) {
    using namespace std::chrono_literals;
    const std::chrono::nanoseconds now = std::chrono::system_clock::now().time_since_epoch();
    const std::int64_t end = std::min<std::int64_t>(until, now.count());
    for (const std::chrono::nanoseconds ago : {10min, 120min, 0min}) {
        const std::int64_t from = ago == 0min ? 0 : common::timeBefore(end, ago.count());
        AgentEvents events = past.ask(prefix, from, until);
        std::erase_if(events, [](const comms::AgentEvent& each) { return each.kind != "fault"; });
        common::sortByTime(events);
        if (common::newestFaults(events, prefix)) return events;
        until = from - 1;
    }
    return {};
}

[[noreturn]] void failWithNone(const Live& live, const KeptPast& past, const std::string& prefix,
                               bool limited) {
    live.failIfNothingIsAt(prefix);
    past.printNotes(0, {"fault"});
    const std::string where =
        (prefix == "/" ? "" : " at or below " + prefix) + (limited ? " of that time" : "");
    if (past.complete()) throw Failure{No, "no fault" + where + " is kept"};
    throw Failure{NotFound, "no fault" + where + " is known, but not all agents could say it"};
}

std::string remarkOn(const AgentEvents& events, const common::FaultChain& chain) {
    if (chain.faults == 1) return "  <- the fault";
    return "  <- the first of " + std::to_string(chain.faults) +
           " faults within a second; the last: " + events[chain.newest].path;
}

// Clocks of hosts differ.
void tellClocks(const Live& live, const AgentEvents& events) {
    std::set<std::string> hosts;
    for (const comms::AgentEvent& each : events) hosts.insert(live.statusOf(each.agent).host);
    hosts.erase("");
    if (hosts.size() < 2) return;
    std::cerr << "cortex: each time is by the clock of its agent's host: "
              << printable(joined({hosts.begin(), hosts.end()})) << '\n';
}

void printBefore(const EventOptions& options, const EventPrinter& printer,
                 const AgentEvents& events, const std::string& remark) {
    if (options.json) {
        Json list = Json::array();
        for (const comms::AgentEvent& each : events) list.push_back(eventJson(each));
        return print(list);
    }
    std::size_t width = 0;
    for (const comms::AgentEvent& each : events)
        width = std::max(width, common::secondsBefore(each, events.back()).size());
    printer.head();
    for (const comms::AgentEvent& each : events) {
        const std::string when = common::secondsBefore(each, events.back());
        printer.line(each, std::string(width - when.size(), ' ') + when + ' ',
                     &each == &events.back() ? remark : "");
    }
}

}  // namespace

Exit showBeforeFault(Live& live, Arrivals& arrivals, const EventOptions& options,
                     const EventPrinter& printer, std::int64_t until) {
    KeptPast past{live};
    AgentEvents events = arrived(live, arrivals);
    events = common::merged(newestKept(past, options.prefix, until), std::move(events));
    std::erase_if(events, [&](const comms::AgentEvent& each) { return each.wallClock > until; });
    const auto found = common::newestFaults(events, options.prefix);
    if (!found) failWithNone(live, past, options.prefix, options.until.has_value());
    const std::int64_t newest = events[found->newest].wallClock;
    const std::int64_t span = std::llround(options.seconds * 1e9);
    const std::int64_t begin = common::timeBefore(newest, common::chainTime + span);
    events = common::merged(past.ask("/", begin, newest), std::move(events));
    std::erase_if(events, [&](const comms::AgentEvent& each) { return each.wallClock > newest; });
    const auto chain = common::newestFaults(events, options.prefix);
    const std::string remark = remarkOn(events, *chain);
    AgentEvents shown = common::beforeEvent(events, chain->first, span);
    const comms::AgentEvent fault = shown.back();
    shown.pop_back();
    std::erase_if(shown, [&](const comms::AgentEvent& each) { return !printer.shows(each, "/"); });
    shown.push_back(fault);
    past.printNotes(common::timeBefore(fault.wallClock, span), printer.kinds());
    tellClocks(live, shown);
    printBefore(options, printer, shown, remark);
    return past.complete() ? Yes : NotFound;
}

}  // namespace cortex::cli
