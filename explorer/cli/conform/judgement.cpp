// SPDX-License-Identifier: Apache-2.0
#include "conform/judgement.hpp"

#include "cortex/core/value.hpp"

#include "common/number_text.hpp"

#include <cmath>

namespace cortex::cli::conform {
namespace {

constexpr double smallest = 1e-6, greatest = 1e12;  // without an exponent

}  // namespace

const char* name(Verdict verdict) {
    if (verdict == Verdict::Passed) return "passed";
    return verdict == Verdict::Failed ? "failed" : "skipped";
}

std::string numberText(double number, int digits) {
    const double size = std::abs(number);
    const bool isPlain = number == 0 || (size >= smallest && size < greatest);  // and a number
    return isPlain ? common::significantText(number, digits) : toText(number);
}

}  // namespace cortex::cli::conform
