// SPDX-License-Identifier: Apache-2.0
#include "model/condition.hpp"

#include "cortex/core/labelled_value.hpp"

#include "model/value_text.hpp"

#include <QCoreApplication>
#include <QRegularExpression>
#include <algorithm>
#include <array>
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

bool compare(double value, Is is, double wanted) {
    switch (is) {
        case Is::Less:
            return value < wanted;
        case Is::AtMost:
            return value <= wanted;
        case Is::More:
            return value > wanted;
        case Is::AtLeast:
            return value >= wanted;
        case Is::Equal:
            return value == wanted;
        case Is::Other:
            return value != wanted;
    }
    return false;
}

std::size_t elements(const Value& value) {
    return std::visit([](const auto& each) { return each.size(); }, value);
}

bool isIn(const QString& unit, const DataItem& item) {
    const QString own = QString::fromStdString(item.unit);
    return unit.isEmpty() || unit == own || unit == unitText(item.unit);
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
        condition.number = number.captured(1).toDouble();
        condition.unit = number.captured(2);
    } else if (right.isEmpty() || (condition.is != Is::Equal && condition.is != Is::Other)) {
        trouble = QCoreApplication::translate("Query", "After \"%1\" a number is needed.")
                      .arg(condition.item + sign);
    }
    condition.word = right;
    return condition;
}

bool holds(const Condition& condition, const AgentFrame& agent, std::uint32_t simplex) {
    if (agent.lost() || !agent.came(simplex)) return false;
    const TypeLayout& layout = *agent.structure->simplexes[simplex].layout;
    const ItemLayout* found = layout.find(condition.item.toStdString());
    if (found == nullptr) return false;
    const Value value = (*agent.image)->value(simplex, *found);
    for (std::size_t i = 0; i < elements(value); ++i) {
        const auto number = numberOf(value, i);
        if (condition.number && number) {
            if (isIn(condition.unit, *found->item) &&
                compare(*number, condition.is, *condition.number)) {
                return true;
            }
        } else if (condition.is == Is::Equal || condition.is == Is::Other) {
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
