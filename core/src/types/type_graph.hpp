// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace cortex {

// Who inherits from whom, checked: parents that are unknown or lead in a circle are findings and
// left out. Setup only.
class TypeGraph {
public:
    TypeGraph(const std::map<std::string, TypeDeclaration, std::less<>>& declarations,
              const std::vector<std::string>& order, Report& report);

    // Each type after its parents, otherwise in the order declared.
    const std::vector<std::string>& order() const { return order_; }
    const std::vector<std::string>& parents(const std::string& type) const {
        return parents_.at(type);
    }
    const std::set<std::string, std::less<>>& ancestors(const std::string& type) const {
        return ancestors_.at(type);
    }
    // A parent of it, at whatever distance, is not known: what it inherits is not known either.
    bool incomplete(std::string_view type) const { return incomplete_.contains(type); }
    bool known(std::string_view type) const { return ancestors_.contains(type); }
    // True where it cannot be known.
    bool isA(std::string_view type, std::string_view base) const;
    // "nearest of: …", or "" when too many were asked for.
    std::string nearest(std::string_view wrong) const;

private:
    void visit(const std::string& type);
    void addParent(const TypeDeclaration& declaration, const std::string& parent);
    void reportCycle(const std::string& parent, const TypeDeclaration& child);

    const std::map<std::string, TypeDeclaration, std::less<>>& declarations_;
    Report& report_;
    std::vector<std::string> order_;
    std::vector<std::string> open_;  // being visited, from the first child to its parents
    std::map<std::string, std::vector<std::string>, std::less<>> parents_;
    std::map<std::string, std::set<std::string, std::less<>>, std::less<>> ancestors_;
    std::map<std::string, std::size_t, std::less<>> levels_;
    std::set<std::string, std::less<>> incomplete_;
    mutable std::size_t suggestions_;
};

}  // namespace cortex
