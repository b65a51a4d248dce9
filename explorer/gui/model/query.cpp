// SPDX-License-Identifier: Apache-2.0
#include "model/query.hpp"

#include "cortex/core/nearest_names.hpp"
#include "cortex/core/path.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <array>

namespace cortex::explorer {

namespace {

constexpr std::array fields{"agent", "has", "in", "is", "path", "quality", "role", "state", "type"};
constexpr std::array flags{"fault", "lost", "outside"};

bool contains(const std::string& text, const QString& part) {
    return QString::fromStdString(text).contains(part, Qt::CaseInsensitive);
}

bool equal(std::string_view text, const QString& value) {
    return QString::fromUtf8(text.data(), static_cast<int>(text.size()))
               .compare(value, Qt::CaseInsensitive) == 0;
}

bool isA(const Type& type, const QString& name) {
    return equal(type.name, name) ||
           std::ranges::any_of(type.ancestors, [&](const auto& each) { return equal(each, name); });
}

bool has(const Type& type, const QString& name) {
    const auto named = [&](const auto& each) { return equal(each.name, name); };
    return std::ranges::any_of(type.data, named) || std::ranges::any_of(type.commands, named);
}

}  // namespace

QStringList queryWords(const QString& text) {
    QStringList result;
    QString word;
    bool quoted = false;
    for (const QChar c : text + ' ') {
        if (c == '"') {
            quoted = !quoted;
        } else if (c.isSpace() && !quoted) {
            if (!word.isEmpty()) result << word;
            word.clear();
        } else {
            word += c;
        }
    }
    if (!word.isEmpty()) result << word;
    return result;
}

Query::Query(const QString& text) {
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

void Query::add(std::vector<Term>& terms, QString text) {
    Term term;
    if (text.size() > 1 && text.startsWith('-')) {
        term.no = true;
        text.remove(0, 1);
    }
    const int colon = text.indexOf(':');
    term.condition = conditionFrom(text, trouble_);
    if (term.condition) {
        terms.push_back(std::move(term));
        return;
    }
    if (colon < 0) {
        const bool flag = std::ranges::any_of(flags, [&](auto each) { return equal(each, text); });
        term.field = flag ? text.toLower() : QString{};
        term.value = text;
    } else {
        term.field = text.left(colon).toLower();
        term.value = text.mid(colon + 1);
        if (std::ranges::none_of(fields, [&](auto each) { return equal(each, term.field); })) {
            const std::vector<std::string> names{fields.begin(), fields.end()};
            const std::string nearest = nearestNames(term.field.toStdString(), names);
            trouble_ = QCoreApplication::translate("Query", "\"%1:\" is no field. %2")
                           .arg(term.field, QString::fromStdString(nearest));
        }
    }
    terms.push_back(std::move(term));
}

bool Query::matches(const Frame& frame, Place place) const {
    if (alternatives_.empty()) return true;
    return std::ranges::any_of(alternatives_, [&](const std::vector<Term>& terms) {
        return std::ranges::all_of(
            terms, [&](const Term& term) { return holds(term, frame, place) != term.no; });
    });
}

bool Query::holds(const Term& term, const Frame& frame, Place place) {
    const AgentFrame& agent = frame.agents[place.agent];
    if (term.condition) return explorer::holds(*term.condition, agent, place.simplex);
    const SimplexInfo& info = frame.info(place);
    const Type& type = frame.type(place);
    const QString& field = term.field;
    if (field.isEmpty()) {
        return contains(info.path, term.value) || contains(type.name, term.value) ||
               contains(type.description, term.value);
    }
    if (field == QLatin1String{"is"}) return isA(type, term.value);
    if (field == QLatin1String{"type"}) return equal(type.name, term.value);
    if (field == QLatin1String{"path"}) return contains(info.path, term.value);
    if (field == QLatin1String{"in"}) return isAtOrBelow(info.path, term.value.toStdString());
    if (field == QLatin1String{"agent"}) return equal(agent.status.name, term.value);
    if (field == QLatin1String{"has"}) return has(type, term.value);
    if (field == QLatin1String{"role"}) return equal(name(info.role), term.value);
    if (field == QLatin1String{"quality"})
        return equal(name(agent.quality(place.simplex)), term.value);
    if (field == QLatin1String{"lost"}) return agent.quality(place.simplex) == Quality::Lost;
    if (field == QLatin1String{"outside"}) return isOutside(agent, place.simplex);
    const auto state = agent.state(place.simplex);
    if (field == QLatin1String{"fault"}) return state == State::Fault;
    return field == QLatin1String{"state"} && state && equal(name(*state), term.value);
}

}  // namespace cortex::explorer
