// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"
#include "cortex/core/labelled_value.hpp"
#include "cortex/core/simplex_tree.hpp"
#include "cortex/core/system_findings.hpp"

#include "base/text.hpp"
#include "model/remedies.hpp"
#include "model/validation_checks.hpp"
#include "tables/lookup.hpp"

#include <algorithm>
#include <string>

namespace cortex {
namespace {

using Entry = SystemDescription::SimplexEntry;

// A valid path that resembles a malformed one; "" if there is none.
std::string mendedPath(std::string_view path) {
    std::string mended = "/";
    for (const char c : path) {
        const bool allowed = SimplexTree::pathError(std::string{"/"} + c).empty();
        if (allowed)
            mended += c;
        else if (c == '/' && mended.back() != '/')
            mended += '/';
        else if (c != '/')
            mended += '-';
    }
    while (mended.size() > 1 && mended.back() == '/') mended.pop_back();
    return SimplexTree::pathError(mended).empty() ? mended : "";
}

bool checkPath(const SimplexTree& tree, const Entry& entry, Report& report) {
    if (const std::string wrong = SimplexTree::pathError(entry.path); !wrong.empty()) {
        const std::string mended = mendedPath(entry.path);
        report.error(entry.path, finding::malformedPath, entry.place,
                     "path '" + entry.path + "': " + wrong,
                     mended.empty() ? "use at most 8 levels and 128 characters, as in /arm/lbr"
                                    : "write path=\"" + mended + "\"");
        return false;
    }
    const Simplex* first = tree.find(entry.path);
    if (first == nullptr) return true;
    int n = 2;
    while (tree.find(entry.path + "-" + std::to_string(n)) != nullptr) ++n;
    const std::string where = first->place().text();
    report.error(
        entry.path, finding::duplicatePath, entry.place,
        "there is a simplex with this path already" + (where.empty() ? where : ", at " + where),
        "remove one, or write path=\"" + entry.path + "-" + std::to_string(n) + "\"");
    return false;
}

const Type* checkType(const TypeModel& types, const Entry& entry, Report& report) {
    const Type* type = types.find(entry.type);
    if (type != nullptr) return type;
    std::vector<std::string> names;
    for (const auto& [name, each] : types.types()) {
        if (!each.isAbstract) names.push_back(name);
    }
    std::string nearest;
    if (looksForNearest(report)) nearest = nearestName(entry.type, names);
    report.error(entry.path, finding::unknownType, entry.place,
                 "there is no type '" + entry.type + "' in the ontology",
                 nearest.empty() ? "add <ontology file=\"…\"/> with the file that defines it"
                                 : "write type=\"" + nearest + "\"");
    return nullptr;
}

// What is wrong with text that is no value of its item: its count, its number, or its kind.
const char* ruleOf(const DataItem& item, std::string text) {
    const std::size_t count = splitBlanks(text).size();
    if (count != item.length && item.kind != Kind::String) return finding::settingLength;
    for (char& c : text) c = static_cast<char>(c | 0x20);
    const bool special = text.find("nan") != text.npos || text.find("inf") != text.npos;
    return special && item.kind == Kind::Float ? finding::settingFinite : finding::settingKind;
}

// The value that is meant most likely: "0,3" is 0.3, "1, 2" are two numbers.
std::string mendedText(const DataItem& item, const std::string& text) {
    if (!item.labels.empty()) return withNearestLabels(item, text);
    for (const char instead : {'.', ' '}) {
        std::string other = text, why;
        std::ranges::replace(other, ',', instead);
        if (const auto value = parseItemValue(item, other, why)) return valueText(*value);
    }
    return valueText(item.initial);
}

void addSetting(const TypeModel& types, Simplex& simplex, const SystemDescription::Setting& setting,
                Report& report) {
    const DataItem* item = simplex.type().findData(setting.data);
    if (item == nullptr) {
        const Value text{std::vector{setting.value}};
        reportUnknownItem(types, simplex, {setting.data, text, setting.place}, report);
        return;
    }
    std::string why;
    if (auto value = parseItemValue(*item, setting.value, why)) {
        simplex.set(setting.data, *value, setting.place);
        return;
    }
    const std::string mended = mendedText(*item, setting.value);
    report.error(simplex.path(), ruleOf(*item, setting.value), setting.place,
                 "item '" + setting.data + "' is " + shapeOf(*item) + ": " + why,
                 mended.empty() && !item->labels.empty()
                     ? "write one of the labels"
                     : "write " + setText(setting.data, mended));
}

}  // namespace

void SimplexTree::add(const SystemDescription& system, const ClassRegistry* registry,
                      Report& report) {
    requireNotFixed(system.name);
    for (const Entry& entry : system.simplexes) {
        if (!checkPath(*this, entry, report)) continue;
        const Type* type = checkType(*types_, entry, report);
        if (type == nullptr) continue;
        Simplex& simplex = insert(make(entry.path, *type, registry));
        simplex.description_->place = entry.place;
        simplex.description_->every = entry.every;
        simplex.description_->phase = entry.phase;
        for (const auto& relate : entry.relates) {
            simplex.description_->relations.push_back({relate.rule, relate.to, relate.delayed,
                                                       relate.remote, relate.place, relate.type,
                                                       relate.maxAge});
        }
        for (const auto& setting : entry.settings) addSetting(*types_, simplex, setting, report);
    }
    auto& all = description_;
    if (all.name.empty()) {
        all.name = system.name;
        all.place = system.place;
    }
    all.clusters.insert(all.clusters.end(), system.clusters.begin(), system.clusters.end());
    all.simplexes.insert(all.simplexes.end(), system.simplexes.begin(), system.simplexes.end());
}

SimplexTree SimplexTree::load(std::span<const std::filesystem::path> files,
                              const ClassRegistry* registry) {
    Report report;
    ModelFiles model = readModelFiles(files, report);
    SimplexTree tree{std::move(model.types)};
    tree.add(model.system, registry, report);
    if (!report.ok()) throw ModelError{std::move(report)};
    return tree;
}

}  // namespace cortex
