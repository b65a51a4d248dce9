// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/command.hpp"

#include "cortex/core/argument_checks.hpp"
#include "cortex/core/labelled_value.hpp"
#include "cortex/core/tables.hpp"

#include "types/enum_names.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

namespace cortex {

template <>
inline constexpr std::array spellings<Outcome>{"None",        "Done",    "Running",
                                               "Rejected",    "Failed",  "Cancelled",
                                               "MailboxFull", "Expired", "Unknown"};
template <>
inline constexpr std::array spellings<Reason>{"none",      "state",     "range",  "busy",
                                              "authority", "restarted", "window", "unknown"};

namespace {

using Words = std::optional<EventText>;

std::uint32_t octets(const DataItem& item) {
    const bool small = item.kind == Kind::Bool;
    const std::uint32_t element = item.kind == Kind::String ? StringCell::size(item.capacity)
                                  : small                   ? 1U
                                                            : 8U;
    return (item.length * element + 7U) / 8U * 8U;
}

RecordLayout setLayout(const std::vector<const DataItem*>& settable) {
    RecordLayout layout;
    layout.size = (static_cast<std::uint32_t>(settable.size()) + 7U) / 8U * 8U;
    for (const DataItem* item : settable) {
        layout.items.push_back({item, layout.size});
        layout.size += octets(*item);
    }
    return layout;
}

std::int64_t lowest(const Number& bound) {
    if (const auto* number = std::get_if<std::int64_t>(&bound)) return *number;
    const double number = std::ceil(std::get<double>(bound));
    return number <= -0x1p63 ? std::numeric_limits<std::int64_t>::min()
                             : static_cast<std::int64_t>(std::min(number, 0x1p62));
}

std::int64_t highest(const Number& bound) {
    if (const auto* number = std::get_if<std::int64_t>(&bound)) return *number;
    const double number = std::floor(std::get<double>(bound));
    return number >= 0x1p63 ? std::numeric_limits<std::int64_t>::max()
                            : static_cast<std::int64_t>(std::max(number, -0x1p62));
}

double asFloat(const Number& bound) {
    return std::visit([](auto number) { return static_cast<double>(number); }, bound);
}

ArgumentCheck compileCheck(const ItemLayout& layout) {
    const DataItem& item = *layout.item;
    ArgumentCheck check;
    check.item = &item;
    check.offset = layout.offset;
    check.length = item.length;
    check.kind = item.kind;
    check.closed = isClosed(item);
    check.minInt = item.min ? lowest(*item.min) : std::numeric_limits<std::int64_t>::min();
    check.maxInt = item.max ? highest(*item.max) : std::numeric_limits<std::int64_t>::max();
    check.minFloat = item.min ? asFloat(*item.min) : -std::numeric_limits<double>::max();
    check.maxFloat = item.max ? asFloat(*item.max) : std::numeric_limits<double>::max();
    return check;
}

template <class T>
bool outside(const ArgumentCheck& check, T value, T lower, T upper, Words& why) {
    if (value >= lower && value <= upper) return false;
    EventText& text = why.emplace(check.item->name) << ": ";
    if constexpr (std::is_same_v<T, double>) {
        if (!std::isfinite(value)) {
            text << "not a finite number";
            return true;
        }
    }
    const T bound = value < lower ? lower : upper;
    if constexpr (std::is_same_v<T, double>)
        text.apart(value, bound);
    else
        text << value;
    text << (value < lower ? " is below " : " is above ") << bound;
    if (!check.item->unit.empty()) text << " " << check.item->unit;
    return true;
}

bool checkInt(const ArgumentCheck& check, std::int64_t value, Words& why) {
    if (outside(check, value, check.minInt, check.maxInt, why)) return false;
    if (!check.closed || check.item->labels.contains(value)) return true;
    why.emplace(check.item->name) << ": " << value << " has no label";
    return false;
}

bool checkText(const ArgumentCheck& check, const std::byte* cell, Words& why) {
    const auto& text = *reinterpret_cast<const StringCell*>(cell);
    if (text.capacity == check.item->capacity && text.length <= text.capacity) return true;
    why.emplace(check.item->name) << ": the text is not laid out as the type says";
    return false;
}

bool checkElement(const ArgumentCheck& check, const std::byte* cell, std::uint32_t index,
                  Words& why) {
    switch (check.kind) {
        case Kind::Int:
            return checkInt(check, reinterpret_cast<const std::int64_t*>(cell)[index], why);
        case Kind::Float:
            return !outside(check, reinterpret_cast<const double*>(cell)[index], check.minFloat,
                            check.maxFloat, why);
        case Kind::Bool:
            if (std::to_integer<unsigned>(cell[index]) <= 1U) return true;
            why.emplace(check.item->name) << ": neither true nor false";
            return false;
        case Kind::String:
            break;
    }
    return checkText(check, cell + index * StringCell::size(check.item->capacity), why);
}

}  // namespace

const char* name(Outcome outcome) { return spelling(outcome); }
const char* name(Reason reason) { return spelling(reason); }
std::optional<Outcome> outcomeFromName(std::string_view text) {
    return fromSpelling<Outcome>(text);
}
std::optional<Reason> reasonFromName(std::string_view text) { return fromSpelling<Reason>(text); }

Outcome Call::fail(std::string_view why) {
    why_.emplace(why);
    return Outcome::Failed;
}

Outcome Call::reject(Reason reason, std::string_view why) {
    reason_ = reason;
    why_.emplace(why);
    return Outcome::Rejected;
}

std::uint32_t CommandTable::find(std::string_view command) const {
    const auto found = std::ranges::find(entries, command, &Entry::name);
    return found != entries.end() ? static_cast<std::uint32_t>(found - entries.begin()) : none;
}

std::vector<ArgumentCheck> compileChecks(const RecordLayout& layout) {
    std::vector<ArgumentCheck> checks;
    for (const ItemLayout& item : layout.items) checks.push_back(compileCheck(item));
    return checks;
}

CommandTable commandTable(const Type& type) {
    CommandTable table;
    for (const Command& command : type.commands) {
        table.entries.push_back({&command,
                                 command.name,
                                 recordLayout(command.request),
                                 recordLayout(command.response),
                                 command.available,
                                 !command.isLong,
                                 {},
                                 {},
                                 {}});
        table.hasLong = table.hasLong || command.isLong;
    }
    if (table.hasLong) {
        table.entries.push_back({nullptr, "cancel", {}, {}, StateSet::always(), false, {}, {}, {}});
    }
    for (const DataItem& item : type.data) {
        if (!item.settable.empty()) table.settable.push_back(&item);
    }
    if (!table.settable.empty()) {
        table.entries.push_back(
            {nullptr, "set", setLayout(table.settable), {}, StateSet::always(), false, {}, {}, {}});
    }
    for (CommandTable::Entry& entry : table.entries) {
        entry.checks = compileChecks(entry.request);
        entry.floats = compileChecks(entry.response);
        std::erase_if(entry.floats, [](const auto& each) { return each.kind != Kind::Float; });
        entry.emptyResponse.resize(entry.response.size);
        initialiseRecord(entry.response, entry.emptyResponse.data());
        table.maxRequest = std::max(table.maxRequest, entry.request.size);
        table.maxResponse = std::max(table.maxResponse, entry.response.size);
    }
    return table;
}

LifeCycle lifeCycleCommand(std::string_view command) {
    if (command == "startup") return LifeCycle::Startup;
    if (command == "shutdown") return LifeCycle::Shutdown;
    if (command == "clearFaults") return LifeCycle::ClearFaults;
    return LifeCycle::None;
}

bool checkElements(const ArgumentCheck& check, const std::byte* record, Words& why) {
    for (std::uint32_t i = 0; i < check.length; ++i) {
        if (!checkElement(check, record + check.offset, i, why)) return false;
    }
    return true;
}

const DataItem* notFinite(std::span<const ArgumentCheck> floats, const std::byte* record) {
    for (const ArgumentCheck& each : floats) {
        const auto* first = reinterpret_cast<const double*>(record + each.offset);
        if (!std::all_of(first, first + each.length, [](double x) { return std::isfinite(x); })) {
            return each.item;
        }
    }
    return nullptr;
}

EventText checkArguments(const RecordLayout& layout, const std::byte* record) {
    Words why;
    for (const ArgumentCheck& check : compileChecks(layout)) {
        if (!checkArgument(check, record, why)) return *why;
    }
    return {};
}

void initialiseRecord(const RecordLayout& layout, std::byte* record) {
    if (layout.size > 0) std::memset(record, 0, layout.size);
    for (const ItemLayout& item : layout.items) {
        storeValue(*item.item, item.item->initial, record + item.offset);
    }
}

}  // namespace cortex
