// SPDX-License-Identifier: Apache-2.0
#include "modbus_client.hpp"

#include "tcp_socket.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <new>
#include <utility>

#include <sys/socket.h>

namespace cortex::modbus {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::duration_cast;
using std::chrono::microseconds;

// What a server answers in place of values: Modbus Application Protocol 1.1b3, section 7.
struct Exception {
    std::uint8_t code;
    const char* text;
    bool isRefusal;  // the same request will never be answered otherwise
};
constexpr std::array exceptions{
    Exception{1, "illegal function (exception 1): it has nothing of this kind", true},
    Exception{2, "illegal data address (exception 2): addresses count from 0", true},
    Exception{3, "illegal data value (exception 3): look into its manual", true},
    Exception{4, "server device failure (exception 4): look at the device", false},
    Exception{5, "acknowledge (exception 5): it needs longer", false},
    Exception{6, "server device busy (exception 6): it is asked again", false},
    Exception{7, "negative acknowledge (exception 7): look at the device", false},
    Exception{8, "memory parity error (exception 8): look at the device", false},
    Exception{10, "gateway path unavailable (exception 10): look at its item unit", false},
    Exception{11, "gateway target failed to respond (exception 11): look at its item unit", false},
};
constexpr std::uint8_t isException = 0x80;  // in the function of an answer

// Before the function: transaction, protocol, how many octets follow, unit. Numbers have two
// octets, the high one first. MODBUS Messaging on TCP/IP 1.0b, section 3.1.3.
constexpr std::size_t headSize = 7, lengthAt = 4, protocolAt = 2;
constexpr int modbusProtocol = 0;

void add(std::vector<std::uint8_t>& octets, std::size_t number) {
    octets.push_back(static_cast<std::uint8_t>(number >> 8U & 0xFFU));
    octets.push_back(static_cast<std::uint8_t>(number & 0xFFU));
}

int numberAt(std::span<const std::uint8_t> octets, std::size_t at) {
    return octets[at] << 8 | octets[at + 1];
}

// The first place of a request and how many there are.
std::vector<std::uint8_t> placesOf(int at, std::size_t count) {
    std::vector<std::uint8_t> octets;
    add(octets, static_cast<std::size_t>(at));
    add(octets, count);
    return octets;
}

std::vector<std::uint8_t> octetsOf(std::span<const std::uint16_t> words) {
    std::vector<std::uint8_t> octets;
    for (const std::uint16_t word : words) add(octets, word);
    return octets;
}

std::unique_ptr<modbus_t, void (*)(modbus_t*)> newContext() {
    // Neither host nor port are used: the socket is connected elsewhere.
    std::unique_ptr<modbus_t, void (*)(modbus_t*)> context{modbus_new_tcp("127.0.0.1", defaultPort),
                                                           &modbus_free};
    if (context == nullptr) throw std::bad_alloc();
    // So that an answer octet by octet has no more time than a whole one.
    modbus_set_byte_timeout(context.get(), 0, 0);
    return context;
}

bool isClosed(int error) { return error == ECONNRESET || error == EPIPE || error == ECONNABORTED; }

}  // namespace

ModbusClient::ModbusClient(Settings settings)
    : settings_{std::move(settings)}, context_{newContext()} {
    if (modbus_set_slave(context_.get(), settings_.unit) != 0) {
        throw Error("unit " + std::to_string(settings_.unit) +
                    " is none of Modbus; write 0 to 247, or 255 for a device with no others");
    }
}

void ModbusClient::connect() {
    close();
    modbus_set_socket(context_.get(), connectTo(settings_.server, connectTimeout));
    isOpen_ = true;
    allow(settings_.responseTimeout);
}

void ModbusClient::close() noexcept {
    if (std::exchange(isOpen_, false)) modbus_close(context_.get());
}

void ModbusClient::allow(std::chrono::nanoseconds time) {
    allowed_ = time;
    deadline_ = Clock::now() + time;
}

std::string ModbusClient::words(const Request& request) const {
    return settings_.server.text() + ": " + (request.writes ? "writing " : "reading ") +
           std::to_string(request.count) + " " + request.what + " at " + std::to_string(request.at);
}

