// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include <string>

// Numbers as people read them, in plain ASCII. Files and programs get them whole, by toText().
namespace cortex::common {

int decimalsOf(const DataItem& item);  // by its format or resolution; -1: neither says

// By the format of the item, otherwise its resolution; with an exponent from 1e15 on. Where neither
// says: six significant digits; with an exponent below 1e-4 and from 1e7 on. "-2.0944", "1.2e-5".
std::string numberText(const DataItem& item, double number);

// With so many significant digits at most, without an exponent and without zeros at its end.
std::string significantText(double number, int digits);

}  // namespace cortex::common
