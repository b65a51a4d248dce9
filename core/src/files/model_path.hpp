// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace cortex {

struct FoundFile {
    std::optional<std::filesystem::path> file;
    std::string lookedFor;  // all that was tried, for the message
};

// Beside the including file (as given, without one), then in $CORTEX_PATH, then in the installed
// share/cortex.
FoundFile findModelFile(const std::filesystem::path& file, const std::string& includedFrom);

// The whole file, if it is readable and within the bounds.
std::optional<std::string> readModelFile(const std::filesystem::path& file, std::size_t octetsLeft,
                                         Report& report);

}  // namespace cortex
