// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace cortex {

// Keys of TypeDeclaration::stated: "position.min", "command zero.available",
// "command zero.request speed.min", "rule axes.max".
inline std::string commandPrefix(std::string_view command) {
    return "command " + std::string{command} + ".";
}
inline std::string parameterPrefix(const std::string& commandPrefix, std::string_view list) {
    return commandPrefix + std::string{list} + " ";
}
inline std::string dataPrefix(std::string_view before, std::string_view item) {
    return std::string{before} + std::string{item} + ".";
}
inline std::string rulePrefix(std::string_view rule) { return "rule " + std::string{rule} + "."; }

// A key of its own: the declaration repeats everything that it inherits, as that of another agent
// does. So what it does not write has its default and is not inherited.
inline constexpr const char* wholeType = "whole type";

// Which attributes of one item a declaration states. Read from XML, "name" is among them and the
// list is complete; built in code, an attribute counts as stated where it differs from its default.
class Stated {
public:
    Stated(const std::set<std::string>& all, std::string prefix)
        : all_{all},
          prefix_{std::move(prefix)},
          complete_{all.contains(prefix_ + "name")},
          whole_{all.contains(wholeType)} {}

    bool operator()(const char* attribute, bool differsFromDefault) const {
        return whole_ || isWritten(attribute, differsFromDefault);
    }
    bool isWritten(const char* attribute, bool differsFromDefault) const {
        return all_.contains(prefix_ + attribute) || (!complete_ && differsFromDefault);
    }
    bool isWhole() const { return whole_; }
    // Not written at all: neither well nor, what was found already, wrongly.
    bool lacks(const std::string& attribute) const {
        return complete_ && !all_.contains(prefix_ + attribute) &&
               !all_.contains(prefix_ + "wrong " + attribute);
    }
    const std::string& prefix() const { return prefix_; }
    Stated under(const std::string& prefix) const { return {all_, prefix}; }

private:
    const std::set<std::string>& all_;
    std::string prefix_;
    bool complete_, whole_;
};

}  // namespace cortex
