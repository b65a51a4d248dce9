// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace cortex::cli::conform {

enum class Verdict : std::uint8_t { Passed, Failed, Skipped };
const char* name(Verdict verdict);  // "passed", "failed", "skipped"

// What a test says. A failed one: what was expected, what was seen, what to look at. A skipped one:
// why, and what would let it run.
struct Judgement {
    Verdict verdict = Verdict::Passed;
    std::string text;
};

inline Judgement passed(std::string text = "") { return {Verdict::Passed, std::move(text)}; }
inline Judgement failed(std::string text) { return {Verdict::Failed, std::move(text)}; }
inline Judgement skipped(std::string text) { return {Verdict::Skipped, std::move(text)}; }

// Thrown where a test cannot go on: its judgement.
struct Ended {
    Judgement judgement;
};

// A number as people read it; a device may also say what is none.
std::string numberText(double number, int digits = 4);

// One test of one device, or of one of its axes.
struct Result {
    std::string test;
    bool moves = false;
    Judgement judgement;
    double seconds = 0;
};

struct DeviceResults {
    std::string path, type, agent;
    std::vector<Result> results;
};

}  // namespace cortex::cli::conform
