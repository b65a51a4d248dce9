// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"
#include "cortex/core/type_model.hpp"

#include "files/xml_element.hpp"

#include <set>
#include <string>
#include <vector>

namespace cortex {

// The rules that one morphology gives one type.
struct RuleBlock {
    std::string type;
    std::vector<Rule> rules;
    std::set<std::string> stated;
    Place place;
};

TypeDeclaration readType(const XmlElement& element, const std::string& file, Report& report);
RuleBlock readRules(const XmlElement& element, const std::string& file, Report& report);

}  // namespace cortex
