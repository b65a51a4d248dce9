// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/exact_number.hpp"
#include "model/shown_units.hpp"
#include "session/frame.hpp"

#include <QString>
#include <cstddef>
#include <memory>
#include <optional>

namespace cortex::gui {

// One item of one simplex, as the table has it that compares many.
struct CompareRow {
    Place place;
    const ItemLayout* item = nullptr;
    std::size_t element = 0;
    std::shared_ptr<const ShownItem> shown;  // null: as the model has it
    QString path, value, unit, distance, age, remark;
    int group = 0;         // of those whose numbers can be compared
    double scale = 1;      // to the unit of its group
    bool upper = false;    // the nearer limit
    bool outside = false;  // as the counter of the window has it: what is not good is not judged
    // In the unit of the model, all three lines. What is no number is not known.
    std::optional<ExactNumber> number;
    std::optional<double> min, max;
    std::optional<ExactNumber> left;  // to the nearer limit; below 0: beyond it
    std::optional<double> share;      // the same of the range
    std::optional<float> seconds;
    bool came = false, live = false, constant = false;
};

// What the frame has of it.
void readRow(CompareRow& row, const Frame& frame);

// "Limits: 0 to 3 rad. 0.2 rad below the upper one."
QString limitText(const CompareRow& row);

}  // namespace cortex::gui
