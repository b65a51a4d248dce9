// SPDX-License-Identifier: Apache-2.0
#include "model/event_details.hpp"

#include "cortex/core/command_sentence.hpp"
#include "cortex/core/event.hpp"

#include "common/kind_meaning.hpp"
#include "model/plain_text.hpp"
#include "model/shown_time.hpp"

#include <QCoreApplication>

namespace cortex::gui {

namespace {

QString detail(const char* text) { return QCoreApplication::translate("EventDetails", text); }

// "1,688 … 1,901"; one alone where both are the same.
QString fromTo(const QString& first, const QString& last) {
    return first == last ? first : QStringLiteral("%1 … %2").arg(first, last);
}

QString number(std::int64_t value) { return countText(static_cast<std::uint64_t>(value)); }

void addPart(EventDetails& details, const char* name, std::string_view text) {
    if (!text.empty()) details.emplace_back(detail(name), plainText(std::string{text}));
}

// Of an event that says what became of a command.
void addCommand(EventDetails& details, const comms::AgentEvent& event) {
    const auto sentence = tellsOfCommand(event.kind) ? commandSentence(event.text) : std::nullopt;
    if (!sentence) return;
    const SenderParts sender = senderParts(sentence->sender);
    addPart(details, "on behalf of", sender.person);
    addPart(details, "sender", sender.tool);
    std::string command{sentence->command};
    command.append("(").append(sentence->arguments);
    addPart(details, "command", command + (sentence->outcome.empty() ? "…" : ")"));
    addPart(details, "outcome", sentence->outcome);
    addPart(details, "latency", sentence->latency);
}

// "overflow: The loop of an agent did not keep its time: …".
QString kindText(const std::string& kind) {
    const std::string meaning{common::kindMeaning(kind)};
    return meaning.empty() ? plainText(kind)
                           : detail("%1: %2").arg(plainText(kind), detail(meaning.c_str()));
}

void addTimes(EventDetails& details, const EventRow& row) {
    const comms::AgentEvent &first = row.event, &last = row.newest();
    const QString time = timeAndZone(first.wallClock, "yyyy-MM-dd HH:mm:ss.zzz");
    details.emplace_back(row.times == 1 ? detail("time") : detail("first"), time);
    if (row.times == 1) return;
    details.emplace_back(detail("last"), timeAndZone(last.wallClock, "yyyy-MM-dd HH:mm:ss.zzz"));
    const double seconds = static_cast<double>(last.wallClock - first.wallClock) * 1e-9;
    QString times = detail("%1 in %2 s").arg(countText(row.times)).arg(seconds, 0, 'f', 1);
    if (seconds >= 0.1) {
        times += detail(", %1 a second").arg(static_cast<double>(row.times) / seconds, 0, 'f', 1);
    }
    details.emplace_back(detail("times"), times);
}

}  // namespace

EventDetails detailsOf(const EventRow& row) {
    const comms::AgentEvent &first = row.event, &last = row.newest();
    EventDetails details;
    if (!first.path.empty()) details.emplace_back(detail("path"), plainText(first.path));
    details.emplace_back(detail("agent"), plainText(first.agent));
    if (row.isGap()) {
        details.emplace_back(detail("number"), fromTo(countText(first.number + 1),
                                                      countText(first.number + row.missing)));
        details.emplace_back(detail("after"),
                             timeAndZone(first.wallClock, "yyyy-MM-dd HH:mm:ss.zzz"));
        return details;
    }
    details.emplace_back(detail("kind"), kindText(first.kind));
    if (first.number > 0) {  // otherwise the window's own
        details.emplace_back(detail("cycle"), fromTo(number(first.cycle), number(last.cycle)));
        details.emplace_back(detail("number"),
                             fromTo(countText(first.number), countText(last.number)));
    }
    addTimes(details, row);
    for (const NumberRange& each : row.numbers) {
        if (each.isOne()) continue;
        details.emplace_back(detail("value"),
                             detail("%1, last %2").arg(rangeText(each), plainText(each.last)));
    }
    addCommand(details, first);
    return details;
}

}  // namespace cortex::gui
