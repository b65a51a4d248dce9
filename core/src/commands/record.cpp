// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/record.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/labelled_value.hpp"
#include "cortex/core/tables.hpp"

#include "base/text.hpp"
#include "tables/lookup.hpp"

#include <cstdint>
#include <vector>

namespace cortex {
namespace {

bool isSet(const CommandTable::Entry& entry) {
    return entry.command == nullptr && !entry.request.items.empty();
}

void describeElement(const DataItem& item, const std::byte* cells, std::uint32_t index,
                     EventText& text) {
    switch (item.kind) {
        case Kind::Int:
            text << reinterpret_cast<const std::int64_t*>(cells)[index];
            return;
        case Kind::Float:
            text << reinterpret_cast<const double*>(cells)[index];
            return;
        case Kind::Bool:
            text << (cells[index] == std::byte{0} ? "false" : "true");
            return;
        case Kind::String:
            break;
    }
    const auto* cell = cells + index * StringCell::size(item.capacity);
    text << "\"" << reinterpret_cast<const StringCell*>(cell)->view() << "\"";
}

// A number is taken for a float parameter as well.
Value converted(const DataItem& item, const Value& value, const std::string& what) {
    Value result = value;
    if (const auto* ints = std::get_if<std::vector<std::int64_t>>(&value);
        ints != nullptr && item.kind == Kind::Float) {
        result = std::vector<double>(ints->begin(), ints->end());
    }
    if (kindOf(result) != item.kind) {
        throw Error(what + " is " + shapeOf(item) + ", got " + name(kindOf(value)) + " " +
                    toText(value));
    }
    if (lengthOf(result) != item.length) {
        throw Error(what + " is " + shapeOf(item) + ": " +
                    wrongCount(item.length, lengthOf(result)) + ": " + inQuotes(toText(value)));
    }
    const std::string wrong = item.kind == Kind::String ? valueError(item, result) : "";
    if (!wrong.empty()) throw Error(what + " " + wrong);
    return result;
}

}  // namespace

std::string missingArguments(const CommandTable::Entry& entry,
                             const std::map<std::string, Value>& arguments) {
    if (entry.command == nullptr) return {};
    std::string missing;
    bool several = false;
    for (const DataItem& each : entry.command->request) {
        if (each.hasDefault || arguments.contains(each.name)) continue;
        several = !missing.empty();
        missing += (several ? ", " : "") + inQuotes(each.name) + " (" + shapeOf(each) + ")";
    }
    if (missing.empty()) return {};
    return "command " + inQuotes(entry.name) + " needs the parameter" + (several ? "s " : " ") +
           missing + (several ? ": they have" : ": it has") + " no default";
}

void describeRecord(const CommandTable& table, std::uint32_t command, const std::byte* record,
                    EventText& text) {
    const CommandTable::Entry& entry = table.entries[command];
    const char* separator = "";
    for (std::size_t i = 0; i < entry.request.items.size(); ++i) {
        if (isSet(entry) && record[i] == std::byte{0}) continue;
        const DataItem& item = *entry.request.items[i].item;
        text << separator << item.name << "=";
        separator = ", ";
        for (std::uint32_t element = 0; element < item.length; ++element) {
            if (element > 0) text << " ";
            describeElement(item, record + entry.request.items[i].offset, element, text);
        }
    }
}

void encodeRecord(const CommandTable& table, std::uint32_t command,
                  const std::map<std::string, Value>& arguments, std::byte* record) {
    const CommandTable::Entry& entry = table.entries[command];
    initialiseRecord(entry.request, record);
    for (const auto& [name, value] : arguments) {
        const std::string what =
            "command '" + std::string{entry.name} + "': parameter '" + name + "'";
        const ItemLayout* item = entry.request.find(name);
        if (item == nullptr) {
            std::vector<std::string> valid;
            for (const ItemLayout& each : entry.request.items) valid.push_back(each.item->name);
            throwUnknown(isSet(entry) ? "'" + name + "' is no settable item" : what + " is unknown",
                         name, valid);
        }
        storeValue(*item->item, converted(*item->item, value, what), record + item->offset);
        if (isSet(entry)) record[item - entry.request.items.data()] = std::byte{1};
    }
    const std::string missing = missingArguments(entry, arguments);
    if (!missing.empty()) throw Error(missing);
}

std::map<std::string, Value> decodeRecord(const RecordLayout& layout, const std::byte* record) {
    std::map<std::string, Value> values;
    for (const ItemLayout& item : layout.items) {
        values[item.item->name] = loadValue(*item.item, record + item.offset);
    }
    return values;
}

void encodeResponse(const RecordLayout& layout, const std::map<std::string, Value>& values,
                    std::byte* record) {
    for (const auto& [name, value] : values) {
        const ItemLayout* item = layout.find(name);
        if (item == nullptr || item->item->kind != kindOf(value) ||
            item->item->length != lengthOf(value)) {
            continue;
        }
        storeValue(*item->item, value, record + item->offset);
    }
}

std::map<std::string, Value> argumentsOf(const CommandTable& table, std::uint32_t command,
                                         const std::byte* request) {
    const CommandTable::Entry& entry = table.entries[command];
    std::map<std::string, Value> values = decodeRecord(entry.request, request);
    for (std::size_t i = 0; isSet(entry) && i < entry.request.items.size(); ++i) {
        if (request[i] == std::byte{0}) values.erase(entry.request.items[i].item->name);
    }
    return values;
}

}  // namespace cortex
