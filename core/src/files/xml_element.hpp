// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cortex {

struct XmlAttribute {
    std::string name, value;
    int line = 0;
};

// An element of an XML file as the readers see it, without the parser's types.
struct XmlElement {
    std::string name;
    int line = 0;
    std::vector<XmlAttribute> attributes;
    std::vector<XmlElement> children;
    std::string text;  // its own, not that of its children; without blanks at both ends

    const XmlAttribute* find(std::string_view attribute) const;
};

// The root element, if `content` is well-formed and within the bounds; else why not is in the
// report. `file` is for places only.
std::optional<XmlElement> parseXml(const std::string& file, const std::string& content,
                                   Report& report);

// What the parser would accept or expand and we refuse: DOCTYPE, entities of one's own, characters
// that are not UTF-8, too many elements. False: the content must not be parsed.
bool guardXml(const std::string& file, std::string_view content, Report& report);

}  // namespace cortex
