// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/record.hpp"
#include "cortex/core/type_model.hpp"
#include "cortex/core/value.hpp"

#include <string>

namespace cortex::cli {

// The text of a settable item in a file of `save`: what `save` writes is what `restore` takes.
struct JudgedValue {
    Value value;
    const char* rule = "";  // that it breaks
    std::string why;        // empty: `set` takes it
};
// `table`: of the type that has the item.
JudgedValue judgedValue(const CommandTable& table, const DataItem& item, const std::string& text);

}  // namespace cortex::cli
