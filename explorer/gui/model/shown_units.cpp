// SPDX-License-Identifier: Apache-2.0
#include "model/shown_units.hpp"

#include "cortex/core/labelled_value.hpp"

#include "common/number_text.hpp"
#include "model/value_text.hpp"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

namespace cortex::gui {

namespace {

constexpr std::array table{
    UnitQuantity{QT_TRANSLATE_NOOP("Units", "Angles"), {"rad", "deg"}, {1, std::numbers::pi / 180}},
    UnitQuantity{QT_TRANSLATE_NOOP("Units", "Lengths"), {"m", "mm"}, {1, 1e-3}},
};
static_assert(table.size() == ShownUnits::quantities);

constexpr double rounding = 1e-12;  // of a number, that a conversion may be wrong by
constexpr int entryDigits = 15, boundDigits = 13;

// "rad" and "/s2" of "rad/s2".
std::pair<std::string, std::string> partsOf(const std::string& unit) {
    const std::size_t slash = std::min(unit.find('/'), unit.size());
    return {unit.substr(0, slash), unit.substr(slash)};
}

// Without the digits that only the conversion has made: 45, not 44.99999999999998.
std::optional<Number> shownBound(const std::optional<Number>& bound, double factor) {
    const auto number = numberOf(bound);
    if (!number) return std::nullopt;
    return Number{QString::number(*number * factor, 'g', boundDigits).toDouble()};
}

std::shared_ptr<const ShownItem> converted(const DataItem& item, const std::string& unit,
                                           double factor) {
    auto shown = std::make_shared<ShownItem>(ShownItem{item, factor});
    DataItem& as = shown->item;
    as.unit = unit;
    as.min = shownBound(item.min, factor);
    as.max = shownBound(item.max, factor);
    if (const int decimals = common::decimalsOf(item); decimals >= 0) {
        as.resolution = std::pow(10.0, -decimals) * factor;
        as.format.clear();
    }
    as.safe.value = shownValue(shown.get(), item.safe.value);
    return shown;
}

Value scaled(const Value& value, double factor) {
    Value result = value;
    if (auto* floats = std::get_if<std::vector<double>>(&result)) {
        for (double& each : *floats) each *= factor;
    }
    return result;
}

// The first of these that the number is but for rounding, otherwise itself.
double settled(double number, std::initializer_list<std::optional<double>> known) {
    for (const auto& each : known) {
        if (each && std::abs(number - *each) <= rounding * std::abs(*each)) return *each;
    }
    return number;
}

// What a person has entered, whatever the limits.
std::optional<Value> numbersOf(const DataItem& item, const QString& text, QString& why) {
    DataItem unlimited = item;
    unlimited.min = unlimited.max = std::nullopt;
    return enteredValue(unlimited, text, why);
}

}  // namespace

std::span<const UnitQuantity> unitQuantities() { return table; }

UnitSize unitSize(const std::string& unit) {
    const auto [head, rest] = partsOf(unit);
    for (const UnitQuantity& each : table) {
        const auto found = std::ranges::find(each.units, head);
        if (found == each.units.end()) continue;
        return {each.units.front() + rest,
                each.sizes[static_cast<std::size_t>(found - each.units.begin())]};
    }
    return {unit, 1};
}

std::vector<std::string> unitsLike(const std::string& unit) {
    const std::string base = unitSize(unit).base;
    std::vector<std::string> all{unit};
    for (const UnitQuantity& each : table) {
        for (const char* head : each.units) {
            std::string other = head + partsOf(unit).second;
            if (other != unit && unitSize(other).base == base) all.push_back(std::move(other));
        }
    }
    return all;
}

void ShownUnits::choose(std::size_t quantity, const std::string& unit) { chosen_[quantity] = unit; }

std::shared_ptr<const ShownItem> ShownUnits::of(const DataItem& item) const {
    if (item.kind != Kind::Float) return nullptr;
    const auto [head, rest] = partsOf(item.unit);
    for (std::size_t i = 0; i < table.size(); ++i) {
        const auto sizeOf = [&](std::string_view unit) {
            const auto found = std::ranges::find(table[i].units, unit);
            return found == table[i].units.end()
                       ? 0.0
                       : table[i].sizes[static_cast<std::size_t>(found - table[i].units.begin())];
        };
        const double from = sizeOf(head), to = sizeOf(chosen_[i]);
        if (from > 0 && to > 0 && head != chosen_[i]) {
            return converted(item, chosen_[i] + rest, from / to);
        }
    }
    return nullptr;
}

QJsonArray ShownUnits::saved() const {
    QJsonArray saved;
    for (const std::string& each : chosen_) {
        if (!each.empty()) saved.append(QString::fromStdString(each));
    }
    return saved;
}

ShownUnits ShownUnits::restored(const QJsonArray& saved) {
    ShownUnits units;
    for (const QJsonValue each : saved) {
        const std::string unit = each.toString().toStdString();
        for (std::size_t i = 0; i < table.size(); ++i) {
            if (std::ranges::find(table[i].units, unit) != table[i].units.end()) {
                units.choose(i, unit);
            }
        }
    }
    return units;
}

Value shownValue(Shown shown, const Value& value) {
    return shown == nullptr ? value : scaled(value, shown->factor);
}

QString shownText(Shown shown, const DataItem& item, const Value& value, std::size_t element) {
    const auto number = shown == nullptr ? std::nullopt : numberOf(value, element);
    return number ? numberText(shown->item, *number * shown->factor)
                  : elementText(item, value, element);
}

QString shownEntry(Shown shown, const DataItem& item, const Value& value) {
    const auto* numbers = std::get_if<std::vector<double>>(&value);
    if (shown == nullptr || numbers == nullptr) return entryText(item, value);
    QStringList texts;
    for (const double each : *numbers) {
        texts << QString::number(each * shown->factor, 'g', entryDigits);
    }
    return texts.join(' ');
}

std::optional<Value> enteredShown(Shown shown, const DataItem& item, const QString& text,
                                  QString& why, const std::optional<Value>& now) {
    if (shown == nullptr) return enteredValue(item, text, why);
    DataItem as = shown->item;
    as.length = item.length;  // of one element, where that is entered
    as.name = item.name;
    auto value = numbersOf(as, text, why);
    if (!value) return std::nullopt;
    Value result = scaled(*value, 1 / shown->factor);
    if (auto* floats = std::get_if<std::vector<double>>(&result)) {
        for (std::size_t i = 0; i < floats->size(); ++i) {
            (*floats)[i] = settled((*floats)[i], {numberOf(item.min), numberOf(item.max),
                                                  now ? numberOf(*now, i) : std::nullopt});
        }
    }
    if (valueError(item, result).empty()) return result;
    why = QString::fromStdString(valueError(as, *value));
    if (why.isEmpty()) why = QString::fromStdString(valueError(item, result));
    return std::nullopt;
}

}  // namespace cortex::gui
