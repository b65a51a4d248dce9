// SPDX-License-Identifier: Apache-2.0
#include "model/wrong_rows.hpp"

#include "cortex/core/labelled_value.hpp"

#include "model/fault_text.hpp"
#include "model/gone_text.hpp"
#include "model/plain_text.hpp"
#include "model/value_text.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

namespace cortex::gui {

namespace {

QString ofWrong(const char* text) { return QCoreApplication::translate("Overview", text); }

// "position 2.1 rad, above 2.0944": of an array the first element that is.
QString outsideItem(const DataItem& item, const Value& value, std::optional<Shape>& shape) {
    const std::size_t length = std::visit([](const auto& each) { return each.size(); }, value);
    const auto lower = numberOf(item.min), upper = numberOf(item.max);
    shape = Shape::NoLabel;
    std::size_t element = 0;
    for (; element + 1 < length; ++element) {
        const auto number = numberOf(value, element);
        if (number && ((lower && *number < *lower) || (upper && *number > *upper))) break;
    }
    const auto number = numberOf(value, element);
    QString name = QString::fromStdString(item.name);
    if (item.length > 1) name += QStringLiteral("[%1]").arg(element);
    const QString unit = item.unit.empty() ? QString{} : ' ' + unitText(item.unit);
    QString shown = name + ' ' + elementText(item, value, element) + unit;
    if (number && upper && *number > *upper) {
        shape = Shape::AboveLimit;
        return ofWrong("%1, above %2").arg(shown, numberText(item, *upper));
    }
    if (number && lower && *number < *lower) {
        shape = Shape::BelowLimit;
        return ofWrong("%1, below %2").arg(shown, numberText(item, *lower));
    }
    return shown;  // "7 (no label)"
}

// The first item whose value is outside, and how many more there are.
void tellOutside(const AgentFrame& agent, std::uint32_t simplex, OverviewRow& row) {
    QString text;
    int more = 0;
    for (const ItemLayout& each : agent.structure->simplexes[simplex].layout->items) {
        const auto value = agent.value(simplex, each);
        if (!value || outsideText(*each.item, *value).empty()) continue;
        if (!row.item.empty() && ++more > 0) continue;
        row.item = each.item->name;
        text = outsideItem(*each.item, *value, row.shape);
    }
    row.cells << (more == 0 ? text : ofWrong("%1; and %2 more").arg(text, QString::number(more)));
}

QString faultWords(const Frame& frame, Place place, const StateTimes& times, bool isLost) {
    const QString code = faultCode(frame.agents[place.agent], place.simplex);
    const QString text = faultText(frame, place, times).text;
    const QString head = ofWrong("Fault%1").arg(code);
    const QString fault = text.isEmpty() ? head : ofWrong("%1: %2").arg(head, text);
    return isLost ? ofWrong("%1; its values are lost").arg(fault) : fault;
}

// They are in the order of their places.
bool isAmong(const std::vector<Abnormal::Found>& all, const Abnormal::Found& found) {
    const auto order = [](const Abnormal::Found& each) {
        return std::pair{each.place.agent, each.place.simplex};
    };
    return std::ranges::binary_search(all, order(found), {}, order);
}

QString lossWords(const Frame& frame, Place place) {
    const AgentFrame& agent = frame.agents[place.agent];
    if (agent.lost())
        return ofWrong("Agent %1 is lost for %2, with all that it has")
            .arg(plainText(agent.status.name), wholeAgeText(agent.status.age));
    QString gone = goneInputText(frame, place);
    if (!gone.isEmpty()) return gone;
    const auto age = agent.age(place.simplex);
    return age ? ofWrong("Its values are lost for %1").arg(wholeAgeText(*age))
               : ofWrong("Its values are lost");
}

// A path in Fault whose values are lost as well has one row, which says both.
std::vector<Abnormal::Found> rowsOf(const Abnormal& abnormal, Abnormal::Kind kind) {
    auto all = abnormal.found(kind);
    if (kind == Abnormal::Lost)
        std::erase_if(all, [&](const Abnormal::Found& each) {
            return isAmong(abnormal.found(Abnormal::Fault), each);
        });
    return all;
}

// Frame and abnormal are of the same moment, unless somebody mixes them.
bool isThere(const Frame& frame, const Abnormal::Found& found) {
    if (found.place.agent >= frame.agents.size()) return false;
    const auto& structure = frame.agents[found.place.agent].structure;
    return structure && found.place.simplex < structure->simplexes.size() &&
           structure->simplexes[found.place.simplex].path == found.path;
}

OverviewRow wrongRow(const Frame& frame, const Abnormal& abnormal, Abnormal::Kind kind,
                     const Abnormal::Found& found, const StateTimes& times) {
    const AgentFrame& agent = frame.agents[found.place.agent];
    OverviewRow row{std::to_string(kind) + '\n' + agent.status.name + '\n' + found.path,
                    found.path,
                    kind == Abnormal::Fault ? Shape::Fault : Shape::Lost,
                    {plainText(found.path)}};
    if (kind == Abnormal::Fault)
        row.cells << faultWords(frame, found.place, times,
                                isAmong(abnormal.found(Abnormal::Lost), found));
    if (kind == Abnormal::Outside) tellOutside(agent, found.place.simplex, row);
    if (kind == Abnormal::Lost) row.cells << lossWords(frame, found.place);
    if (frame.find(found.path) == found.place) return row;
    // Another agent has the path as well, and is what is opened.
    row.item.clear();
    row.cells.back() = ofWrong("Of %1: %2").arg(plainText(agent.status.name), row.cells.back());
    return row;
}

// Paths that two agents have, both of which are heard.
std::vector<const comms::Contested*> doubled(const Frame& frame) {
    const auto isHeard = [&](const std::string& name) {
        return std::ranges::any_of(frame.agents, [&](const AgentFrame& agent) {
            return agent.status.name == name && !agent.lost();
        });
    };
    std::vector<const comms::Contested*> found;
    for (const comms::Contested& each : frame.contested)
        if (std::ranges::count_if(each.agents, isHeard) > 1) found.push_back(&each);
    return found;
}

// So many of them, and the row that says how many there are more.
template <class Found, class Row>
void addSome(OverviewRows& rows, const std::vector<Found>& all, const std::string& kind,
             const std::string& next, Row row) {
    for (std::size_t i = 0; i < std::min(all.size(), mostWrongOfAKind); ++i) row(all[i]);
    if (all.size() <= mostWrongOfAKind) return;
    const QString more = countText(all.size() - mostWrongOfAKind);
    rows.push_back({kind + "\nmore",
                    next,
                    std::nullopt,
                    {ofWrong("and %1 more").arg(more), ofWrong("F8 goes from one to the next")}});
}

}  // namespace

OverviewRows wrongRows(const Frame& frame, const Abnormal& abnormal, const StateTimes& times) {
    OverviewRows rows;
    for (const auto kind : {Abnormal::Fault, Abnormal::Outside, Abnormal::Lost}) {
        const auto all = rowsOf(abnormal, kind);
        const bool many = all.size() > mostWrongOfAKind;
        addSome(rows, all, std::to_string(kind), many ? all[mostWrongOfAKind].path : "",
                [&](const Abnormal::Found& each) {
                    if (isThere(frame, each))
                        rows.push_back(wrongRow(frame, abnormal, kind, each, times));
                });
    }
    const auto twice = doubled(frame);
    const bool many = twice.size() > mostWrongOfAKind;
    addSome(rows, twice, "twice", many ? twice[mostWrongOfAKind]->path : "",
            [&](const comms::Contested* each) {
                rows.push_back({"twice\n" + each->path,
                                each->path,
                                Shape::Contradiction,
                                {plainText(each->path), plainText(each->text)}});
            });
    return rows;
}

QString wrongIsOver(const Frame& frame, const std::string& key) {
    const bool silent = std::ranges::any_of(frame.agents, [&](const AgentFrame& agent) {
        return agent.isSilent() && key.find('\n' + agent.status.name + '\n') != std::string::npos;
    });
    return silent ? ofWrong("Its agent is not heard.") : ofWrong("It is over.");
}

QString wrongCount(const Frame& frame, const Abnormal& abnormal) {
    QStringList parts;
    const auto add = [&](std::size_t count, const char* text) {
        if (count > 0) parts << ofWrong(text).arg(countText(count));
    };
    const auto of = [&](Abnormal::Kind kind) {
        return static_cast<std::size_t>(abnormal.count(kind));
    };
    add(of(Abnormal::Fault), QT_TRANSLATE_NOOP("Overview", "%1 in Fault"));
    add(of(Abnormal::Outside), QT_TRANSLATE_NOOP("Overview", "%1 outside limits"));
    add(of(Abnormal::Lost), QT_TRANSLATE_NOOP("Overview", "%1 lost"));
    add(doubled(frame).size(), QT_TRANSLATE_NOOP("Overview", "%1 claimed twice"));
    return parts.join(QStringLiteral(", "));
}

}  // namespace cortex::gui
