// SPDX-License-Identifier: Apache-2.0
#include "model/event_query.hpp"

#include "cortex/core/nearest_names.hpp"
#include "cortex/core/path.hpp"

#include "model/query.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <utility>

namespace cortex::explorer {

namespace {

constexpr std::array eventFields{"agent", "in", "kind", "path", "severity", "text"};

bool has(const std::string& text, const QString& part) {
    return QString::fromStdString(text).contains(part, Qt::CaseInsensitive);
}

bool is(const std::string& text, const QString& value) {
    return QString::fromStdString(text).compare(value, Qt::CaseInsensitive) == 0;
}

}  // namespace

EventQuery::EventQuery(const QString& text) : text_{text.trimmed()} {
    std::vector<Term> terms;
    for (const QString& each : queryWords(text)) {
        if (each == QLatin1String{"or"}) {
            if (!terms.empty()) alternatives_.push_back(std::exchange(terms, {}));
        } else {
            add(terms, each);
        }
    }
    if (!terms.empty()) alternatives_.push_back(std::move(terms));
}

void EventQuery::add(std::vector<Term>& terms, QString word) {
    Term term;
    if (word.size() > 1 && word.startsWith('-')) {
        term.no = true;
        word.remove(0, 1);
    }
    const int colon = word.indexOf(':');
    term.field = colon > 0 ? word.left(colon).toLower() : QString{};
    term.value = colon > 0 ? word.mid(colon + 1) : word;
    const bool known = term.field.isEmpty() || std::ranges::any_of(eventFields, [&](auto each) {
                           return term.field == QLatin1String{each};
                       });
    if (!known) {
        const std::vector<std::string> names{eventFields.begin(), eventFields.end()};
        trouble_ = QCoreApplication::translate("Query", "\"%1:\" is no field. %2")
                       .arg(term.field,
                            QString::fromStdString(nearestNames(term.field.toStdString(), names)));
    }
    terms.push_back(std::move(term));
}

bool EventQuery::matches(const comms::AgentEvent& event) const {
    if (alternatives_.empty()) return true;
    return std::ranges::any_of(alternatives_, [&](const std::vector<Term>& terms) {
        return std::ranges::all_of(terms,
                                   [&](const Term& term) { return holds(term, event) != term.no; });
    });
}

bool EventQuery::holds(const Term& term, const comms::AgentEvent& event) {
    const QString& field = term.field;
    if (field.isEmpty()) {
        return has(event.path, term.value) || has(event.text, term.value) ||
               has(event.agent, term.value) || has(event.kind, term.value);
    }
    if (field == QLatin1String{"in"}) return isAtOrBelow(event.path, term.value.toStdString());
    if (field == QLatin1String{"path"}) return has(event.path, term.value);
    if (field == QLatin1String{"text"}) return has(event.text, term.value);
    if (field == QLatin1String{"agent"}) return is(event.agent, term.value);
    if (field == QLatin1String{"kind"}) return is(event.kind, term.value);
    return field == QLatin1String{"severity"} && is(name(event.severity), term.value);
}

}  // namespace cortex::explorer
