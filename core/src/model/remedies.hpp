// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/nearest_names.hpp"
#include "cortex/core/simplex_tree.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace cortex {

// Remedies are written as the XML that mends the model, so that they can be copied into it.
std::string relateText(std::string_view rule, std::string_view to, std::string_view more = "");
std::string relateText(const Simplex::Relation& relation);
// That line with another rule or target, so that its other attributes stay.
std::string relateText(Simplex::Relation relation, const std::string& rule, const std::string& to);
std::string setText(std::string_view item, std::string_view value);
std::string valueText(const Value& value);  // as the attribute `value` holds it

// Whether to look for names that are near: not for the many findings of a hopeless model.
inline bool looksForNearest(const Report& report) { return report.findings.size() < 200; }

// "a, b, c and 4 more"
std::string listText(const std::vector<std::string>& names, std::size_t most = 6);

template <class Range>
std::vector<std::string> namesOf(const Range& named) {
    std::vector<std::string> names;
    for (const auto& each : named) names.push_back(each.name);
    return names;
}

// Types that an instance of `base` can be of: itself and its children that are not abstract.
std::vector<std::string> concreteTypes(const TypeModel& types, std::string_view base);

}  // namespace cortex
