// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/findings.hpp"
#include "cortex/core/type_model.hpp"

#include "base/text.hpp"
#include "files/xml_element.hpp"
#include "types/enum_names.hpp"

#include <functional>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cortex {

// One attribute that an element may have. `read` returns "" or what it expected.
template <class T>
struct AttributeReader {
    const char* name;
    std::string (*read)(T& target, std::string_view text);
    bool required = false;
};

// Where we are in a file and where findings go. `path` is the type or simplex concerned.
struct ElementReader {
    const std::string& file;
    Report& report;
    std::string path;
    bool keepsUnknown = false;  // attributes of later versions stay with the target

    Place place(int line) const { return {file, line}; }
    void error(const char* rule, int line, std::string message, std::string remedy = {}) const {
        report.error(path, rule, place(line), std::move(message), std::move(remedy));
    }
    void unknown(const char* rule, int line, const std::string& message, std::string_view wrong,
                 std::vector<std::string> valid) const;
    // Calls the function of each child's name; what is unknown, or text, is a finding.
    struct Child {
        const char* name;
        std::function<void(const XmlElement&)> read;
    };
    void children(const XmlElement& element, std::span<const Child> known) const;
    // The element's attributes into `target`; `stated`, if any, is told the names of those that are
    // known, with "wrong " before those whose value is. False if a required one is missing.
    template <class T>
    bool attributes(const XmlElement& element, std::span<const AttributeReader<T>> known, T& target,
                    const std::function<void(const std::string&)>& stated = {}) const;

private:
    void wrongValue(const XmlElement& element, const XmlAttribute& attribute,
                    const std::string& expected) const;
    void missing(const XmlElement& element, const char* attribute) const;
};

template <class T>
bool ElementReader::attributes(const XmlElement& element, std::span<const AttributeReader<T>> known,
                               T& target,
                               const std::function<void(const std::string&)>& stated) const {
    for (const XmlAttribute& attribute : element.attributes) {
        const auto same = [&](const auto& reader) { return attribute.name == reader.name; };
        const auto reader = std::find_if(known.begin(), known.end(), same);
        if constexpr (requires { target.unknown; }) {
            if (reader == known.end() && keepsUnknown) {
                target.unknown.emplace(attribute.name, attribute.value);
                continue;
            }
        }
        if (reader == known.end()) {
            std::vector<std::string> valid;
            for (const auto& each : known) valid.emplace_back(each.name);
            unknown(finding::unknownAttribute, attribute.line,
                    "<" + element.name + "> has no attribute " + inQuotes(attribute.name),
                    attribute.name, std::move(valid));
            continue;
        }
        const std::string expected = reader->read(target, attribute.value);
        if (!expected.empty()) wrongValue(element, attribute, expected);
        if (stated) stated((expected.empty() ? "" : "wrong ") + attribute.name);
    }
    bool complete = true;
    for (const auto& each : known) {
        if (!each.required || element.find(each.name)) continue;
        missing(element, each.name);
        complete = false;
    }
    return complete;
}

// Readers of attribute values: "" or what was expected.
inline std::string readText(std::string& target, std::string_view text) {
    target = text;
    return {};
}

inline std::string readBool(bool& target, std::string_view text) {
    const auto value = toBool(text);
    if (!value) return "true or false";
    target = *value;
    return {};
}

inline std::string readFloat(double& target, std::string_view text) {
    const auto value = toFloat(text);
    if (!value) return "a finite number";
    target = *value;
    return {};
}

inline std::string readCount(std::uint32_t& target, std::string_view text) {
    const auto value = toInt(text);
    if (!value || *value < 0 || *value >= std::numeric_limits<std::uint32_t>::max()) {
        return "a whole number from 0";
    }
    target = static_cast<std::uint32_t>(*value);
    return {};
}

inline std::string readNames(std::vector<std::string>& target, std::string_view text) {
    for (const std::string_view word : splitBlanks(text)) target.emplace_back(word);
    return target.empty() ? "one or more names, separated by blanks" : "";
}

template <class E>
std::string readEnum(E& target, std::string_view text) {
    const auto value = fromSpelling<E>(text);
    if (!value) return allSpellings<E>();
    target = *value;
    return {};
}

}  // namespace cortex
