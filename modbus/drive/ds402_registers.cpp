// SPDX-License-Identifier: Apache-2.0
#include "drive/ds402_registers.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace cortex::modbus {
namespace {

using drives::Ds402Parameters;
using Scale = Ds402ParameterRow::Scale;

// Octets of one register that mean two things.
template <class Octet>
struct Pair {
    Octet& high;
    Octet& low;
};

// The one list of the fields of an axis: place and member.
template <class Axis, class Visit>
    requires std::is_same_v<std::remove_const_t<Axis>, Ds402AxisTold>
void fieldsOf(Axis& axis, Visit visit) {
    visit(0x0, axis.controlWord);
    visit(0x1, axis.mode);
    visit(0x2, axis.position);
    visit(0x4, axis.velocity);
    visit(0x6, axis.effort);
    visit(0x7, axis.effortOffset);
    visit(0x8, axis.velocityOffset);
    visit(0xA, axis.outputs);
}

template <class Axis, class Visit>
    requires std::is_same_v<std::remove_const_t<Axis>, Ds402AxisSeen>
void fieldsOf(Axis& axis, Visit visit) {
    visit(0x0, axis.statusWord);
    visit(0x1, axis.mode);
    visit(0x2, axis.position);
    visit(0x4, axis.velocity);
    visit(0x6, axis.effort);
    visit(0x7, axis.errorCode);
    visit(0x8, axis.followingError);
    visit(0xA, axis.inputs);
    visit(0xC, axis.demand);
    visit(0xE, axis.temperature);
    visit(0xF, Pair{axis.refused, axis.lastTransition});
    visit(0x10, axis.flags);
    visit(0x11, axis.transitions);
}

// The same of a whole block. `visit` gets the place within the image.
template <class Block, class Visit>
void axesOf(Block& block, std::size_t step, Visit visit) {
    for (std::size_t i = 0; i < block.axes.size(); ++i)
        fieldsOf(block.axes[i], [&](std::size_t at, auto&& field) {
            visit(i * step + at, std::forward<decltype(field)>(field));
        });
}

template <class Block, class Visit>
    requires std::is_same_v<std::remove_const_t<Block>, Ds402Told>
void fieldsOf(Block& told, Visit visit) {
    axesOf(told, Ds402Map::writeStep, visit);
    visit(std::size_t{Ds402Map::heartbeat}, told.heartbeat);
}

template <class Block, class Visit>
    requires std::is_same_v<std::remove_const_t<Block>, Ds402Seen>
void fieldsOf(Block& seen, Visit visit) {
    axesOf(seen, Ds402Map::readStep, visit);
    constexpr std::size_t echo = Ds402Map::echo - Ds402Map::read;
    visit(echo, seen.heartbeat);
    visit(echo + 1, seen.time);
    visit(echo + 3, seen.layout);
}

struct Encoder {
    std::span<std::uint16_t> image;
    WordOrder order;

    template <class T>
    void operator()(std::size_t at, const T& field) const {
        if constexpr (sizeof(T) == 4)
            split(static_cast<std::uint32_t>(field), order, image.subspan(at).template first<2>());
        else
            image[at] = static_cast<std::uint16_t>(field);  // NOLINT: with its sign
    }
    template <class Octet>
    void operator()(std::size_t at, const Pair<Octet>& field) const {
        image[at] = static_cast<std::uint16_t>(field.high << 8 | field.low);
    }
};

struct Decoder {
    std::span<const std::uint16_t> image;
    WordOrder order;

