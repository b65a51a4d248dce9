// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace cortex::profiler {

// For people, and the same everywhere: three digits that say something, all those of whole numbers
// and before the point, in groups of three; "none" for what is not a number.
std::string readable(double value);

std::string exact(double value);  // reads back as the same; empty for what is not a number

std::string escaped(std::string_view text);  // for HTML, between tags and in attributes

}  // namespace cortex::profiler
