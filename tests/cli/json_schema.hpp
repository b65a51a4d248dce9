// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace cortex::test {

// Violations of a JSON schema, each with where it is. Knows what the committed schemas use; any
// other keyword is a violation, so that none is ignored.
std::vector<std::string> violations(const nlohmann::json& schema, const nlohmann::json& value);

// The same for the text of `explorer/cli/schemas/<name>.json`; text that is no JSON is one too.
std::string violationsOf(const std::string& name, const std::string& text);

}  // namespace cortex::test
