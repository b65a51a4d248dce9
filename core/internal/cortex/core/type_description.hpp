// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agreement.hpp"
#include "cortex/core/report.hpp"
#include "cortex/core/type_model.hpp"

#include <span>
#include <string>
#include <vector>

namespace cortex {

// Types as agents send them to each other: what XML says of them, as texts. A type has everything
// that it inherits; an attribute with its default may be left out, and describe() leaves it out,
// except `kind`, `direction` and `target`.
struct DescribedAttribute {
    std::string name, text;  // as in XML
    bool operator==(const DescribedAttribute&) const = default;
};

// A data item or a parameter.
struct DescribedItem {
    std::string name;
    std::vector<DescribedAttribute> attributes;
    std::string description;
    bool operator==(const DescribedItem&) const = default;
};

struct DescribedCommand {
    std::string name, description;
    std::vector<DescribedAttribute> attributes;
    std::vector<DescribedItem> request, response;  // in the order of their records
    bool operator==(const DescribedCommand&) const = default;
};

struct DescribedRule {
    std::string name, description;
    std::vector<DescribedAttribute> attributes;
    bool operator==(const DescribedRule&) const = default;
};

struct TypeDescription {
    std::string name;
    TypeHash hash{};
    std::vector<std::string> parents;
    std::string description;
    std::vector<DescribedAttribute> attributes;
    std::vector<DescribedItem> data;
    std::vector<DescribedCommand> commands;
    std::vector<DescribedRule> rules;
    bool operator==(const TypeDescription&) const = default;
};

TypeDescription describe(const Type& type);

// The types described, read and checked as if they stood in a file that repeats what its types
// inherit. Nothing is believed: a type
// that has a finding, whose hash is not the one it says (`type-hash`), or that extends such a type
// is left out. Of one type at most 20 findings are reported.
TypeModel modelOf(std::span<const TypeDescription> types, Report& report);

// These types, their ancestors, and what their rules have as targets and create; sorted by name.
// Names that are not known are passed over.
std::vector<const Type*> closureOf(const TypeModel& model, std::span<const std::string> names);

}  // namespace cortex
