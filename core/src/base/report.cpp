// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/report.hpp"

#include "cortex/core/error.hpp"

#include <algorithm>
#include <utility>

namespace cortex {

std::string Place::text() const {
    if (file.empty()) return {};
    return line > 0 ? file + ":" + std::to_string(line) : file;
}

std::string Finding::text() const {
    std::string result = path.empty() ? message : path + ": " + message;
    if (!place.file.empty()) result += " [" + place.text() + "]";
    if (!remedy.empty()) result += "; " + remedy;
    return result;
}

Finding& Report::add(Finding finding) { return findings.emplace_back(std::move(finding)); }

Finding& Report::error(std::string path, std::string rule, Place place, std::string message,
                       std::string remedy) {
    return add({Severity::Error, std::move(path), std::move(rule), std::move(place),
                std::move(message), std::move(remedy)});
}

Finding& Report::warning(std::string path, std::string rule, Place place, std::string message,
                         std::string remedy) {
    return add({Severity::Warning, std::move(path), std::move(rule), std::move(place),
                std::move(message), std::move(remedy)});
}

void Report::append(const Report& other) {
    findings.insert(findings.end(), other.findings.begin(), other.findings.end());
}

std::size_t Report::errors() const {
    return static_cast<std::size_t>(
        std::ranges::count(findings, Severity::Error, &Finding::severity));
}

std::string Report::text() const {
    std::string result;
    for (const Finding& finding : findings) {
        if (finding.severity != Severity::Error) {
            result += name(finding.severity);
            result += ": ";
        }
        result += finding.text() + "\n";
    }
    return result;
}

ModelError::ModelError(Report report) : Error{report.text()}, report_{std::move(report)} {}

}  // namespace cortex
