// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/toolkit/fieldbus_link.hpp"

#include "modbus_address.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <modbus/modbus.h>

namespace cortex::modbus {

// A connection to one Modbus/TCP server, by libmodbus. For one thread, which it may block; each
// function returns within its time. Addresses are those on the wire: they count from 0.
//
// What goes wrong is told as toolkit::LinkError, "host:port: what; remedy", or as LinkRefused where
// the server knows no such function, address or value. close() then, and connect() anew: the next
// request might take a late answer for its own. libmodbus waits for an answer and cuts it out; what
// is no answer to the request is found here, the addresses that are echoed included.
class ModbusClient {
public:
    struct Settings {
        ModbusAddress server;
        int unit = 1;  // 0 to 255: which device behind a gateway
        std::chrono::nanoseconds responseTimeout{20'000'000};
    };
    static constexpr std::chrono::milliseconds connectTimeout{500};
    static constexpr std::size_t addresses = 65536;  // of each kind of place
    // Of one request.
    static constexpr std::size_t mostBitsRead = 2000, mostBitsWritten = 1968;
    static constexpr std::size_t mostRegistersRead = 125, mostRegistersWritten = 123;
    static constexpr std::size_t mostWrittenBesideRead = 121;

    explicit ModbusClient(Settings settings);  // connects to nobody yet
    const Settings& settings() const { return settings_; }

    void connect();         // at most connectTimeout
    void close() noexcept;  // may be called twice
    bool isOpen() const { return isOpen_; }

    // The answers to all requests from here on take at most `time` together. connect() allows for
    // a responseTimeout.
    void allow(std::chrono::nanoseconds time);

    // A bit is 0 or 1. Each throws Error where the values are none, too many for a request, or
    // beyond address 65535.
    void readCoils(int at, std::span<std::uint8_t> bits);               // function code 1
    void readDiscreteInputs(int at, std::span<std::uint8_t> bits);      // 2
    void readHoldingRegisters(int at, std::span<std::uint16_t> words);  // 3
    void readInputRegisters(int at, std::span<std::uint16_t> words);    // 4
    void writeCoils(int at, std::span<const std::uint8_t> bits);        // 15
    void writeRegisters(int at, std::span<const std::uint16_t> words);  // 16
    // Function code 23: the server writes before it reads.
    void writeAndReadRegisters(int writeAt, std::span<const std::uint16_t> written, int readAt,
                               std::span<std::uint16_t> read);

private:
    struct Request {
        const char* what;  // "input registers"
        bool writes;
        int at;
        std::size_t count, most;
    };
    using Octets = std::vector<std::uint8_t>;
    std::string words(const Request& request) const;
    void check(const Request& request) const;  // throws Error
    void readBits(const Request& request, std::uint8_t function, std::span<std::uint8_t> bits);
    void readWords(const Request& request, std::uint8_t function, const Octets& data,
                   std::span<std::uint16_t> words);
    void write(const Request& request, std::uint8_t function, const Octets& values);
    std::span<const std::uint8_t> ask(const Request& request, std::uint8_t function,
                                      const Octets& data, std::size_t answered);
    void send(const Request& request, std::uint8_t function, const Octets& data);
    std::span<const std::uint8_t> receive(const Request& request, std::uint8_t function);
    void setTimeout(const Request& request);
    [[noreturn]] void fail(const Request& request, int error) const;
    [[noreturn]] void failByException(const Request& request, std::uint8_t code) const;
    [[noreturn]] void failByAnswer(const Request& request) const;

    Settings settings_;
    std::unique_ptr<modbus_t, void (*)(modbus_t*)> context_;
    std::chrono::steady_clock::time_point deadline_{};
    std::chrono::nanoseconds allowed_{};
    bool isOpen_ = false;
    std::uint16_t transaction_ = 0;  // of the last request
    std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> answer_{};
};

}  // namespace cortex::modbus
