// SPDX-License-Identifier: Apache-2.0
#include "files/element_reader.hpp"

#include "cortex/core/nearest_names.hpp"

#include <algorithm>

namespace cortex {

namespace {

std::string joined(const std::vector<std::string>& names) {
    std::string result;
    for (const std::string& each : names) result += (result.empty() ? "" : ", ") + each;
    return result;
}

}  // namespace

void ElementReader::unknown(const char* rule, int line, const std::string& message,
                            std::string_view wrong, std::vector<std::string> valid) const {
    std::string remedy = nearestNames(wrong, valid);
    if (remedy.empty()) remedy = "valid: " + joined(valid);
    error(rule, line, message, std::move(remedy));
}

void ElementReader::children(const XmlElement& element, std::span<const Child> known) const {
    for (const XmlElement& child : element.children) {
        const auto same = [&](const Child& each) { return child.name == each.name; };
        const auto found = std::find_if(known.begin(), known.end(), same);
        if (found != known.end()) {
            found->read(child);
            continue;
        }
        std::vector<std::string> valid;
        for (const Child& each : known) valid.emplace_back(each.name);
        if (valid.empty()) {
            error(
                finding::unknownElement, child.line,
                "<" + element.name + "> has no elements, found <" + child.name.substr(0, 80) + ">",
                "remove it");
        } else {
            unknown(finding::unknownElement, child.line,
                    "<" + element.name + "> has no element <" + child.name.substr(0, 80) + ">",
                    child.name, std::move(valid));
        }
    }
    if (!element.text.empty()) {
        error(finding::xmlText, element.line,
              "<" + element.name + "> contains the text " + inQuotes(element.text),
              "remove it, or make it a comment <!-- … -->");
    }
}

void ElementReader::wrongValue(const XmlElement& element, const XmlAttribute& attribute,
                               const std::string& expected) const {
    error(finding::attributeValue, attribute.line,
          "<" + element.name + "> cannot have " + attribute.name + "=" + inQuotes(attribute.value),
          "write " + expected);
}

void ElementReader::missing(const XmlElement& element, const char* attribute) const {
    error(finding::missingAttribute, element.line,
          "<" + element.name + "> lacks the attribute '" + attribute + "'",
          "add " + std::string{attribute} + "=\"…\"");
}

}  // namespace cortex
