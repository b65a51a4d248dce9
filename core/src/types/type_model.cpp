// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/type_model.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/findings.hpp"
#include "cortex/core/nearest_names.hpp"

#include "base/bounds.hpp"
#include "base/text.hpp"
#include "types/type_resolver.hpp"

#include <algorithm>
#include <utility>

namespace cortex {

namespace {

template <class Item>
const Item* findSorted(const std::vector<Item>& items, std::string_view name) {
    const auto found = std::ranges::lower_bound(
        items, name, {}, [](const Item& item) { return std::string_view{item.name}; });
    return found != items.end() && found->name == name ? &*found : nullptr;
}

}  // namespace

bool latchesObservation(const DataItem& item) {
    return item.safe.kind == Safe::Kind::Observed ||
           (item.safe.kind == Safe::Kind::Stop && item.derivativeOf.empty());
}

const DataItem* Type::findData(std::string_view item) const { return findSorted(data, item); }
const Command* Type::findCommand(std::string_view command) const {
    return findSorted(commands, command);
}
const Rule* Type::findRule(std::string_view rule) const { return findSorted(rules, rule); }

TypeModel TypeModel::build(std::vector<TypeDeclaration> declarations, Report& report) {
    TypeModel model;
    std::vector<std::string> order;
    for (TypeDeclaration& declaration : declarations) {
        if (!isName(declaration.name)) {
            report.error(declaration.name.substr(0, bounds::nameLength), finding::name,
                         declaration.place, inQuotes(declaration.name) + " is not a name",
                         "write a letter, then letters, digits, - or _; at most 64");
            continue;
        }
        const auto known = model.declarations_.find(declaration.name);
        if (known != model.declarations_.end()) {
            const std::string first = known->second.place.text();
            report.error(declaration.name, finding::duplicateType, declaration.place,
                         "the type is given twice" + (first.empty() ? "" : ", first at " + first),
                         "give one of them another name");
            continue;
        }
        if (order.size() == bounds::types) {
            report.error(declaration.name, finding::modelSize, declaration.place,
                         "there are more than 16384 types", "divide the model");
            break;
        }
        order.push_back(declaration.name);
        model.declarations_.emplace(declaration.name, std::move(declaration));
    }
    model.types_ = TypeResolver{model.declarations_, order, report}.run();
    return model;
}

const Type* TypeModel::find(std::string_view type) const {
    const auto found = types_.find(type);
    return found == types_.end() ? nullptr : &found->second;
}

const Type& TypeModel::at(std::string_view type) const {
    if (const Type* found = find(type)) return *found;
    std::vector<std::string> valid;
    for (const auto& [name, each] : types_) valid.push_back(name);
    const std::string near = nearestNames(type, valid);
    throw Error{"there is no type " + inQuotes(type) +
                (near.empty() ? "; include the ontology that declares it" : "; " + near)};
}

bool TypeModel::isA(std::string_view type, std::string_view base) const {
    const Type* found = find(type);
    return found && found->isA(base);
}

}  // namespace cortex