    template <class T>
    void operator()(std::size_t at, T& field) const {
        if constexpr (sizeof(T) == 4)
            field = static_cast<T>(joined(image.subspan(at).template first<2>(), order));
        else
            field = static_cast<T>(image[at]);
    }
    void operator()(std::size_t at, const Pair<std::uint8_t>& field) const {
        field.high = static_cast<std::uint8_t>(image[at] >> 8);
        field.low = static_cast<std::uint8_t>(image[at]);
    }
};

template <class Image, class Block>
Image encoded(const Block& block, WordOrder order) {
    Image image{};
    fieldsOf(block, Encoder{image, order});
    return image;
}

template <class Block, class Image>
Block decoded(const Image& image, WordOrder order) {
    Block block{};
    fieldsOf(block, Decoder{image, order});
    return block;
}

constexpr std::size_t numbersOfIdentity = 4, serialOfIdentity = 12;

double factor(Scale scale, const Ds402Parameters& parameters) {
    switch (scale) {
        case Scale::Counts:
            return parameters.countsPerUnit;
        case Scale::Thousandths:
            return 1000;
        default:
            return 1;
    }
}

std::int32_t clamped(double value) {
    using Limits = std::numeric_limits<std::int32_t>;
    if (!(value > Limits::min())) return Limits::min();  // no number, too
    return value < Limits::max() ? static_cast<std::int32_t>(std::round(value)) : Limits::max();
}

// A parameter as its registers count it.
double counted(const Ds402ParameterRow& row, const Ds402Parameters& parameters) {
    const double value = std::visit(
        [&](auto member) { return static_cast<double>(parameters.*member); }, row.member);
    return value * factor(row.scale, parameters);
}

}  // namespace

Ds402TellImage encode(const Ds402Told& told, WordOrder order) noexcept {
    return encoded<Ds402TellImage>(told, order);
}

Ds402SeeImage encode(const Ds402Seen& seen, WordOrder order) noexcept {
    return encoded<Ds402SeeImage>(seen, order);
}

Ds402Told decode(const Ds402TellImage& image, WordOrder order) noexcept {
    return decoded<Ds402Told>(image, order);
}

Ds402Seen decode(const Ds402SeeImage& image, WordOrder order) noexcept {
    return decoded<Ds402Seen>(image, order);
}

const std::array<Ds402ParameterRow, ds402ParameterCount>& ds402ParameterRows() noexcept {
    using P = Ds402Parameters;
    static constexpr auto rows = std::to_array<Ds402ParameterRow>({
        {0x605A, 0, Scale::Whole, false, &P::quickStopOption, "quick stop option"},
        {0x605B, 0, Scale::Whole, false, &P::shutdownOption, "shutdown option"},
        {0x605C, 0, Scale::Whole, false, &P::disableOption, "disable operation option"},
        {0x605D, 0, Scale::Whole, false, &P::haltOption, "halt option"},
        {0x605E, 0, Scale::Whole, false, &P::faultReactionOption, "fault reaction option"},
        {0x6007, 0, Scale::Whole, false, &P::abortOption, "option for a lost connection"},
        {0x6065, 0, Scale::Counts, false, &P::followingErrorWindow, "following error window"},
        {0x6066, 0, Scale::Thousandths, false, &P::followingErrorTime, "following error time"},
        {0x6076, 0, Scale::Thousandths, true, &P::ratedEffort, "rated effort"},
        {0x607C, 0, Scale::Counts, false, &P::homeOffset, "home offset"},
        {0x607D, 1, Scale::Counts, false, &P::softMin, "least position"},
        {0x607D, 2, Scale::Counts, false, &P::softMax, "greatest position"},
        {0x607F, 0, Scale::Counts, false, &P::maxVelocity, "greatest velocity"},
        {0x6081, 0, Scale::Counts, false, &P::profileVelocity, "profile velocity"},
        {0x6083, 0, Scale::Counts, false, &P::profileAcceleration, "profile acceleration"},
        {0x6085, 0, Scale::Counts, false, &P::quickStopDeceleration, "quick stop deceleration"},
        {0x608F, 0, Scale::Whole, true, &P::countsPerUnit, "counts per unit"},
        {0x6098, 0, Scale::Whole, false, &P::homingMethod, "homing method"},
        {0x6099, 1, Scale::Counts, false, &P::homingSpeed, "homing speed"},
        {0x6099, 2, Scale::Counts, false, &P::homingCreep, "homing creep speed"},
        {0x609A, 0, Scale::Counts, false, &P::homingAcceleration, "homing acceleration"},
        {0x6502, 0, Scale::Whole, true, &P::supportedModes, "supported modes"},
    });
    return rows;
}