void ModbusClient::check(const Request& request) const {
    if (request.count != 0 && request.count <= request.most && request.at >= 0 &&
        static_cast<std::size_t>(request.at) + request.count <= addresses) {
        return;
    }
    throw Error(words(request) + ": a request has 1 to " + std::to_string(request.most) +
                " of them, within the addresses 0 to 65535");
}

void ModbusClient::setTimeout(const Request& request) {
    const auto left = duration_cast<microseconds>(deadline_ - Clock::now()).count();
    if (left <= 0) fail(request, ETIMEDOUT);
    modbus_set_response_timeout(context_.get(), static_cast<std::uint32_t>(left / 1'000'000),
                                static_cast<std::uint32_t>(left % 1'000'000));
}

void ModbusClient::failByException(const Request& request, std::uint8_t code) const {
    const auto* const found = std::ranges::find(exceptions, code, &Exception::code);
    if (found == exceptions.end()) failByAnswer(request);
    const std::string what = words(request) + ": " + found->text;
    if (found->isRefusal) throw toolkit::LinkRefused(what);
    throw toolkit::LinkError(what);
}

void ModbusClient::failByAnswer(const Request& request) const {
    throw toolkit::LinkError(words(request) +
                             ": its answer is none to this; is it a Modbus/TCP device?");
}

void ModbusClient::fail(const Request& request, int error) const {
    const std::string what = words(request) + ": ";
    if (error == ETIMEDOUT) {
        throw toolkit::LinkError(
            what + "no answer within " +
            std::to_string(duration_cast<std::chrono::milliseconds>(allowed_).count()) +
            " ms; look at the device, or raise responseTimeout");
    }
    if (isClosed(error)) throw toolkit::LinkError(what + "it closed the connection");
    if (error > MODBUS_ENOBASE) failByAnswer(request);
    throw toolkit::LinkError(what + std::strerror(error));
}

void ModbusClient::send(const Request& request, std::uint8_t function, const Octets& data) {
    Octets frame;
    add(frame, ++transaction_);
    add(frame, modbusProtocol);
    add(frame, 2 + data.size());
    frame.push_back(static_cast<std::uint8_t>(settings_.unit));
    frame.push_back(function);
    frame.insert(frame.end(), data.begin(), data.end());
    const int socket = modbus_get_socket(context_.get());
    const ssize_t sent = ::send(socket, frame.data(), frame.size(), MSG_NOSIGNAL);
    if (sent < 0) fail(request, errno);
    if (static_cast<std::size_t>(sent) != frame.size()) fail(request, EPIPE);
}

// What the answer says behind its function.
std::span<const std::uint8_t> ModbusClient::receive(const Request& request, std::uint8_t function) {
    const int size = modbus_receive_confirmation(context_.get(), answer_.data());
    if (size < 0) fail(request, errno);
    const auto all = std::span<const std::uint8_t>{answer_}.first(static_cast<std::size_t>(size));
    if (all.size() < headSize + 2 || numberAt(all, 0) != transaction_ ||
        numberAt(all, protocolAt) != modbusProtocol ||
        numberAt(all, lengthAt) != size - static_cast<int>(headSize) + 1) {
        failByAnswer(request);
    }
    if (const int unit = all[headSize - 1]; unit != settings_.unit) {
        throw toolkit::LinkError(words(request) + ": unit " + std::to_string(unit) +
                                 " answers; where that is this device, set its item unit to " +
                                 std::to_string(unit));
    }
    const std::uint8_t answered = all[headSize];
    if (answered == (function | isException)) failByException(request, all[headSize + 1]);
    if (answered != function) failByAnswer(request);
    return all.subspan(headSize + 1);
}

// Returns what is answered behind the function, which are `answered` octets.
std::span<const std::uint8_t> ModbusClient::ask(const Request& request, std::uint8_t function,
                                                const Octets& data, std::size_t answered) {
    if (!isOpen_) fail(request, ECONNRESET);
    setTimeout(request);
    send(request, function, data);
    const auto answer = receive(request, function);
    if (answer.size() != answered) failByAnswer(request);
    return answer;
}

