// SPDX-License-Identifier: Apache-2.0
#include "model/event_row.hpp"

#include "cortex/core/command_sentence.hpp"
#include "cortex/core/event.hpp"

#include "model/event_key.hpp"
#include "model/plain_text.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <utility>

namespace cortex::gui {

namespace {

constexpr std::int64_t foldsFor = 10'000'000'000;  // ns without another one

constexpr std::array unfoldedKinds{EventKind::Fault, EventKind::StateChange, EventKind::Command,
                                   EventKind::Control, EventKind::Loss};

}  // namespace

std::string saidText(const comms::AgentEvent& event) {
    return tellsOfCommand(event.kind) ? personFirst(event.text) : event.text;
}

EventRow::EventRow(comms::AgentEvent first) : event{std::move(first)}, kept{isKept(event)} {
    if (!mayFold()) return;
    NumberedText text = numberedText(saidText(event));
    words = std::move(text.words);
    for (const std::string& each : text.numbers) numbers.emplace_back(each);
}

EventRow EventRow::gap(const comms::AgentEvent& last, std::uint64_t missing) {
    comms::AgentEvent event;
    event.agent = last.agent;
    event.epoch = last.epoch;
    event.number = last.number;
    event.cycle = last.cycle;
    event.wallClock = last.wallClock;
    event.severity = Severity::Warning;
    event.kind = missingKind;
    event.text = QCoreApplication::translate("EventRow", "%n events of %1 did not come", nullptr,
                                             static_cast<int>(missing))
                     .arg(plainText(last.agent))
                     .toStdString();
    EventRow row{std::move(event)};
    row.missing = missing;
    return row;
}

bool EventRow::mayFold() const {
    return !isGap() && event.severity != Severity::Error &&
           std::ranges::none_of(unfoldedKinds,
                                [&](EventKind each) { return event.kind == name(each); });
}

bool EventRow::isFault() const {
    return !isGap() && (event.severity == Severity::Error || event.kind == name(EventKind::Fault));
}

bool EventRow::isRoutine() const {
    if (event.kind != name(EventKind::Command) || event.severity != Severity::Info) return false;
    const auto sentence = commandSentence(event.text);
    return sentence && sentence->command == "jog";
}

std::string EventRow::key() const {
    return event.agent + '\n' + event.path + '\n' + event.kind + '\n' + name(event.severity) +
           '\n' + words;
}

bool EventRow::takes(const comms::AgentEvent& next) const {
    return next.epoch == event.epoch && next.wallClock - newest().wallClock <= foldsFor;
}

void EventRow::take(comms::AgentEvent next) {
    ++times;
    const NumberedText text = numberedText(saidText(next));
    for (std::size_t i = 0; i < std::min(numbers.size(), text.numbers.size()); ++i) {
        numbers[i].take(text.numbers[i]);
    }
    others.push_back(std::move(next));
    if (others.size() > mostOthers) others.pop_front();
}

QString EventRow::text() const {
    return times == 1 ? plainText(saidText(event)) : foldedText(words, numbers);
}

}  // namespace cortex::gui
