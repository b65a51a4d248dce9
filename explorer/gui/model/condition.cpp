// SPDX-License-Identifier: Apache-2.0
#include "model/condition.hpp"

#include "cortex/core/labelled_value.hpp"

#include "model/shown_units.hpp"
#include "model/value_text.hpp"

#include <QCoreApplication>
#include <QRegularExpression>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

namespace cortex::gui {

namespace {

using Is = Condition::Is;

constexpr std::array<std::pair<const char*, Is>, 6> operators{{{"<", Is::Less},
                                                               {"<=", Is::AtMost},
                                                               {">", Is::More},
                                                               {">=", Is::AtLeast},
                                                               {"=", Is::Equal},
                                                               {"!=", Is::Other}}};

constexpr double unitError = 1e-12;  // of a number, that a conversion may be wrong by

bool compare(const ExactNumber& value, Is is, const ExactNumber& wanted) {
    switch (is) {
        case Is::Less:
            return value < wanted;
        case Is::AtMost:
            return !(wanted < value);
        case Is::More:
            return wanted < value;
        case Is::AtLeast:
            return !(value < wanted);
        case Is::Equal:
            return value == wanted;
        case Is::Other:
            return !(value == wanted);
    }
    return false;
}

std::size_t elements(const Value& value) {
    return std::visit([](const auto& each) { return each.size(); }, value);
}

// How many of the written unit the own one is; none: they measure different things.
std::optional<double> ratioOf(const QString& written, const std::string& own) {
    if (written.isEmpty()) return 1;
    for (const std::string& each : unitsLike(own)) {
        if (written != QString::fromStdString(each) && written != unitText(each)) continue;
        return unitSize(own).size / unitSize(each).size;
    }
    return std::nullopt;
}

bool holdsFor(const ExactNumber& value, const Condition& condition, double ratio) {
    if (ratio == 1) return compare(value, condition.is, *condition.number);
    const ExactNumber wanted{condition.number->near() / ratio};
    const bool same = std::abs(value.near() - wanted.near()) <= unitError * std::abs(wanted.near());
    return compare(same ? wanted : value, condition.is, wanted);
}

bool asksForEqual(const Condition& condition) {
    return condition.is == Is::Equal || condition.is == Is::Other;
}

bool isNumeric(const DataItem& item) {
    return (item.kind == Kind::Int || item.kind == Kind::Float) && item.labels.empty();
}

// "AtLimit" of "AtLimit (3)".
bool reads(const QString& shown, const QString& word) {
    return shown.compare(word, Qt::CaseInsensitive) == 0 ||
           shown.startsWith(word + QStringLiteral(" ("), Qt::CaseInsensitive);
}

}  // namespace

std::optional<Condition> conditionFrom(const QString& text, QString& trouble) {
    static const QRegularExpression shape{
        QStringLiteral(R"(^([A-Za-z_][A-Za-z0-9_]*)(<=|>=|!=|<|>|=)(.*)$)")};
    static const QRegularExpression quantity{
        QStringLiteral(R"(^([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*)$)")};
    const auto found = shape.match(text);
    if (!found.hasMatch()) return std::nullopt;
    Condition condition;
    condition.item = found.captured(1);
    const QString sign = found.captured(2), right = found.captured(3);
    condition.is = std::ranges::find(operators, sign, [](const auto& each) {
                       return QLatin1String{each.first};
                   })->second;
    const auto number = quantity.match(right);
    if (number.hasMatch()) {
        const auto whole = toInt(number.captured(1).toStdString());
        condition.number = whole ? ExactNumber{*whole} : ExactNumber{number.captured(1).toDouble()};
        condition.unit = number.captured(2);
    } else if (right.isEmpty() || (condition.is != Is::Equal && condition.is != Is::Other)) {
        trouble = QCoreApplication::translate("Query", "After \"%1\" a number is needed.")
                      .arg(condition.item + sign);
    }
    condition.word = right;
    return condition;
}

QString unitTrouble(const Condition& condition, const Frame& frame) {
    if (condition.unit.isEmpty()) return {};
    const DataItem* other = nullptr;
    for (const AgentFrame& agent : frame.agents) {
        if (!agent.structure) continue;
        for (const auto& layout : agent.structure->layouts) {
            const ItemLayout* found = layout->find(condition.item.toStdString());
            if (found == nullptr) continue;
            const bool byWord = asksForEqual(condition) && !isNumeric(*found->item);
            if (byWord || ratioOf(condition.unit, found->item->unit)) return {};
            other = found->item;
        }
    }
    if (other == nullptr) return {};
    const QString unit = unitText(other->unit);
    return unit.isEmpty()
               ? QCoreApplication::translate("Query", "\"%1\" is no unit of %2, which has none.")
                     .arg(condition.unit, condition.item)
               : QCoreApplication::translate("Query", "\"%1\" is no unit of %2, which is in %3.")
                     .arg(condition.unit, condition.item, unit);
}

bool holds(const Condition& condition, const AgentFrame& agent, std::uint32_t simplex) {
    if (agent.lost() || !agent.came(simplex)) return false;
    const TypeLayout& layout = *agent.structure->simplexes[simplex].layout;
    const ItemLayout* found = layout.find(condition.item.toStdString());
    if (found == nullptr) return false;
    const Value value = (*agent.image)->value(simplex, *found);
    const auto ratio = ratioOf(condition.unit, found->item->unit);
    for (std::size_t i = 0; i < elements(value); ++i) {
        const auto number = exactOf(value, i);
        if (condition.number && number && ratio) {
            if (holdsFor(*number, condition, *ratio)) return true;
        } else if (asksForEqual(condition) &&
                   !(condition.number && number && isNumeric(*found->item))) {
            const bool same = reads(elementText(*found->item, value, i), condition.word);
            if (same == (condition.is == Is::Equal)) return true;
        }
    }
    return false;
}

// Only of what is live: an old value may be within its limits by now.
bool isOutside(const AgentFrame& agent, std::uint32_t simplex) {
    if (agent.lost() || agent.quality(simplex) != Quality::Good) return false;
    const TypeLayout& layout = *agent.structure->simplexes[simplex].layout;
    return std::ranges::any_of(layout.items, [&](const ItemLayout& each) {
        return !outsideText(*each.item, (*agent.image)->value(simplex, each)).empty();
    });
}

}  // namespace cortex::gui
