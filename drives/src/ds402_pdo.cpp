// SPDX-License-Identifier: Apache-2.0
#include "cortex/drives/ds402_pdo.hpp"

#include <cmath>
#include <limits>
#include <type_traits>

namespace cortex::drives {
namespace {

template <class T>
std::byte* put(std::byte* at, T value) {
    const auto bits = static_cast<std::make_unsigned_t<T>>(value);
    for (std::size_t i = 0; i < sizeof(T); ++i) *at++ = static_cast<std::byte>(bits >> 8 * i);
    return at;
}

template <class T>
const std::byte* take(const std::byte* at, T& value) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i)
        bits |= std::to_integer<std::uint32_t>(*at++) << 8 * i;
    value = static_cast<T>(bits);
    return at;
}

template <class Pdo, class Visit>
bool visit(Pdo& values, Visit&& each) {
    if constexpr (requires { values.controlWord; })
        each(values.controlWord, values.targetPosition, values.targetVelocity, values.targetTorque,
             values.mode);
    else
        each(values.statusWord, values.position, values.velocity, values.torque,
             values.modeDisplay);
    return true;
}

template <class Pdo>
bool packAny(const Pdo& values, std::span<std::byte> image) {
    if (image.size() < Ds402Pdo::size) return false;
    std::byte* at = image.data();
    const auto write = [&](const auto&... fields) { ((at = put(at, fields)), ...); };
    visit(values, write);
    put(at, std::uint8_t{0});
    return true;
}

template <class Pdo>
bool unpackAny(std::span<const std::byte> image, Pdo& values) {
    if (image.size() < Ds402Pdo::size) return false;
    const std::byte* at = image.data();
    const auto read = [&](auto&... fields) { ((at = take(at, fields)), ...); };
    return visit(values, read);
}

template <class T>
std::optional<T> nearest(double value) {
    const double rounded = std::round(value);
    if (!(rounded >= std::numeric_limits<T>::min() && rounded <= std::numeric_limits<T>::max()))
        return {};
    return static_cast<T>(rounded);
}

}  // namespace

bool Ds402Pdo::pack(const Ds402RxPdo& values, std::span<std::byte> image) noexcept {
    return packAny(values, image);
}

bool Ds402Pdo::pack(const Ds402TxPdo& values, std::span<std::byte> image) noexcept {
    return packAny(values, image);
}

bool Ds402Pdo::unpack(std::span<const std::byte> image, Ds402RxPdo& values) noexcept {
    return unpackAny(image, values);
}

bool Ds402Pdo::unpack(std::span<const std::byte> image, Ds402TxPdo& values) noexcept {
    return unpackAny(image, values);
}

std::optional<std::int32_t> Ds402Scale::counts(double value) const noexcept {
    return nearest<std::int32_t>(value * countsPerUnit);
}

std::optional<std::int16_t> Ds402Scale::perMille(double effort) const noexcept {
    return nearest<std::int16_t>(effort / ratedEffort * 1000);
}

}  // namespace cortex::drives
