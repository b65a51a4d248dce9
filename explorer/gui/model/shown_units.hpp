// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"
#include "cortex/core/value.hpp"

#include <QJsonArray>
#include <QString>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cortex::gui {

// An item as it is shown in another unit than the model has it in.
struct ShownItem {
    DataItem item;      // with unit, limits and resolution as they are shown
    double factor = 1;  // from the number of the model to the shown one
};

// What can be shown in one unit or another.
struct UnitQuantity {
    const char* name;                  // to be translated
    std::array<const char*, 2> units;  // UCUM
    std::array<double, 2> sizes;       // in the first of them
};
std::span<const UnitQuantity> unitQuantities();

// A unit in the one that stands for its dimension: of "deg/s" "rad/s" and pi / 180. What cannot be
// shown in another unit stands for itself.
struct UnitSize {
    std::string base;
    double size = 1;
};
UnitSize unitSize(const std::string& unit);
// It, and all that a number in it can be converted to.
std::vector<std::string> unitsLike(const std::string& unit);

// The units in which a view shows angles and lengths. What is not chosen is shown as the model has
// it. Only numbers with decimals are converted, also where a unit is a part: rad/s, mm/s2.
class ShownUnits {
public:
    static constexpr std::size_t quantities = 2;

    void choose(std::size_t quantity, const std::string& unit);  // empty: as the model has it
    const std::string& chosen(std::size_t quantity) const { return chosen_[quantity]; }
    bool any() const { return *this != ShownUnits{}; }
    std::shared_ptr<const ShownItem> of(const DataItem& item) const;  // null: as the model has it

    QJsonArray saved() const;
    static ShownUnits restored(const QJsonArray& saved);
    bool operator==(const ShownUnits&) const = default;

private:
    std::array<std::string, quantities> chosen_;
};

// Null for an item that is shown as the model has it, in all of these.
using Shown = const ShownItem*;

Value shownValue(Shown shown, const Value& value);
// As value_text.hpp says, in the shown unit; entries are rounded to 15 digits, which hides what the
// conversion rounded.
QString shownText(Shown shown, const DataItem& item, const Value& value, std::size_t element);
QString shownEntry(Shown shown, const DataItem& item, const Value& value);
// What was entered in the shown unit, in the unit of the model. What is a limit but for rounding is
// the limit, and what is the value that the agent has now is just that.
std::optional<Value> enteredShown(Shown shown, const DataItem& item, const QString& text,
                                  QString& why, const std::optional<Value>& now = {});

}  // namespace cortex::gui
