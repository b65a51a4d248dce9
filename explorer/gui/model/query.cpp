// SPDX-License-Identifier: Apache-2.0
#include "model/query.hpp"

#include "cortex/core/nearest_names.hpp"
#include "cortex/core/path.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <set>

namespace cortex::gui {

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

// Blanks between quotes do not part words.
QStringList wordsOf(const QString& text) {
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

bool namesType(const QString& field) {
    return field == QLatin1String{"is"} || field == QLatin1String{"type"};
}

bool isKnown(const QString& type, const Frame& frame) {
    return std::ranges::any_of(frame.agents, [&](const AgentFrame& agent) {
        return agent.structure && agent.structure->types &&
               std::ranges::any_of(agent.structure->types->types(),
                                   [&](auto& each) { return equal(each.first, type); });
    });
}

QString unknownType(const QString& name, const Frame& frame) {
    std::set<std::string> known;
    for (const AgentFrame& agent : frame.agents) {
        if (!agent.structure || !agent.structure->types) continue;
        for (const auto& each : agent.structure->types->types()) known.insert(each.first);
    }
    const std::vector<std::string> names{known.begin(), known.end()};
    const std::string near = nearestNames(name.toStdString(), names);
    const QString text =
        QCoreApplication::translate("Query", "No agent has a type \"%1\"").arg(name);
    return near.empty() ? text + '.' : text + QStringLiteral("; ") + QString::fromStdString(near);
}

// Of the fields whose values are known by name; empty: it is one, or it is another field.
QString unknownValue(const QString& field, const QString& value) {
    std::vector<std::string> names;
    const auto add = [&](auto last) {
        using Named = decltype(last);
        for (int i = 0; i <= static_cast<int>(last); ++i)
            names.emplace_back(name(static_cast<Named>(i)));
    };
    if (field == QLatin1String{"state"}) add(State::Fault);
    if (field == QLatin1String{"quality"}) add(Quality::Lost);
    if (field == QLatin1String{"role"}) add(Role::Active);
    const auto is = [&](const std::string& each) { return equal(each, value); };
    if (names.empty() || value.isEmpty() || std::ranges::any_of(names, is)) return {};
    return QCoreApplication::translate("Query", "\"%1:%2\" is no %1. %3")
        .arg(field, value, QString::fromStdString(nearestNames(value.toStdString(), names)));
}

}  // namespace

std::vector<QStringList> alternativesOf(const QString& text) {
    std::vector<QStringList> result(1);
    for (const QString& each : wordsOf(text)) {
        if (each != QLatin1String{"or"}) {
            result.back() << each;
        } else if (!result.back().isEmpty()) {
            result.emplace_back();
        }
    }
    if (result.back().isEmpty()) result.pop_back();
    return result;
}

bool takeNot(QString& word) {
    const bool no = word.size() > 1 && word.startsWith('-');
    if (no) word.remove(0, 1);
    return no;
}

QString unknownField(const QString& field, std::span<const char* const> known) {
    const std::vector<std::string> names{known.begin(), known.end()};
    return QCoreApplication::translate("Query", "\"%1:\" is no field. %2")
        .arg(field, QString::fromStdString(nearestNames(field.toStdString(), names)));
}

Query::Query(const QString& text) {
    for (const QStringList& words : alternativesOf(text)) {
        auto& terms = alternatives_.emplace_back();
        for (const QString& each : words) terms.push_back(termFrom(each));
    }
}

Query::Term Query::termFrom(QString text) {
    Term term;
    term.no = takeNot(text);
    const int colon = text.indexOf(':');
    term.condition = conditionFrom(text, trouble_);
    if (term.condition) return term;
    if (colon < 0) {
        const bool flag = std::ranges::any_of(flags, [&](auto each) { return equal(each, text); });
        term.field = flag ? text.toLower() : QString{};
        term.value = text;
    } else {
        term.field = text.left(colon).toLower();
        term.value = text.mid(colon + 1);
        if (std::ranges::none_of(fields, [&](auto each) { return equal(each, term.field); })) {
            trouble_ = unknownField(term.field, fields);
        }
        const QString wrong = unknownValue(term.field, term.value);
        if (!wrong.isEmpty()) trouble_ = wrong;
    }
    return term;
}

// Types may still come while not everything is there.
QString Query::troubleIn(const Frame& frame) const {
    if (!trouble_.isEmpty()) return trouble_;
    for (const auto& terms : alternatives_) {
        for (const Term& each : terms) {
            if (each.condition) {
                const QString wrong = unitTrouble(*each.condition, frame);
                if (!wrong.isEmpty()) return wrong;
            }
            if (frame.complete && namesType(each.field) && !isKnown(each.value, frame))
                return unknownType(each.value, frame);
        }
    }
    return {};
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
    if (term.condition) return gui::holds(*term.condition, agent, place.simplex);
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
    if (field == QLatin1String{"lost"}) {  // as the counter of losses
        return agent.quality(place.simplex) == Quality::Lost && frame.excuse(place) == Excuse::None;
    }
    if (field == QLatin1String{"outside"}) return isOutside(agent, place.simplex);
    const auto state = agent.state(place.simplex);
    if (field == QLatin1String{"fault"}) return state == State::Fault;
    return field == QLatin1String{"state"} && state && equal(name(*state), term.value);
}

}  // namespace cortex::gui
