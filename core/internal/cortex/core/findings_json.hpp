// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"

#include <string>
#include <utility>

// Findings as JSON, for programs that have a library for it: `Json` is its type of a value.
namespace cortex {

template <class Json>
Json findingsJson(const Report& report) {
    Json list = Json::array();
    for (const Finding& finding : report.findings) {
        list.push_back({{"severity", name(finding.severity)},
                        {"path", finding.path},
                        {"rule", finding.rule},
                        {"file", finding.place.file},
                        {"line", finding.place.line},
                        {"message", finding.message},
                        {"remedy", finding.remedy}});
    }
    return list;
}

// The way back. Throws what `Json` throws where the list is none of findings.
template <class Json>
Report findingsOf(const Json& list) {
    Report report;
    for (const Json& each : list) {
        Finding finding;
        const auto text = [&](const char* key) { return each.at(key).template get<std::string>(); };
        finding.severity = severityFromName(text("severity")).value_or(Severity::Error);
        finding.path = text("path");
        finding.rule = text("rule");
        finding.place = {text("file"), each.at("line").template get<int>()};
        finding.message = text("message");
        finding.remedy = text("remedy");
        report.add(std::move(finding));
    }
    return report;
}

}  // namespace cortex
