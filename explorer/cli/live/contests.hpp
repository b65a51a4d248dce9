// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace cortex::cli {

// In words, which paths several agents have and who owns them: of a tree the top, with the number
// of paths below. What is beyond `most` such trees is only counted, in one more line.
std::vector<std::string> contestLines(const std::vector<comms::Contested>& all,
                                      std::size_t most = 8);

}  // namespace cortex::cli
