// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace cortex::profiler {

// For people: three digits that say something, all those of whole numbers and before the point,
// in groups of three; "none" for what is not a number.
std::string readable(double value, std::string_view group = " ");

// With that many digits behind the point, in groups of three before it.
std::string fixed(double value, int decimals, std::string_view group = " ");

std::string exact(double value);  // reads back as the same; empty for what is not a number

std::string powerOfTen(int exponent);  // "10⁻³"

std::string escaped(std::string_view text);  // for HTML and SVG, between tags and in attributes

// Characters of UTF-8, `width` of them at most; what is cut off ends in "…".
std::size_t characters(std::string_view text);
std::string clipped(const std::string& text, std::size_t width);

}  // namespace cortex::profiler
