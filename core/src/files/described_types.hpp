// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_description.hpp"

#include "files/xml_element.hpp"

#include <map>
#include <string_view>
#include <vector>

namespace cortex {

// Descriptions of types, which repeat what they inherit, as the elements that state the rest: a
// child's <type> has only what no parent of it says. Setup only; refers to the descriptions.
class DescribedTypes {
public:
    explicit DescribedTypes(const std::vector<const TypeDescription*>& types);

    XmlElement type(const TypeDescription& described) const;
    XmlElement rules(const TypeDescription& described) const;

private:
    // Items by name.
    struct Known {
        std::map<std::string_view, const DescribedItem*> data;
        std::map<std::string_view, const DescribedCommand*> commands;
        std::map<std::string_view, const DescribedRule*> rules;
        const TypeDescription* type = nullptr;
    };
    std::vector<const Known*> parentsOf(const TypeDescription& described) const;

    std::map<std::string_view, Known> known_;
};

}  // namespace cortex
