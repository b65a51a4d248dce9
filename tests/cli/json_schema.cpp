// SPDX-License-Identifier: Apache-2.0
#include "cli/json_schema.hpp"

#include <algorithm>
#include <fstream>
#include <regex>
#include <stdexcept>

namespace cortex::test {
namespace {

using nlohmann::json;

bool isOfType(const json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "integer") return value.is_number_integer();
    if (type == "number") return value.is_number();
    if (type == "null") return value.is_null();
    throw std::runtime_error("the schema has an unknown type " + type);
}

class SchemaCheck {
public:
    explicit SchemaCheck(const json& root) : root_{root} {}

    std::vector<std::string> run(const json& value) {
        check(root_, value, "$");
        return std::move(found_);
    }

private:
    void check(const json& schema, const json& value, const std::string& where) {
        for (const auto& [keyword, wanted] : schema.items()) {
            if (!apply(keyword, wanted, schema, value, where)) {
                found_.push_back(where + ": the schema has the unknown keyword " + keyword);
            }
        }
    }

    bool apply(const std::string& keyword, const json& wanted, const json& schema,
               const json& value, const std::string& where) {
        if (keyword == "$schema" || keyword == "title" || keyword == "description") return true;
        if (keyword == "$defs") return true;
        if (keyword == "$ref")
            checkReference(wanted, value, where);
        else if (keyword == "type")
            checkType(wanted, value, where);
        else if (keyword == "enum")
            require(std::ranges::count(wanted, value) > 0, where, "is none of " + wanted.dump());
        else if (keyword == "minimum")
            require(!value.is_number() || value >= wanted, where, "is too small");
        else if (keyword == "pattern")
            checkPattern(wanted, value, where);
        else if (keyword == "items")
            checkItems(wanted, value, where);
        else if (keyword == "properties")
            checkProperties(wanted, value, where);
        else if (keyword == "required")
            checkRequired(wanted, value, where);
        else if (keyword == "additionalProperties")
            checkAdditional(wanted, schema, value, where);
        else
            return false;
        return true;
    }

    void require(bool condition, const std::string& where, const std::string& what) {
        if (!condition) found_.push_back(where + " " + what);
    }

    void checkReference(const json& wanted, const json& value, const std::string& where) {
        check(root_.at(json::json_pointer{wanted.get<std::string>().substr(1)}), value, where);
    }

    void checkType(const json& wanted, const json& value, const std::string& where) {
        const json types = wanted.is_array() ? wanted : json::array({wanted});
        require(std::ranges::any_of(types, [&](const json& type) { return isOfType(value, type); }),
                where, "is " + value.dump() + ", not " + wanted.dump());
    }

    void checkPattern(const json& wanted, const json& value, const std::string& where) {
        if (!value.is_string()) return;
        require(std::regex_search(value.get<std::string>(), std::regex{wanted.get<std::string>()}),
                where, "does not match " + wanted.dump());
    }

    void checkItems(const json& wanted, const json& value, const std::string& where) {
        if (!value.is_array()) return;
        for (std::size_t i = 0; i < value.size(); ++i) {
            check(wanted, value[i], where + "[" + std::to_string(i) + "]");
        }
    }

    void checkProperties(const json& wanted, const json& value, const std::string& where) {
        if (!value.is_object()) return;
        for (const auto& [name, schema] : wanted.items()) {
            if (value.contains(name)) check(schema, value[name], where + "." + name);
        }
    }

    void checkRequired(const json& wanted, const json& value, const std::string& where) {
        for (const std::string name : wanted) {
            require(!value.is_object() || value.contains(name), where, "lacks " + name);
        }
    }

    void checkAdditional(const json& wanted, const json& schema, const json& value,
                         const std::string& where) {
        if (!value.is_object()) return;
        for (const auto& [name, each] : value.items()) {
            if (schema.contains("properties") && schema["properties"].contains(name)) continue;
            if (wanted.is_object())
                check(wanted, each, where + "." + name);
            else
                require(wanted.get<bool>(), where, "has also " + name);
        }
    }

    const json& root_;
    std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> violations(const json& schema, const json& value) {
    return SchemaCheck{schema}.run(value);
}

std::string violationsOf(const std::string& name, const std::string& text) {
    const std::string path = CORTEX_SOURCE_DIR "/explorer/cli/schemas/" + name + ".json";
    std::ifstream stream{path};
    const json schema = json::parse(stream);
    const json value = json::parse(text, nullptr, false);
    if (value.is_discarded()) return "no JSON: " + text;
    std::string all;
    for (const std::string& each : violations(schema, value)) all += each + "\n";
    return all;
}

}  // namespace cortex::test
