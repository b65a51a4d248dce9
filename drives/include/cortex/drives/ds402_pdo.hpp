// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

// The usual process images of a CiA 402 drive on EtherCAT (CoE), little-endian and without gaps,
// and the scale between their whole numbers and the units of an axis. Tested against octets written
// by hand; never run on a wire. All may be called in a tick, by any thread: nothing allocates or
// throws.
namespace cortex::drives {

// What a master sends (RxPDO): 6040, 607A, 60FF, 6071, 6060 and an octet of padding.
struct Ds402RxPdo {
    std::uint16_t controlWord = 0;
    std::int32_t targetPosition = 0;  // counts
    std::int32_t targetVelocity = 0;  // counts per s
    std::int16_t targetTorque = 0;    // per mille of the rated effort
    std::int8_t mode = 0;

    bool operator==(const Ds402RxPdo&) const = default;
};

// What a drive sends (TxPDO): 6041, 6064, 606C, 6077, 6061 and an octet of padding.
struct Ds402TxPdo {
    std::uint16_t statusWord = 0;
    std::int32_t position = 0;  // counts
    std::int32_t velocity = 0;  // counts per s
    std::int16_t torque = 0;    // per mille of the rated effort
    std::int8_t modeDisplay = 0;

    bool operator==(const Ds402TxPdo&) const = default;
};

// The images themselves. Only the first `size` octets of a buffer are written or read; a shorter
// one is refused and stays as it is.
struct Ds402Pdo {
    static constexpr std::size_t size = 14;

    static bool pack(const Ds402RxPdo& values, std::span<std::byte> image) noexcept;
    static bool pack(const Ds402TxPdo& values, std::span<std::byte> image) noexcept;
    // False where the image is too short; then `values` stay as they are.
    static bool unpack(std::span<const std::byte> image, Ds402RxPdo& values) noexcept;
    static bool unpack(std::span<const std::byte> image, Ds402TxPdo& values) noexcept;
};

// Between the units of an axis and what drives count in. Both numbers are above 0.
struct Ds402Scale {
    double countsPerUnit = 1;
    double ratedEffort = 1;

    // Rounded to the nearest. Empty for what 32 bits do not hold, and for what is no number.
    std::optional<std::int32_t> counts(double value) const noexcept;
    double value(std::int32_t counts) const noexcept { return counts / countsPerUnit; }
    // Empty for what 16 bits do not hold, and for what is no number.
    std::optional<std::int16_t> perMille(double effort) const noexcept;
    double effort(std::int16_t perMille) const noexcept { return perMille * ratedEffort / 1000; }
};

}  // namespace cortex::drives