void ModbusClient::readBits(const Request& request, std::uint8_t function,
                            std::span<std::uint8_t> bits) {
    check(request);
    const std::size_t octets = (bits.size() + 7) / 8;
    const auto answer = ask(request, function, placesOf(request.at, bits.size()), 1 + octets);
    if (answer[0] != octets) failByAnswer(request);
    for (std::size_t i = 0; i < bits.size(); ++i)
        bits[i] = static_cast<std::uint8_t>(answer[1 + i / 8] >> i % 8 & 1);
}

void ModbusClient::readWords(const Request& request, std::uint8_t function, const Octets& data,
                             std::span<std::uint16_t> words) {
    check(request);
    const std::size_t octets = 2 * words.size();
    const auto answer = ask(request, function, data, 1 + octets);
    if (answer[0] != octets) failByAnswer(request);
    for (std::size_t i = 0; i < words.size(); ++i)
        words[i] = static_cast<std::uint16_t>(numberAt(answer, 1 + 2 * i));
}

// The answer repeats which places were written.
void ModbusClient::write(const Request& request, std::uint8_t function, const Octets& values) {
    const Octets places = placesOf(request.at, request.count);
    Octets data = places;
    data.push_back(static_cast<std::uint8_t>(values.size()));
    data.insert(data.end(), values.begin(), values.end());
    if (!std::ranges::equal(ask(request, function, data, places.size()), places))
        failByAnswer(request);
}

void ModbusClient::readCoils(int at, std::span<std::uint8_t> bits) {
    readBits({"coils", false, at, bits.size(), mostBitsRead}, MODBUS_FC_READ_COILS, bits);
}

void ModbusClient::readDiscreteInputs(int at, std::span<std::uint8_t> bits) {
    readBits({"discrete inputs", false, at, bits.size(), mostBitsRead},
             MODBUS_FC_READ_DISCRETE_INPUTS, bits);
}

void ModbusClient::readHoldingRegisters(int at, std::span<std::uint16_t> words) {
    readWords({"holding registers", false, at, words.size(), mostRegistersRead},
              MODBUS_FC_READ_HOLDING_REGISTERS, placesOf(at, words.size()), words);
}

void ModbusClient::readInputRegisters(int at, std::span<std::uint16_t> words) {
    readWords({"input registers", false, at, words.size(), mostRegistersRead},
              MODBUS_FC_READ_INPUT_REGISTERS, placesOf(at, words.size()), words);
}

void ModbusClient::writeCoils(int at, std::span<const std::uint8_t> bits) {
    const Request request{"coils", true, at, bits.size(), mostBitsWritten};
    check(request);
    Octets values((bits.size() + 7) / 8);
    for (std::size_t i = 0; i < bits.size(); ++i) {
        if (bits[i] != 0) values[i / 8] |= static_cast<std::uint8_t>(1U << i % 8);
    }
    write(request, MODBUS_FC_WRITE_MULTIPLE_COILS, values);
}

void ModbusClient::writeRegisters(int at, std::span<const std::uint16_t> words) {
    const Request request{"registers", true, at, words.size(), mostRegistersWritten};
    check(request);
    write(request, MODBUS_FC_WRITE_MULTIPLE_REGISTERS, octetsOf(words));
}

void ModbusClient::writeAndReadRegisters(int writeAt, std::span<const std::uint16_t> written,
                                         int readAt, std::span<std::uint16_t> read) {
    check({"registers (beside reading)", true, writeAt, written.size(), mostWrittenBesideRead});
    const Octets places = placesOf(writeAt, written.size()), values = octetsOf(written);
    Octets data = placesOf(readAt, read.size());
    data.insert(data.end(), places.begin(), places.end());
    data.push_back(static_cast<std::uint8_t>(values.size()));
    data.insert(data.end(), values.begin(), values.end());
    readWords({"registers (beside writing)", false, readAt, read.size(), mostRegistersRead},
              MODBUS_FC_WRITE_AND_READ_REGISTERS, data, read);
}

}  // namespace cortex::modbus
