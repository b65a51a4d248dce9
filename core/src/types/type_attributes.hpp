// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace cortex {

// One attribute of a type or of an item of it, as its canonical text has it.
struct TypeAttribute {
    std::string name;
    std::string value;
    std::string byDefault;  // what the value is where nothing is stated

    bool stated() const { return value != byDefault; }
};

std::string countText(std::uint32_t count);                 // of a rule; "*": any number
std::string joined(const std::vector<std::string>& names);  // with blanks between

// All attributes, sorted by name; descriptions are none. Labels are "label <number>".
std::vector<TypeAttribute> attributesOf(const Type& type);
std::vector<TypeAttribute> attributesOf(const DataItem& item);
std::vector<TypeAttribute> attributesOf(const Command& command);
std::vector<TypeAttribute> attributesOf(const Rule& rule);

}  // namespace cortex
