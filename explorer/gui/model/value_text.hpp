// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/image.hpp"
#include "cortex/core/type_model.hpp"

#include <QString>
#include <functional>
#include <utility>
#include <vector>

// Values as the screen shows them. Copies use cortex::toText, in plain ASCII at full precision.
namespace cortex::gui {

// With the digits of common::numberText(), and signs as they are printed: "−2.5×10⁻⁵".
QString numberText(const DataItem& item, double number);
// The same with fewer digits where it is too wide otherwise. The exponent stays whole: "1.2×10⁻⁷".
QString fittingNumber(const DataItem& item, double number,
                      const std::function<bool(const QString&)>& fits);
// A number of an axis, with enough digits to tell it from the next one, a step away.
QString tickText(double number, double step);

// "−0.0121", "AtLimit (3)", "7 (no label)", "true", "7 values" with the first three.
QString valueText(const DataItem& item, const Value& value);
QString elementText(const DataItem& item, const Value& value, std::size_t element);
// A value that is not live: in brackets, which survive copies, grey prints and screen readers.
QString bracketed(const QString& text);

// What a person would enter for it: labels where they stand for numbers, otherwise plain ASCII at
// full precision.
QString entryText(const DataItem& item, const Value& value);
// What a person has entered, also with the minus sign that is shown; none, and why, where it
// cannot be the item's value.
std::optional<Value> enteredValue(const DataItem& item, const QString& text, QString& why);
// "gain is out of the range 0 to 1", "mode: 'Foo' is no label; try Off or On".
QString wrongText(const std::string& item, const QString& why);
// The labels among which an item has its value, as they are entered: of a switch too; none: it is
// typed.
std::vector<std::pair<std::int64_t, QString>> choicesOf(const DataItem& item);

QString unitText(const std::string& ucum);  // "N.m" as "N·m", "m/s2" as "m/s²"
QString ageText(double seconds);            // "6 ms", "2.1 s", "12 min", "3 h 05 min"
QString wholeAgeText(double seconds);       // the same in whole seconds

// The value as a number, where it is one; for bars and limits.
std::optional<double> numberOf(const Value& value, std::size_t element = 0);
std::optional<double> numberOf(const std::optional<Number>& bound);

}  // namespace cortex::gui
