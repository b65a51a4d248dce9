// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

// What a server of Modbus/TCP does with octets: no sockets, no clock. After "MODBUS Application
// Protocol Specification V1.1b3" and "MODBUS Messaging on TCP/IP Implementation Guide V1.0b".
namespace cortex::modbus::sim {

using Octets = std::vector<std::uint8_t>;

enum class Exception : std::uint8_t {
    None = 0,
    Function = 1,  // no such function code here
    Address = 2,   // no such register here
    Value = 3,     // a number that cannot be, or a request that contradicts itself
    Failure = 4    // not now, or not to you
};

struct FunctionCode {
    static constexpr std::uint8_t readHolding = 3, readInput = 4, writeOne = 6, writeMany = 16,
                                  readAndWrite = 23, failed = 0x80;
};

// Whose registers are asked for. A range never goes beyond register FFFF.
class Registers {
public:
    virtual ~Registers() = default;
    virtual Exception read(std::uint16_t first, std::span<std::uint16_t> to) = 0;
    virtual Exception write(std::uint16_t first, std::span<const std::uint16_t> values) = 0;
};

// The answer to a request, both from the function code on. Any octets have one.
Octets answerTo(std::span<const std::uint8_t> request, Registers& registers);

// One request or answer with what its header says.
struct Frame {
    std::uint16_t transaction = 0;
    std::uint8_t unit = 0;
    Octets content;  // from the function code on

    std::uint8_t function() const { return content.empty() ? std::uint8_t{0} : content.front(); }
    Octets onTheWire() const;
};

// What has come over one connection, in pieces of any length.
class Inbox {
public:
    void add(std::span<const std::uint8_t> octets) {
        octets_.insert(octets_.end(), octets.begin(), octets.end());
    }
    // The next whole one. None: more is to come, or it is spoilt.
    std::optional<Frame> take();
    // What came is no Modbus/TCP, and nobody knows where the next request begins.
    bool isSpoilt() const { return isSpoilt_; }

private:
    Octets octets_;
    bool isSpoilt_ = false;
};

}  // namespace cortex::modbus::sim
