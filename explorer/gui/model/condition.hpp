// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/exact_number.hpp"
#include "session/frame.hpp"

#include <QString>
#include <optional>

namespace cortex::gui {

// What a filter asks of a value: `position>1.5`, `speed<=0.1m/s`, `mode=Position`. Without a unit
// the number is in that of the model. A unit that it cannot be converted from never holds.
struct Condition {
    enum class Is { Less, AtMost, More, AtLeast, Equal, Other };

    QString item, word;  // the word is a label or a text, where it is no number
    Is is = Is::Equal;
    std::optional<ExactNumber> number;
    QString unit;
};

// None: the text is no condition. `trouble` says what is wrong with one.
std::optional<Condition> conditionFrom(const QString& text, QString& trouble);

// That no item of this name can be compared with the unit that was written; empty: one can.
QString unitTrouble(const Condition& condition, const Frame& frame);

// Of an array: whether it holds for an element. A value that never came fulfils nothing.
bool holds(const Condition& condition, const AgentFrame& agent, std::uint32_t simplex);

// Whether a number of the simplex is beyond the limits of its item, or has no label where only
// labelled numbers are values.
bool isOutside(const AgentFrame& agent, std::uint32_t simplex);

}  // namespace cortex::gui
