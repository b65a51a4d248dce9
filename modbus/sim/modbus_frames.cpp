// SPDX-License-Identifier: Apache-2.0
#include "sim/modbus_frames.hpp"

#include <algorithm>
#include <cstddef>

namespace cortex::modbus::sim {
namespace {

constexpr std::size_t mostRead = 125, mostWritten = 123, mostWrittenAndRead = 121;
constexpr std::size_t header = 7, mostOfOne = 253;

std::uint16_t word(std::span<const std::uint8_t> octets, std::size_t at) {
    return static_cast<std::uint16_t>(octets[at] << 8 | octets[at + 1]);
}

void append(Octets& octets, std::uint16_t word) {
    octets.push_back(static_cast<std::uint8_t>(word >> 8));
    octets.push_back(static_cast<std::uint8_t>(word));
}

struct Range {
    std::uint16_t first, count;

    // `most` of a function code.
    Exception wrong(std::size_t most) const {
        if (count == 0 || count > most) return Exception::Value;
        return first + count > 0x10000 ? Exception::Address : Exception::None;
    }
};

Range range(std::span<const std::uint8_t> request, std::size_t at) {
    return {word(request, at), word(request, at + 2)};
}

// Appends count of octets and values.
Exception readInto(Octets& answer, Range wanted, Registers& registers) {
    if (const Exception wrong = wanted.wrong(mostRead); wrong != Exception::None) return wrong;
    std::vector<std::uint16_t> values(wanted.count);
    const Exception wrong = registers.read(wanted.first, values);
    if (wrong != Exception::None) return wrong;
    answer.push_back(static_cast<std::uint8_t>(2 * values.size()));
    for (const std::uint16_t value : values) append(answer, value);
    return Exception::None;
}

// `rest` begins with the count of octets, behind which nothing else stands than they.
Exception writeFrom(std::span<const std::uint8_t> rest, Range wanted, std::size_t most,
                    Registers& registers) {
    if (wanted.count == 0 || wanted.count > most) return Exception::Value;
    if (rest.size() != 1U + 2 * wanted.count || rest[0] != 2 * wanted.count)
        return Exception::Value;
    if (const Exception wrong = wanted.wrong(most); wrong != Exception::None) return wrong;
    std::vector<std::uint16_t> values;
    for (std::size_t i = 0; i < wanted.count; ++i) values.push_back(word(rest, 1 + 2 * i));
    return registers.write(wanted.first, values);
}

Exception writeOne(Octets& answer, std::span<const std::uint8_t> request, Registers& registers) {
    if (request.size() != 5) return Exception::Value;
    const std::uint16_t value = word(request, 3);
    const Exception wrong = registers.write(word(request, 1), {&value, 1});
    answer.assign(request.begin(), request.end());
    return wrong;
}

Exception writeMany(Octets& answer, std::span<const std::uint8_t> request, Registers& registers) {
    if (request.size() < 6) return Exception::Value;
    const Range wanted = range(request, 1);
    append(answer, wanted.first);
    append(answer, wanted.count);
    return writeFrom(request.subspan(5), wanted, mostWritten, registers);
}

// Writes first, as the specification says.
Exception writeAndRead(Octets& answer, std::span<const std::uint8_t> request,
                       Registers& registers) {
    if (request.size() < 10) return Exception::Value;
    const Range wanted = range(request, 1);
    if (const Exception wrong = wanted.wrong(mostRead); wrong != Exception::None) return wrong;
    const Exception wrong =
        writeFrom(request.subspan(9), range(request, 5), mostWrittenAndRead, registers);
    return wrong != Exception::None ? wrong : readInto(answer, wanted, registers);
}

Exception fill(Octets& answer, std::span<const std::uint8_t> request, Registers& registers) {
    switch (request[0]) {
        case FunctionCode::readHolding:
        case FunctionCode::readInput:
            if (request.size() != 5) return Exception::Value;
            return readInto(answer, range(request, 1), registers);
        case FunctionCode::writeOne:
            return writeOne(answer, request, registers);
        case FunctionCode::writeMany:
            return writeMany(answer, request, registers);
        case FunctionCode::readAndWrite:
            return writeAndRead(answer, request, registers);
        default:
            return Exception::Function;
    }
}

}  // namespace

Octets answerTo(std::span<const std::uint8_t> request, Registers& registers) {
    const std::uint8_t function = request.empty() ? std::uint8_t{0} : request[0];
    Octets answer{function};
    const Exception wrong =
        request.empty() ? Exception::Function : fill(answer, request, registers);
    if (wrong != Exception::None)
        answer = {static_cast<std::uint8_t>(function | FunctionCode::failed),
                  static_cast<std::uint8_t>(wrong)};
    return answer;
}

Octets Frame::onTheWire() const {
    Octets octets;
    append(octets, transaction);
    append(octets, 0);
    append(octets, static_cast<std::uint16_t>(content.size() + 1));
    octets.push_back(unit);
    octets.insert(octets.end(), content.begin(), content.end());
    return octets;
}

std::optional<Frame> Inbox::take() {
    if (isSpoilt_ || octets_.size() < header) return std::nullopt;
    const std::size_t length = word(octets_, 4);  // of unit and content
    isSpoilt_ = word(octets_, 2) != 0 || length < 2 || length > mostOfOne + 1;
    const std::size_t whole = header - 1 + length;
    if (isSpoilt_ || octets_.size() < whole) return std::nullopt;
    Frame frame{word(octets_, 0), octets_[6], {}};
    const auto begin = octets_.begin();
    frame.content.assign(begin + header, begin + static_cast<std::ptrdiff_t>(whole));
    octets_.erase(begin, begin + static_cast<std::ptrdiff_t>(whole));
    return frame;
}

}  // namespace cortex::modbus::sim
