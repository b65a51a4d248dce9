// SPDX-License-Identifier: Apache-2.0
#include "common/utc_text.hpp"

#include <algorithm>
#include <array>
#include <ctime>

namespace cortex::common {

namespace {

constexpr std::int64_t second = 1'000'000'000;

}  // namespace

std::string utcText(std::int64_t utc, int digits) {
    const std::int64_t nanoseconds = (utc % second + second) % second;
    const std::time_t seconds = (utc - nanoseconds) / second;
    std::tm parts{};
    gmtime_r(&seconds, &parts);
    std::array<char, 40> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts);
    const std::string fraction = std::to_string(second + nanoseconds).substr(1);
    const auto shown = static_cast<std::size_t>(std::clamp(digits, 0, 9));
    return text.data() + (shown > 0 ? '.' + fraction.substr(0, shown) : std::string{}) + 'Z';
}

}  // namespace cortex::common