Ds402ParameterImage encode(const Ds402Parameters& parameters) noexcept {
    Ds402ParameterImage image{};
    for (std::size_t i = 0; i < image.size(); ++i)
        image[i] = clamped(counted(ds402ParameterRows()[i], parameters));
    return image;
}

const Ds402ParameterRow* firstBeyond(const Ds402Parameters& parameters) noexcept {
    for (const Ds402ParameterRow& row : ds402ParameterRows()) {
        const double value = counted(row, parameters);
        if (!(std::abs(value) < -static_cast<double>(std::numeric_limits<std::int32_t>::min())))
            return &row;
    }
    return nullptr;
}

std::string_view parameterName(std::uint16_t object) noexcept {
    for (const Ds402ParameterRow& row : ds402ParameterRows())
        if (row.object == object) return row.name;
    return {};
}

Ds402Parameters decode(const Ds402ParameterImage& image, const Ds402Parameters& before) noexcept {
    Ds402Parameters parameters = before;
    const Ds402ParameterImage there = encode(before);
    for (std::size_t i = 0; i < image.size(); ++i) {
        const Ds402ParameterRow& row = ds402ParameterRows()[i];
        if (row.isFixed || image[i] == there[i]) continue;
        std::visit(
            [&](auto member) {
                using Value = std::remove_reference_t<decltype(parameters.*member)>;
                if constexpr (std::is_same_v<Value, double>)
                    parameters.*member = image[i] / factor(row.scale, before);
                else
                    parameters.*member = static_cast<Value>(image[i]);
            },
            row.member);
    }
    return parameters;
}

Ds402IdentityImage encode(const Ds402Identity& identity, WordOrder order) noexcept {
    Ds402IdentityImage image{};
    const std::span<std::uint16_t> all{image};
    std::uint32_t name = 0;
    for (const char letter : identity.name) name = name << 8 | static_cast<std::uint8_t>(letter);
    split(name, order, all.first<2>());
    image[2] = identity.axes;
    for (std::size_t i = 0; i < identity.countsPerUnit.size(); ++i) {
        const auto bits = std::bit_cast<std::uint64_t>(identity.countsPerUnit[i]);
        for (std::size_t word = 0; word < 4; ++word) {
            const std::size_t at = order == WordOrder::HighWordFirst ? 3 - word : word;
            image[numbersOfIdentity + 4 * i + at] = static_cast<std::uint16_t>(bits >> (16 * word));
        }
    }
    split(identity.serial, order, all.subspan<serialOfIdentity, 2>());
    return image;
}

Ds402Identity decode(const Ds402IdentityImage& image, WordOrder order) noexcept {
    Ds402Identity identity;
    const std::span<const std::uint16_t> all{image};
    const std::uint32_t name = joined(all.first<2>(), order);
    for (std::size_t i = 0; i < identity.name.size(); ++i)
        identity.name[i] = static_cast<char>(name >> (24 - 8 * i));
    identity.axes = image[2];
    for (std::size_t i = 0; i < identity.countsPerUnit.size(); ++i) {
        std::uint64_t bits = 0;
        for (std::size_t word = 0; word < 4; ++word) {
            const std::size_t at = order == WordOrder::HighWordFirst ? 3 - word : word;
            bits |= std::uint64_t{image[numbersOfIdentity + 4 * i + at]} << (16 * word);
        }
        identity.countsPerUnit[i] = std::bit_cast<double>(bits);
    }
    identity.serial = joined(all.subspan<serialOfIdentity, 2>(), order);
    return identity;
}

}  // namespace cortex::modbus
