// SPDX-License-Identifier: Apache-2.0
#include "fieldbus/exchange_times.hpp"

#include <algorithm>
#include <bit>

namespace cortex::toolkit {

// The octave, then the four bits behind the highest one.
std::size_t ExchangeTimes::binOf(std::uint64_t time) {
    if (time < binsPerOctave) return time;
    const auto octave = static_cast<std::size_t>(std::bit_width(time)) - 5;
    return (octave + 1) * binsPerOctave + ((time >> octave) - binsPerOctave);
}

double ExchangeTimes::endOf(std::size_t bin) {
    if (bin < binsPerOctave) return static_cast<double>(bin);
    const std::size_t octave = bin / binsPerOctave - 1;
    return static_cast<double>((binsPerOctave + bin % binsPerOctave + 1) << octave);
}

void ExchangeTimes::add(std::chrono::nanoseconds time) {
    const auto taken = static_cast<std::uint64_t>(std::max<std::int64_t>(time.count(), 0));
    ++bins_[std::min(binOf(taken), bins_.size() - 1)];
    ++count_;
    last_ = static_cast<double>(taken);
    greatest_ = std::max(greatest_, last_);
}

double ExchangeTimes::share99() const {
    const std::uint64_t wanted = count_ - count_ / 100;
    std::uint64_t below = 0;
    for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
        below += bins_[bin];
        if (below >= wanted) return std::min(endOf(bin), greatest_);
    }
    return greatest_;
}

void ExchangeTimes::write(LinkReport& report) const {
    report.timeLast = last_ * 1e-3;
    report.timeP99 = share99() * 1e-3;
    report.timeMax = greatest_ * 1e-3;
}

}  // namespace cortex::toolkit
