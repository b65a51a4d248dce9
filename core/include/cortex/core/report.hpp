// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cortex {

// Where in a file something was written; built in code, the file is empty.
struct Place {
    std::string file;
    int line = 0;

    std::string text() const;  // "robotics.xml:14", or "" without a file
    bool operator==(const Place&) const = default;
};

enum class Severity { Info, Warning, Error };

const char* name(Severity severity);
std::optional<Severity> severityFromName(std::string_view text);

// One thing found in a model. `path` is the simplex or the type concerned, `rule` the short name of
// what was broken (see docs/findings.md), `remedy` what to write instead.
struct Finding {
    Severity severity = Severity::Error;
    std::string path;
    std::string rule;
    Place place;
    std::string message;
    std::string remedy;

    std::string text() const;  // "/arm: <message> [file:line]; <remedy>"
};

// Everything found, in the order in which it was found. A report with an Error refuses the model.
struct Report {
    std::vector<Finding> findings;

    Finding& add(Finding finding);
    Finding& error(std::string path, std::string rule, Place place, std::string message,
                   std::string remedy = {});
    Finding& warning(std::string path, std::string rule, Place place, std::string message,
                     std::string remedy = {});
    void append(const Report& other);

    bool ok() const { return errors() == 0; }
    std::size_t errors() const;
    std::string text() const;  // one finding a line
};

}  // namespace cortex
