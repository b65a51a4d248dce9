// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

namespace cortex::test {

// What the program `cortex` printed and ended with. Runs in `folder`, with the variables added to
// those of the test and CORTEX_PATH naming the shipped ontology; an empty value removes one.
struct Outcome {
    int exit = -1;  // -1: ended by a signal
    std::string output, errors;
};
Outcome cortex(const std::vector<std::string>& arguments,
               const std::map<std::string, std::string>& environment = {},
               const std::string& folder = ".");
// The same of several that run at once.
std::vector<Outcome> cortexAtOnce(const std::vector<std::vector<std::string>>& commands,
                                  const std::map<std::string, std::string>& environment = {});

// Runs another program the same way; it is looked for in PATH.
Outcome runProgram(const std::string& program, const std::vector<std::string>& arguments,
                   const std::map<std::string, std::string>& environment = {},
                   const std::string& folder = ".");

}  // namespace cortex::test
