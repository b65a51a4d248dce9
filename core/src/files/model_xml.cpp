// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/findings.hpp"

#include "base/bounds.hpp"
#include "base/text.hpp"
#include "files/xml_element.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <tinyxml2.h>

// The only file that knows the XML parser.
namespace cortex {

namespace {

using tinyxml2::XMLDocument;
using tinyxml2::XMLNode;

std::string trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n";
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    return std::string{text.substr(begin, text.find_last_not_of(blanks) - begin + 1)};
}

// What the parser says, without its own file's name and numbers.
std::pair<std::string, std::string> syntaxError(const XMLDocument& document) {
    switch (document.ErrorID()) {
        case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
            return {"the element that begins here is not closed before the end of another",
                    "close it with /> or with its own end tag"};
        case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
            return {"an attribute is given twice or is not of the form name=\"value\"",
                    "write each attribute once, with its value in quotes"};
        case tinyxml2::XML_ERROR_PARSING_ELEMENT:
            return {"an element is not well-formed", "check its name, its attributes and its end"};
        case tinyxml2::XML_ERROR_PARSING_COMMENT:
            return {"a comment is not closed", "end it with -->"};
        case tinyxml2::XML_ERROR_PARSING_CDATA:
            return {"a CDATA section is not closed", "end it with ]]>"};
        case tinyxml2::XML_ERROR_PARSING_TEXT:
            return {"the text ends inside of an element", "close every element"};
        case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
            return {"the file is empty", "write one element: ontology, morphology or system"};
        default:
            return {"the XML is not well-formed or ends too early",
                    "close every element; a declaration <?xml … ?> stands first"};
    }
}

class Converter {
public:
    Converter(const std::string& file, Report& report) : file_{file}, report_{report} {}

    std::optional<XmlElement> convert(const XMLDocument& document) {
        std::optional<XmlElement> root;
        for (const XMLNode* node = document.FirstChild(); node; node = node->NextSibling()) {
            if (node->ToComment() || node->ToDeclaration()) continue;
            const tinyxml2::XMLElement* element = node->ToElement();
            if (!element || root) {
                report_.error("", finding::xmlSyntax, {file_, node->GetLineNum()},
                              "there is something beside the one root element", "remove it");
                return std::nullopt;
            }
            root = convert(*element, 1);
        }
        if (!root) {
            report_.error("", finding::xmlSyntax, {file_, 1}, "the file has no element",
                          "write one: ontology, morphology or system");
        }
        if (tooDeep_) return std::nullopt;
        return root;
    }

private:
    XmlElement convert(const tinyxml2::XMLElement& source, std::size_t level) {
        XmlElement element;
        element.name = source.Name();
        element.line = source.GetLineNum();
        for (const auto* attribute = source.FirstAttribute(); attribute;
             attribute = attribute->Next()) {
            element.attributes.push_back(
                {attribute->Name(), attribute->Value(), attribute->GetLineNum()});
        }
        if (level > bounds::nesting) {
            tooDeep(element.line);
            return element;
        }
        for (const XMLNode* node = source.FirstChild(); node; node = node->NextSibling()) {
            if (const auto* child = node->ToElement()) {
                element.children.push_back(convert(*child, level + 1));
            } else if (const auto* text = node->ToText()) {
                element.text += text->Value();
            }
        }
        element.text = trimmed(element.text);
        return element;
    }

    void tooDeep(int line) {
        if (std::exchange(tooDeep_, true)) return;
        report_.error(
            "", finding::xmlNesting, {file_, line},
            "elements are nested deeper than " + std::to_string(bounds::nesting) + " levels",
            "no model needs more than 5");
    }

    const std::string& file_;
    Report& report_;
    bool tooDeep_ = false;
};

}  // namespace

const XmlAttribute* XmlElement::find(std::string_view attribute) const {
    const auto found = std::ranges::find(attributes, attribute, &XmlAttribute::name);
    return found == attributes.end() ? nullptr : &*found;
}

std::optional<XmlElement> parseXml(const std::string& file, const std::string& content,
                                   Report& report) {
    if (!guardXml(file, content, report)) return std::nullopt;
    XMLDocument document;
    document.Parse(content.data(), content.size());
    if (!document.Error()) return Converter{file, report}.convert(document);
    if (document.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED) {
        report.error(
            "", finding::xmlNesting, {file, document.ErrorLineNum()},
            "elements are nested deeper than " + std::to_string(bounds::nesting) + " levels",
            "no model needs more than 5");
        return std::nullopt;
    }
    auto [message, remedy] = syntaxError(document);
    report.error("", finding::xmlSyntax, {file, std::max(1, document.ErrorLineNum())},
                 std::move(message), std::move(remedy));
    return std::nullopt;
}

}  // namespace cortex
