// SPDX-License-Identifier: Apache-2.0
#include "common/time_words.hpp"
#include "common/utc_text.hpp"
#include "live/live_json.hpp"
#include "text/interrupts.hpp"
#include "verbs/event_printer.hpp"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <iterator>
#include <limits>
#include <set>
#include <tuple>

namespace cortex::cli {
namespace {

// Of the time of events, both ends included.
struct TimeSpan {
    std::int64_t from = 0, until = std::numeric_limits<std::int64_t>::max();

    bool has(const comms::AgentEvent& event) const {
        return event.wallClock >= from && event.wallClock <= until;
    }
};

std::int64_t timeOf(const std::string& option, const std::string& words, std::int64_t now) {
    constexpr std::size_t widest = 40;
    const auto time = common::timeFrom(words, now);
    const std::string given = option + " '" + clipped(words, widest) + "' is ";
    if (!time) throw Failure{Usage, given + "no time; write " + common::timeForms};
    if (*time <= now) return *time;
    throw Failure{Usage, given + "in the future: by this machine it is " + common::utcText(now, 0)};
}

// Agents keep values that changed their state, and do not publish them as events.
void checkValues(const EventOptions& options) {
    const auto values = std::ranges::count(options.kinds, "value");
    if (values == 0) return;
    if (options.follow && values == std::ssize(options.kinds))
        throw Failure{Usage,
                      "--follow cannot show values that change later: agents tell them only when "
                      "they are asked; leave out --follow, and ask again"};
    if (!options.since && !options.beforeFault)
        throw Failure{
            Usage,
            "--kind value needs --since or --before-fault: agents keep values that changed their "
            "state, and do not publish them as events"};
}

TimeSpan spanOf(const EventOptions& options) {
    TimeSpan span;
    checkValues(options);
    if (options.until && !options.since && !options.beforeFault)
        throw Failure{Usage, "--until needs --since or --before-fault"};
    const std::int64_t now = std::chrono::duration_cast<std::chrono::nanoseconds>(
                                 std::chrono::system_clock::now().time_since_epoch())
                                 .count();
    if (options.since) span.from = timeOf("--since", *options.since, now);
    if (options.until) span.until = timeOf("--until", *options.until, now);
    if (span.from <= span.until) return span;
    throw Failure{Usage, "--since is " + common::utcText(span.from, 0) +
                             ", after --until, which is " + common::utcText(span.until, 0)};
}

void follow(Arrivals& arrivals, const EventOptions& options, const EventPrinter& printer,
            const TimeSpan& span, const common::AgentEvents& printed) {
    using Key = std::tuple<std::string, std::int64_t, std::uint64_t>;
    std::set<Key> there;
    for (const comms::AgentEvent& each : printed)
        there.emplace(each.agent, each.epoch, each.number);
    while (std::cout) {
        throwIfInterrupted();
        for (const comms::AgentEvent& each : arrivals.take(interruptSlice)) {
            if (there.contains({each.agent, each.epoch, each.number})) continue;
            if (span.has(each) && printer.shows(each, options.prefix)) printer.line(each);
        }
    }
}

}  // namespace

Exit showEvents(const EventOptions& options) {
    checkPrefix(options.prefix);
    const EventPrinter printer{options};
    const TimeSpan span = spanOf(options);
    Arrivals arrivals;
    Live live{options.network};
    live.listen([&](const comms::AgentEvent& event) { arrivals.push(event); });
    live.waitForAll(options.prefix);
    if (options.beforeFault) return showBeforeFault(live, arrivals, options, printer, span.until);
    KeptPast past{live};
    common::AgentEvents events = arrived(live, arrivals);
    common::sortByTime(events);
    if (options.since) {
        events = common::merged(past.ask(options.prefix, span.from, span.until), std::move(events));
        past.printNotes(span.from, printer.kinds());
    }
    std::erase_if(events, [&](const comms::AgentEvent& event) {
        return !span.has(event) || !printer.shows(event, options.prefix);
    });
    if (events.empty() && !options.follow) live.failIfNothingIsAt(options.prefix);
    const Exit exit = !options.since || past.complete() ? Yes : NotFound;
    if (options.json && !options.follow) {
        Json list = Json::array();
        for (const comms::AgentEvent& each : events) list.push_back(eventJson(each));
        print(list);
        return exit;
    }
    printer.head();
    for (const comms::AgentEvent& each : events) printer.line(each);
    if (options.follow) follow(arrivals, options, printer, span, events);
    return exit;
}

}  // namespace cortex::cli
