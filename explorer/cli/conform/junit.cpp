// SPDX-License-Identifier: Apache-2.0
#include "conform/junit.hpp"

#include "cortex/core/printable.hpp"
#include "cortex/core/xml_text.hpp"

#include "common/utc_text.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::cli::conform {
namespace {

std::string attribute(const char* name, const std::string& value) {
    return std::string{" "} + name + "=\"" + xmlAttribute(printable(value)) + "\"";
}

std::string time(double seconds) {
    const auto milliseconds = std::llround(seconds * 1000);
    const std::string rest = std::to_string(1000 + milliseconds % 1000).substr(1);
    return attribute("time", std::to_string(milliseconds / 1000) + "." + rest);
}

std::string counts(std::size_t tests, std::size_t failures, std::size_t skipped) {
    return attribute("tests", std::to_string(tests)) +
           attribute("failures", std::to_string(failures)) + attribute("errors", "0") +
           attribute("skipped", std::to_string(skipped));
}

double secondsOf(const DeviceResults& device) {
    double all = 0;
    for (const Result& each : device.results) all += each.seconds;
    return all;
}

std::string caseText(const DeviceResults& device, const Result& result) {
    const std::string& text = result.judgement.text;
    std::string element = "    <testcase" +
                          attribute("classname", device.type + " " + device.path) +
                          attribute("name", result.test) + time(result.seconds);
    switch (result.judgement.verdict) {
        case Verdict::Failed:
            return element + ">\n      <failure" + attribute("message", text) +
                   "/>\n    </testcase>\n";
        case Verdict::Skipped:
            return element + ">\n      <skipped" + attribute("message", text) +
                   "/>\n    </testcase>\n";
        default:
            return element + (text.empty()
                                  ? "/>\n"
                                  : ">\n      <system-out>" + xmlAttribute(printable(text)) +
                                        "</system-out>\n    </testcase>\n");
    }
}

}  // namespace

std::size_t count(const DeviceResults& device, Verdict verdict) {
    return static_cast<std::size_t>(std::ranges::count_if(
        device.results, [&](const Result& each) { return each.judgement.verdict == verdict; }));
}

std::string junitText(const std::vector<DeviceResults>& devices, std::int64_t began) {
    std::size_t tests = 0, failures = 0, skips = 0;
    double seconds = 0;
    std::string suites;
    for (const DeviceResults& each : devices) {
        const std::size_t failed = count(each, Verdict::Failed);
        const std::size_t skipped = count(each, Verdict::Skipped);
        suites += "  <testsuite" + attribute("name", each.path) +
                  counts(each.results.size(), failed, skipped) + time(secondsOf(each)) +
                  attribute("timestamp", common::utcText(began, 0)) +
                  attribute("package", each.type) + attribute("hostname", each.agent) + ">\n";
        for (const Result& result : each.results) suites += caseText(each, result);
        suites += "  </testsuite>\n";
        tests += each.results.size();
        failures += failed;
        skips += skipped;
        seconds += secondsOf(each);
    }
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" +
           attribute("name", "cortex conform") + counts(tests, failures, skips) + time(seconds) +
           ">\n" + suites + "</testsuites>\n";
}

}  // namespace cortex::cli::conform
