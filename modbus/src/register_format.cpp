// SPDX-License-Identifier: Apache-2.0
#include "register_format.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace cortex::modbus {
namespace {

struct Range {
    double least, greatest;
};
template <class T>
constexpr Range rangeOf{static_cast<double>(std::numeric_limits<T>::lowest()),
                        static_cast<double>(std::numeric_limits<T>::max())};

constexpr std::array ranges{rangeOf<std::int16_t>, rangeOf<std::uint16_t>, rangeOf<std::int32_t>,
                            rangeOf<std::uint32_t>, rangeOf<float>};

Range rangeIn(RegisterFormat format) { return ranges[static_cast<std::size_t>(format)]; }

double whole(double counts, RegisterFormat format) {
    return format == RegisterFormat::Float32 ? counts : std::round(counts);
}

}  // namespace

double countsIn(std::span<const std::uint16_t> words, RegisterFormat format, WordOrder order) {
    if (format == RegisterFormat::Signed16) return static_cast<std::int16_t>(words[0]);
    if (format == RegisterFormat::Unsigned16) return words[0];
    const std::uint32_t bits = joined(words.first<2>(), order);
    if (format == RegisterFormat::Signed32) return static_cast<std::int32_t>(bits);
    if (format == RegisterFormat::Unsigned32) return bits;
    return static_cast<double>(std::bit_cast<float>(bits));
}

double putCounts(double counts, RegisterFormat format, WordOrder order,
                 std::span<std::uint16_t> words) {
    const Range range = rangeIn(format);
    const double put = std::clamp(whole(counts, format), range.least, range.greatest);
    if (format == RegisterFormat::Float32) {
        split(std::bit_cast<std::uint32_t>(static_cast<float>(put)), order, words.first<2>());
        return static_cast<double>(static_cast<float>(put));
    }
    // A negative one as its two's complement.
    const auto bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(put));
    if (wordsOf(format) == 1)
        words[0] = static_cast<std::uint16_t>(bits & 0xFFFFU);
    else
        split(bits, order, words.first<2>());
    return put;
}

bool holds(double counts, RegisterFormat format) {
    const Range range = rangeIn(format);
    const double wanted = whole(counts, format);
    return wanted >= range.least && wanted <= range.greatest;
}

double ScaledRegisters::read(std::size_t place, std::span<const std::uint16_t> all) const {
    const double counts = countsIn(all.subspan(place * wordsOf(format)), format, order);
    return offset[place] + scale[place] * counts;
}

double ScaledRegisters::write(std::size_t place, double value, std::span<std::uint16_t> all) const {
    const double counts = (value - offset[place]) / scale[place];
    const double put = putCounts(counts, format, order, all.subspan(place * wordsOf(format)));
    return offset[place] + scale[place] * put;
}

bool ScaledRegisters::holds(std::size_t place, double value) const {
    return modbus::holds((value - offset[place]) / scale[place], format);
}

}  // namespace cortex::modbus
