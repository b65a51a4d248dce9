// SPDX-License-Identifier: Apache-2.0
#include "types/type_graph.hpp"

#include "cortex/core/findings.hpp"
#include "cortex/core/nearest_names.hpp"

#include "base/bounds.hpp"
#include "base/text.hpp"

#include <algorithm>

namespace cortex {

TypeGraph::TypeGraph(const std::map<std::string, TypeDeclaration, std::less<>>& declarations,
                     const std::vector<std::string>& order, Report& report)
    : declarations_{declarations}, report_{report}, suggestions_{bounds::suggestions} {
    for (const std::string& type : order) visit(type);
}

// Parents first. The recursion ends at bounds::inheritance levels of open types.
void TypeGraph::visit(const std::string& type) {
    if (levels_.contains(type)) return;
    const TypeDeclaration& declaration = declarations_.find(type)->second;
    open_.push_back(type);
    parents_[type];
    for (const std::string& parent : declaration.parents) addParent(declaration, parent);
    auto& ancestors = ancestors_[type];
    std::size_t level = 1;
    for (const std::string& parent : parents_[type]) {
        ancestors.insert(parent);
        ancestors.insert(ancestors_[parent].begin(), ancestors_[parent].end());
        level = std::max(level, levels_[parent] + 1);
        if (incomplete_.contains(parent)) incomplete_.insert(type);
    }
    levels_[type] = level;
    order_.push_back(type);
    open_.pop_back();
}

void TypeGraph::addParent(const TypeDeclaration& declaration, const std::string& parent) {
    std::vector<std::string>& parents = parents_[declaration.name];
    const auto leaveOut = [&](const char* rule, const std::string& message, std::string remedy) {
        report_.error(declaration.name, rule, declaration.place, message, std::move(remedy));
        incomplete_.insert(declaration.name);
    };
    if (std::ranges::find(parents, parent) != parents.end()) {
        report_.error(declaration.name, finding::duplicateParent, declaration.place,
                      "extends " + inQuotes(parent) + " twice", "name each parent once");
    } else if (!declarations_.contains(parent)) {
        const std::string near = nearest(parent);
        leaveOut(finding::unknownParent, "extends " + inQuotes(parent) + ", which is not known",
                 near.empty() ? "include the ontology that declares it" : near);
    } else if (std::ranges::find(open_, parent) != open_.end()) {
        reportCycle(parent, declaration);
    } else if (parents.size() == bounds::parents) {
        leaveOut(finding::inheritanceDepth, "extends more than 64 parents", "name fewer");
    } else if (open_.size() >= bounds::inheritance && !levels_.contains(parent)) {
        leaveOut(finding::inheritanceDepth, "is more than 64 levels below its first ancestor",
                 "make the hierarchy flatter");
    } else {
        visit(parent);
        if (levels_[parent] >= bounds::inheritance) {
            leaveOut(finding::inheritanceDepth, "is more than 64 levels below its first ancestor",
                     "make the hierarchy flatter");
        } else {
            parents.push_back(parent);
        }
    }
}

void TypeGraph::reportCycle(const std::string& parent, const TypeDeclaration& child) {
    std::string cycle;
    for (auto each = std::ranges::find(open_, parent); each != open_.end(); ++each) {
        cycle += *each + " extends ";
        incomplete_.insert(*each);
    }
    report_.error(child.name, finding::parentCycle, child.place,
                  "types extend each other: " + cycle + parent, "remove one of the parents");
}

bool TypeGraph::isA(std::string_view type, std::string_view base) const {
    if (type == base) return true;
    const auto found = ancestors_.find(type);
    if (found == ancestors_.end() || !known(base)) return true;
    return found->second.contains(base) || incomplete(type);
}

std::string TypeGraph::nearest(std::string_view wrong) const {
    if (suggestions_ == 0) return {};
    --suggestions_;
    std::vector<std::string> valid;
    for (const auto& [name, declaration] : declarations_) valid.push_back(name);
    return nearestNames(wrong, valid);
}

}  // namespace cortex
