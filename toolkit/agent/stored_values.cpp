// SPDX-License-Identifier: Apache-2.0
#include "stored_values.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/labelled_value.hpp"
#include "cortex/core/model_files.hpp"
#include "cortex/core/nearest_names.hpp"
#include "cortex/core/printable.hpp"

#include "options.hpp"

#include <algorithm>
#include <array>

namespace cortex::toolkit {
namespace {

using Entry = SystemDescription::SimplexEntry;

// What a person reads of a value: quotes where its end would not be seen.
std::string shownValue(const DataItem& item, const Value& value) {
    const std::string text = printable(toText(value));
    return item.kind == Kind::String ? "\"" + text + "\"" : text;
}

// As an ontology states it.
std::string shape(const DataItem& item) {
    std::string text = std::string{"kind=\""} + name(item.kind) + "\" length=\"" +
                       std::to_string(item.length) + "\"";
    return item.unit.empty() ? text : text + " unit=\"" + item.unit + "\"";
}

class StoredReader {
public:
    StoredReader(const StoredKind& kind, SimplexTree& tree, Report& report)
        : kind_{kind}, tree_{tree}, report_{report} {}

    void read(const Entry& entry) {
        Simplex* simplex = find(entry);
        if (simplex == nullptr) return;
        if (!entry.relates.empty()) {
            report_.error(entry.path, "stored-relation", entry.relates.front().place,
                          "a file of values cannot relate simplexes",
                          "move <relate> to the system file");
        }
        for (const auto& setting : entry.settings) read(*simplex, setting);
    }

    std::vector<StoredValue> values;

private:
    Simplex* find(const Entry& entry) {
        Simplex* simplex = tree_.find(entry.path);
        if (simplex == nullptr) {
            std::vector<std::string> paths;
            for (const auto& [path, each] : tree_.simplexes()) paths.push_back(path);
            report_.error(entry.path, "unknown-path", entry.place, "the system has no such simplex",
                          nearestNames(entry.path, paths));
        } else if (simplex->type().name != entry.type) {
            report_.error(entry.path, "stored-type", entry.place,
                          "the values are of the type " + entry.type + ", the simplex is a " +
                              simplex->type().name,
                          "take them out of the file, or write type=\"" + simplex->type().name +
                              "\" if they still hold");
            simplex = nullptr;
        }
        return simplex;
    }

    void read(Simplex& simplex, const SystemDescription::Setting& setting) {
        const auto wrong = [&](const char* rule, const std::string& message,
                               const std::string& remedy) {
            report_.error(simplex.path(), rule, setting.place, message, remedy);
        };
        const DataItem* item = simplex.type().findData(setting.data);
        if (item == nullptr || !kind_.takes(*item)) {
            const bool isUnknown = item == nullptr;
            return wrong(isUnknown ? "unknown-item" : kind_.rule,
                         simplex.type().name + " " + (isUnknown ? "has no item" : kind_.refusal) +
                             " '" + setting.data + "'",
                         nearestNames(setting.data, names(simplex.type())));
        }
        std::string why;
        const auto value = parseItemValue(*item, setting.value, why);
        if (!value) return wrong("malformed-value", "'" + item->name + "': " + why, "");
        why = valueError(*item, *value);
        if (!why.empty()) {
            return wrong("out-of-range",
                         "'" + item->name + "': " + shownValue(*item, *value) + " " + why, "");
        }
        values.push_back({&simplex, item, *value, setting.place});
    }

    std::vector<std::string> names(const Type& type) const {
        std::vector<std::string> names;
        for (const DataItem& item : type.data) {
            if (kind_.takes(item)) names.push_back(item.name);
        }
        return names;
    }

    const StoredKind& kind_;
    SimplexTree& tree_;
    Report& report_;
};

}  // namespace

const StoredKind settableItems{[](const DataItem& item) { return !item.settable.empty(); },
                               "not-settable", "lets nobody set"};
const StoredKind retainedItems{[](const DataItem& item) { return item.retain; }, "not-retained",
                               "does not retain"};

Value startValue(const Simplex& simplex, const DataItem& item) {
    const auto set = std::ranges::find(simplex.settings(), item.name, &Simplex::Setting::item);
    return set == simplex.settings().end() ? item.initial : set->value;
}

std::vector<StoredValue> readStored(const std::filesystem::path& file, const StoredKind& kind,
                                    SimplexTree& tree, Report& report) {
    const std::array files{file};
    const ModelFiles model = readModelFiles(files, report);
    if (!model.hasSystem && report.ok()) {
        report.error("", "no-system", {file.string(), 1}, "the file has no <system>",
                     "give a file that 'cortex save' wrote");
    }
    StoredReader reader{kind, tree, report};
    for (const Entry& entry : model.system.simplexes) reader.read(entry);
    return std::move(reader.values);
}

std::string applyStored(const std::vector<StoredValue>& values) {
    std::string differences;
    for (const StoredValue& each : values) {
        const Value before = startValue(*each.simplex, *each.item);
        if (before != each.value) {
            differences += each.simplex->path() + "." + each.item->name + " " +
                           shownValue(*each.item, before) + " -> " +
                           shownValue(*each.item, each.value) +
                           (each.item->unit.empty() ? "" : " " + each.item->unit) + "\n";
        }
        each.simplex->set(each.item->name, each.value, each.place);
    }
    return differences;
}

std::string applySettingsFile(const std::filesystem::path& file, SimplexTree& tree) {
    Report report;
    const std::vector<StoredValue> values = readStored(file, settableItems, tree, report);
    if (!report.ok()) throw ModelError(std::move(report));
    const std::string differences = applyStored(values);
    const auto changed = std::ranges::count(differences, '\n');
    return "settings of " + file.string() + ": " + std::to_string(values.size()) + " items, " +
           std::to_string(changed) + " of them other than before\n" + differences;
}

void applySetting(SimplexTree& tree, const std::string& text, std::set<std::string>& given) {
    const std::size_t equals = text.find('=');
    const std::size_t dot = text.rfind('.', equals);
    if (equals == std::string::npos || dot == std::string::npos || dot == 0) {
        throw UsageError("--set " + text + ": write it as /path/of/simplex.item=value");
    }
    const std::string itemName = text.substr(dot + 1, equals - dot - 1);
    if (!given.insert(text.substr(0, equals)).second) {
        throw UsageError("--set " + text + ": " + text.substr(0, equals) + " is given twice");
    }
    Simplex& simplex = tree.at(text.substr(0, dot));
    const DataItem* item = simplex.type().findData(itemName);
    if (item == nullptr) {
        std::vector<std::string> names;
        for (const DataItem& each : simplex.type().data) names.push_back(each.name);
        throw UsageError("--set " + text + ": " + simplex.path() + " (" + simplex.type().name +
                         ") has no item '" + itemName + "'; " + nearestNames(itemName, names));
    }
    std::string why;
    const auto value = parseItemValue(*item, text.substr(equals + 1), why);
    if (!value) {
        throw UsageError("--set " + text + ": " + why + "; " + itemName + " has " + shape(*item));
    }
    simplex.set(itemName, *value, {"--set", 0});
}

}  // namespace cortex::toolkit
