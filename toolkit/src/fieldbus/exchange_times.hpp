// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/toolkit/fieldbus_link.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace cortex::toolkit {

// How long the exchanges of a link took. Of its thread.
class ExchangeTimes {
public:
    void add(std::chrono::nanoseconds time);
    // Last, greatest, and the time than which 99 % were not longer, to within 6 %.
    void write(LinkReport& report) const;

private:
    static constexpr std::uint64_t binsPerOctave = 16;  // of a logarithmic histogram of ns

    static std::size_t binOf(std::uint64_t time);
    static double endOf(std::size_t bin);
    double share99() const;

    std::array<std::uint64_t, binsPerOctave * 40> bins_{};
    std::uint64_t count_ = 0;
    double last_ = 0, greatest_ = 0;  // ns
};

}  // namespace cortex::toolkit
