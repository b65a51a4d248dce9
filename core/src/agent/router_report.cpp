// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/cell.hpp"
#include "cortex/core/record.hpp"

#include "agent/router.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace cortex {
namespace {

constexpr std::string_view shortened = "…";

// Whether a tool's name, "cortex@desk.4711-5e1f0a", says its host already. Of a long one it has
// only the beginning.
bool saysHost(const Sender& sender) {
    const std::string_view name = sender.nameText(), host = sender.host.data();
    const std::size_t begin = name.find('@'), end = name.rfind('.');
    if (begin == std::string_view::npos || end == std::string_view::npos || end < begin)
        return false;
    const std::string_view said = name.substr(begin + 1, end - begin - 1);
    const bool isWhole = name.size() < sender.name.size() - 1;
    return isWhole ? said == host : !said.empty() && host.starts_with(said);
}

EventText senderText(const OutsideCommand& command) {
    EventText text{command.sender.nameText()};
    const std::string_view host = command.sender.host.data();
    if (!host.empty() && !saysHost(command.sender)) text << "@" << host;
    if (command.onBehalfOf.front() != '\0') text << " for " << command.onBehalfOf.data();
    return text;
}

// "Done", "Rejected (Range), speed is above 1 rad/s".
EventText outcomeText(const AnswerHead& answer) {
    EventText text{name(answer.outcome)};
    if (answer.reason != Reason::None) text << " (" << name(answer.reason) << ")";
    if (!answer.why.view().empty()) text << ", " << answer.why.view();
    return text;
}

EventText latencyText(const AnswerHead& answer) {
    if (answer.latencyCycles == 0) return " in the same cycle";
    return EventText{" in "} << answer.latencyCycles
                             << (answer.latencyCycles == 1 ? " cycle" : " cycles");
}

// Arguments give way to what became of the command, but for their beginning.
void addArguments(EventText& text, std::string_view arguments, std::size_t behind) {
    constexpr std::size_t least = 20;
    const std::size_t all = text.view().size() + behind;
    const std::size_t left = all < EventText::capacity ? EventText::capacity - all : 0;
    const std::size_t room = std::max(left, least);
    if (arguments.size() <= room) {
        text << arguments;
        return;
    }
    const std::size_t fitting = fittingLength(arguments, room - shortened.size());
    text << arguments.substr(0, fitting) << shortened;
}

}  // namespace

// For report().
OutsideCommand Router::messageOf(const OutsideEntry& entry) const {
    OutsideCommand message;
    message.sender = entry.sender;
    message.onBehalfOf = entry.onBehalfOf;
    message.simplex = entry.simplex;
    message.command = entry.command;
    message.size = runtime_.commands(entry.simplex).entries[entry.command].request.size;
    message.request = entry.request;
    return message;
}

EventKind Router::kindOf(const OutsideCommand& command, bool executed) const {
    if (!executed) return EventKind::Refusal;
    const bool here = command.simplex < structure_.simplexes.size() &&
                      command.command < runtime_.commands(command.simplex).entries.size();
    return here && isControl(command.simplex, command.command) ? EventKind::Control
                                                               : EventKind::Command;
}

// "operator@desk for alice: zero(speed=0.5): Done in 2 cycles". Renewals that succeed would drown
// the rest. Who sent which command and its outcome stand in every event, as far as 150 bytes go.
void Router::report(const OutsideCommand& command, const AnswerHead& answer) {
    if (answer.outcome == Outcome::Done && isRenewal(command.simplex, command.command)) return;
    EventText text = senderText(command);
    text << ": ";
    const EventText outcome = outcomeText(answer);
    const bool here = command.simplex < structure_.simplexes.size();
    if (here && command.command < runtime_.commands(command.simplex).entries.size()) {
        constexpr std::string_view closed = "): ";
        const CommandTable& table = runtime_.commands(command.simplex);
        const CommandTable::Entry& entry = table.entries[command.command];
        EventText arguments;
        if (command.size == entry.request.size) {
            describeRecord(table, command.command, command.request, arguments);
        }
        text << entry.name << "(";
        addArguments(text, arguments.view(), closed.size() + outcome.view().size());
        text << closed;
    }
    text << outcome.view();
    const EventText latency = latencyText(answer);
    if (text.view().size() + latency.view().size() <= EventText::capacity) text << latency.view();
    const bool executed = answer.outcome != Outcome::Rejected &&
                          answer.outcome != Outcome::MailboxFull &&
                          answer.outcome != Outcome::Expired;
    event(answer.outcome == Outcome::Done ? Severity::Info : Severity::Warning,
          kindOf(command, executed), here ? command.simplex : noSimplex, text);
}

}  // namespace cortex
