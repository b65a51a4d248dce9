// SPDX-License-Identifier: Apache-2.0
#include "live/judged_value.hpp"

#include "cortex/core/argument_checks.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/labelled_value.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace cortex::cli {
namespace {

// Why `set` refuses this value whatever the state; "" if it does not.
std::string refusal(const CommandTable& table, const DataItem& item, const Value& value) {
    const std::uint32_t set = table.find("set");
    const CommandTable::Entry& entry = table.entries[set];
    std::vector<std::uint64_t> record((entry.request.size + 7) / 8);
    std::byte* octets = reinterpret_cast<std::byte*>(record.data());
    try {
        encodeRecord(table, set, {{item.name, value}}, octets);
    } catch (const Error& error) {
        return error.what();
    }
    for (const ArgumentCheck& check : entry.checks) {
        std::optional<EventText> why;
        if (check.item->name == item.name && !checkArgument(check, octets, why)) {
            return std::string{why->view()};
        }
    }
    return "";
}

}  // namespace

JudgedValue judgedValue(const CommandTable& table, const DataItem& item, const std::string& text) {
    std::string why;
    const auto value = parseItemValue(item, text, why);
    if (!value) return {{}, "malformed-value", "'" + item.name + "': " + why};
    return {*value, "out-of-range", refusal(table, item, *value)};
}

}  // namespace cortex::cli
