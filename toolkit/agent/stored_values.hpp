// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/simplex_tree.hpp"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace cortex::toolkit {

// The value of an item in a file of the form that `cortex save` writes: <set> in <simplex>.
struct StoredValue {
    Simplex* simplex = nullptr;
    const DataItem* item = nullptr;
    Value value;
    Place place;
};

// Which items such a file may have, and the finding for others.
struct StoredKind {
    bool (*takes)(const DataItem& item);
    const char* rule;
    const char* refusal;  // "lets nobody set"
};
extern const StoredKind settableItems, retainedItems;

// The value that the item begins with, as far as files and the command line were read.
Value startValue(const Simplex& simplex, const DataItem& item);

// What is good of the file, checked against the types of the tree; the rest is in the report.
std::vector<StoredValue> readStored(const std::filesystem::path& file, const StoredKind& kind,
                                    SimplexTree& tree, Report& report);

// Makes them start values. A line for each that was another one: "/a.gain 1 -> 2 Hz\n".
std::string applyStored(const std::vector<StoredValue>& values);

// --settings: all of the file, or ModelError with everything that is wrong. What to print.
std::string applySettingsFile(const std::filesystem::path& file, SimplexTree& tree);

// --set PATH.ITEM=VALUE. `given`: what was set so before. Throws UsageError, and Error for a value.
void applySetting(SimplexTree& tree, const std::string& text, std::set<std::string>& given);

}  // namespace cortex::toolkit
