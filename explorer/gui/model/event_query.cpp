// SPDX-License-Identifier: Apache-2.0
#include "model/event_query.hpp"

#include "cortex/core/event.hpp"
#include "cortex/core/nearest_names.hpp"
#include "cortex/core/path.hpp"

#include "model/query.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace cortex::gui {

namespace {

constexpr std::array eventFields{"agent", "in", "kind", "path", "severity", "text"};

bool has(const std::string& text, const QString& part) {
    return QString::fromStdString(text).contains(part, Qt::CaseInsensitive);
}

bool is(const std::string& text, const QString& value) {
    return QString::fromStdString(text).compare(value, Qt::CaseInsensitive) == 0;
}

// Agents of a later build may have it all the same.
QString unknownKind(const QString& kind) {
    std::vector<std::string> names;
    for (int i = 0; i <= static_cast<int>(EventKind::ValueChange); ++i)
        names.emplace_back(name(static_cast<EventKind>(i)));
    return QCoreApplication::translate("Query", "\"kind:%1\" is no kind. %2")
        .arg(kind, QString::fromStdString(nearestNames(kind.toStdString(), names)));
}

}  // namespace

EventQuery::EventQuery(const QString& text) : text_{text.trimmed()} {
    for (const QStringList& words : alternativesOf(text)) {
        auto& terms = alternatives_.emplace_back();
        for (const QString& each : words) terms.push_back(termFrom(each));
    }
}

EventQuery::Term EventQuery::termFrom(QString word) {
    Term term;
    term.no = takeNot(word);
    const int colon = word.indexOf(':');
    term.field = colon > 0 ? word.left(colon).toLower() : QString{};
    term.value = colon > 0 ? word.mid(colon + 1) : word;
    const bool known = term.field.isEmpty() || std::ranges::any_of(eventFields, [&](auto each) {
                           return term.field == QLatin1String{each};
                       });
    if (!known) trouble_ = unknownField(term.field, eventFields);
    if (term.field == QLatin1String{"kind"}) {
        term.value.replace('-', ' ');  // as the command line has it
        if (!eventKindFromName(term.value.toLower().toStdString()))
            trouble_ = unknownKind(term.value);
    }
    return term;
}

bool EventQuery::matches(const comms::AgentEvent& event) const {
    if (alternatives_.empty()) return true;
    return std::ranges::any_of(alternatives_, [&](const std::vector<Term>& terms) {
        return std::ranges::all_of(terms,
                                   [&](const Term& term) { return holds(term, event) != term.no; });
    });
}

bool EventQuery::namesJogs() const {
    const auto names = [](const Term& term) {
        const bool kind = term.field == QLatin1String{"kind"};
        const bool word = term.field.isEmpty() || term.field == QLatin1String{"text"};
        return !term.no && ((kind && is(name(EventKind::Command), term.value)) ||
                            (word && is("jog", term.value)));
    };
    return std::ranges::any_of(alternatives_, [&](const std::vector<Term>& terms) {
        return std::ranges::any_of(terms, names);
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

}  // namespace cortex::gui
