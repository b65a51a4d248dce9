// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"
#include "cortex/core/type_model.hpp"

#include "files/xml_element.hpp"

#include <cstdint>
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

// In a file an unknown attribute is a mistake; in the description of an agent it is of a later
// version, and kept.
enum class Unknown : std::uint8_t { Refused, Kept };

TypeDeclaration readType(const XmlElement& element, const std::string& file, Report& report,
                         Unknown unknown = Unknown::Refused);
RuleBlock readRules(const XmlElement& element, const std::string& file, Report& report,
                    Unknown unknown = Unknown::Refused);

}  // namespace cortex
