// SPDX-License-Identifier: Apache-2.0
#include "tables/lookup.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/nearest_names.hpp"

#include <vector>

namespace cortex {

namespace {

constexpr std::size_t mostNames = 20;

std::string listed(std::span<const std::string> names) {
    if (names.empty()) return "there is none";
    std::string text = "there is: ";
    for (std::size_t i = 0; i < names.size() && i < mostNames; ++i) {
        text += (i == 0 ? "" : ", ") + names[i];
    }
    return names.size() > mostNames ? text + ", and others" : text;
}

}  // namespace

void throwUnknown(const std::string& message, std::string_view wrong,
                  std::span<const std::string> valid) {
    const std::string nearest = nearestNames(wrong, valid);
    throw Error(message + "; " + (nearest.empty() ? listed(valid) : nearest));
}

const ItemLayout& itemAt(const SimplexInfo& simplex, std::string_view item) {
    const ItemLayout* found = simplex.layout->find(item);
    if (found != nullptr) return *found;
    std::vector<std::string> names;
    for (const ItemLayout& each : simplex.layout->items) names.push_back(each.item->name);
    const std::string message = simplex.path + ": type " + simplex.layout->type->name +
                                " has no item '" + std::string{item} + "'";
    // Nothing is known of what another agent has, unless the system file says its type.
    if (names.empty() && simplex.remote)
        throw Error(message +
                    "; where another agent has it, give its <relate> the type that it "
                    "has there: type=\"…\"");
    throwUnknown(message, item, names);
}

std::uint32_t simplexAt(const Structure& structure, std::string_view path) {
    const std::uint32_t simplex = structure.find(path);
    if (simplex != noSimplex) return simplex;
    std::vector<std::string> paths;
    for (const SimplexInfo& info : structure.simplexes) paths.push_back(info.path);
    throwUnknown("agent " + structure.agent + " has no simplex " + std::string{path}, path, paths);
}

std::string shapeOf(const DataItem& item) {
    const std::string kind = name(item.kind);
    return item.length == 1 ? kind : kind + " array of " + std::to_string(item.length);
}

}  // namespace cortex
