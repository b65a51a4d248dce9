// SPDX-License-Identifier: Apache-2.0
#include "model/fault_history.hpp"

#include "cortex/core/event.hpp"

#include "common/past_events.hpp"
#include "model/event_key.hpp"
#include "model/plain_text.hpp"
#include "model/shown_time.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace cortex::gui {

namespace {

QString inHistory(const char* text) { return QCoreApplication::translate("FaultHistory", text); }

std::string textOf(const QJsonObject& saved, const char* name) {
    return saved[QLatin1String{name}].toString().toStdString();
}

// As a text: a number of JSON does not hold all of it.
std::int64_t wholeOf(const QJsonObject& saved, const char* name) {
    return saved[QLatin1String{name}].toString().toLongLong();
}

}  // namespace

bool FaultHistory::isOfIt(const comms::AgentEvent& event) const {
    return event.wallClock >= begin() && event.wallClock <= fault_.wallClock &&
           eventKeyOf(event) != eventKeyOf(fault_);
}

void FaultHistory::show(const EventModel& events, std::vector<comms::AgentEvent> kept) {
    std::erase_if(kept, [this](const auto& each) { return !isOfIt(each); });
    for (int i = 0; i < events.rowCount(); ++i) {
        const EventRow& row = events.at(i);
        if (row.isGap()) continue;
        if (isOfIt(row.event)) kept.push_back(row.event);
        std::ranges::copy_if(row.others, std::back_inserter(kept),
                             [this](const auto& each) { return isOfIt(each); });
    }
    std::ranges::sort(kept, {}, eventKeyOf);
    const auto doubles = std::ranges::unique(kept, {}, eventKeyOf);
    kept.erase(doubles.begin(), doubles.end());
    common::sortByTime(kept);
    fold(std::move(kept));
}

// The same again and again is one row here, too.
void FaultHistory::fold(std::vector<comms::AgentEvent> events) {
    rows_.clear();
    std::map<std::string, std::size_t> open;
    for (comms::AgentEvent& each : events) {
        EventRow row{std::move(each)};
        if (row.mayFold()) {
            const auto [found, isNew] = open.try_emplace(row.key(), rows_.size());
            if (!isNew && rows_[found->second].takes(row.event)) {
                rows_[found->second].take(std::move(row.event));
                continue;
            }
            found->second = rows_.size();
        }
        rows_.push_back(std::move(row));
    }
    left_ = rows_.size() > most - 1 ? rows_.size() - (most - 1) : 0;
    rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(left_));
    rows_.emplace_back(fault_);
}

QString FaultHistory::secondsOf(const EventRow& row) const {
    QString text = QString::fromStdString(common::secondsBefore(row.event, fault_));
    return text.startsWith('-') ? QChar{0x2212} + text.mid(1) : text;
}

QString FaultHistory::title() const {
    const bool faults = fault_.kind == name(EventKind::Fault);
    return (faults ? inHistory("Before the fault of %1 at %2")
                   : inHistory("Before the error of %1 at %2"))
        .arg(plainText(fault_.path.empty() ? fault_.agent : fault_.path),
             timeAndZone(fault_.wallClock, "HH:mm:ss"));
}

QJsonObject FaultHistory::saved() const {
    return {{QStringLiteral("agent"), QString::fromStdString(fault_.agent)},
            {QStringLiteral("epoch"), QString::number(fault_.epoch)},
            {QStringLiteral("number"), QString::number(fault_.number)},
            {QStringLiteral("time"), QString::number(fault_.wallClock)},
            {QStringLiteral("kind"), QString::fromStdString(fault_.kind)},
            {QStringLiteral("path"), QString::fromStdString(fault_.path)},
            {QStringLiteral("text"), QString::fromStdString(fault_.text)}};
}

comms::AgentEvent FaultHistory::restored(const QJsonObject& saved) {
    comms::AgentEvent event;
    event.agent = textOf(saved, "agent");
    event.epoch = wholeOf(saved, "epoch");
    event.number = saved[QLatin1String{"number"}].toString().toULongLong();
    event.wallClock = wholeOf(saved, "time");
    event.severity = Severity::Error;
    event.kind = textOf(saved, "kind");
    event.path = textOf(saved, "path");
    event.text = textOf(saved, "text");
    return event;
}

}  // namespace cortex::gui
