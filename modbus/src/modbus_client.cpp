// SPDX-License-Identifier: Apache-2.0
#include "modbus_client.hpp"

#include "tcp_socket.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <new>
#include <utility>

namespace cortex::modbus {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::duration_cast;
using std::chrono::microseconds;

// What a server answers in place of values: Modbus Application Protocol 1.1b3, section 7.
struct Exception {
    int error;  // of libmodbus
    const char* text;
    bool isRefusal;  // the same request will never be answered otherwise
};
constexpr std::array exceptions{
    Exception{EMBXILFUN, "illegal function (exception 1): it has nothing of this kind", true},
    Exception{EMBXILADD, "illegal data address (exception 2): addresses count from 0", true},
    Exception{EMBXILVAL, "illegal data value (exception 3): look into its manual", true},
    Exception{EMBXSFAIL, "server device failure (exception 4): look at the device", false},
    Exception{EMBXACK, "acknowledge (exception 5): it needs longer", false},
    Exception{EMBXSBUSY, "server device busy (exception 6): it is asked again", false},
    Exception{EMBXNACK, "negative acknowledge (exception 7): look at the device", false},
    Exception{EMBXMEMPAR, "memory parity error (exception 8): look at the device", false},
    Exception{EMBXGPATH, "gateway path unavailable (exception 10): look at its item unit", false},
    Exception{EMBXGTAR, "gateway target failed to respond (exception 11): look at its item unit",
              false},
};

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

void ModbusClient::setTimeout(const Request& request) {
    const auto left = duration_cast<microseconds>(deadline_ - Clock::now()).count();
    if (left <= 0) fail(request, ETIMEDOUT);
    modbus_set_response_timeout(context_.get(), static_cast<std::uint32_t>(left / 1'000'000),
                                static_cast<std::uint32_t>(left % 1'000'000));
}

void ModbusClient::fail(const Request& request, int error) const {
    const std::string what = words(request) + ": ";
    for (const Exception& each : exceptions) {
        if (each.error != error) continue;
        if (each.isRefusal) throw toolkit::LinkRefused(what + each.text);
        throw toolkit::LinkError(what + each.text);
    }
    if (error == ETIMEDOUT) {
        throw toolkit::LinkError(
            what + "no answer within " +
            std::to_string(duration_cast<std::chrono::milliseconds>(allowed_).count()) +
            " ms; look at the device, or raise responseTimeout");
    }
    if (isClosed(error)) throw toolkit::LinkError(what + "it closed the connection");
    if (error > MODBUS_ENOBASE)
        throw toolkit::LinkError(what + "its answer is none to this; is it a Modbus/TCP device?");
    throw toolkit::LinkError(what + std::strerror(error));
}

template <class Ask>
void ModbusClient::ask(const Request& request, const Ask& ask) {
    if (request.count == 0 || request.count > request.most || request.at < 0 ||
        static_cast<std::size_t>(request.at) + request.count > addresses) {
        throw Error(words(request) + ": a request has 1 to " + std::to_string(request.most) +
                    " of them, within the addresses 0 to 65535");
    }
    if (!isOpen_) fail(request, ECONNRESET);
    setTimeout(request);
    const int count = ask(context_.get(), request.at, static_cast<int>(request.count));
    if (count < 0) fail(request, errno);
    if (static_cast<std::size_t>(count) != request.count) fail(request, EMBBADDATA);
}

void ModbusClient::readCoils(int at, std::span<std::uint8_t> bits) {
    ask({"coils", false, at, bits.size(), mostBitsRead}, [&](modbus_t* to, int from, int count) {
        return modbus_read_bits(to, from, count, bits.data());
    });
}

void ModbusClient::readDiscreteInputs(int at, std::span<std::uint8_t> bits) {
    ask({"discrete inputs", false, at, bits.size(), mostBitsRead},
        [&](modbus_t* to, int from, int count) {
            return modbus_read_input_bits(to, from, count, bits.data());
        });
}

void ModbusClient::readHoldingRegisters(int at, std::span<std::uint16_t> words) {
    ask({"holding registers", false, at, words.size(), mostRegistersRead},
        [&](modbus_t* to, int from, int count) {
            return modbus_read_registers(to, from, count, words.data());
        });
}

void ModbusClient::readInputRegisters(int at, std::span<std::uint16_t> words) {
    ask({"input registers", false, at, words.size(), mostRegistersRead},
        [&](modbus_t* to, int from, int count) {
            return modbus_read_input_registers(to, from, count, words.data());
        });
}

void ModbusClient::writeCoils(int at, std::span<const std::uint8_t> bits) {
    ask({"coils", true, at, bits.size(), mostBitsWritten}, [&](modbus_t* to, int from, int count) {
        return modbus_write_bits(to, from, count, bits.data());
    });
}

void ModbusClient::writeRegisters(int at, std::span<const std::uint16_t> words) {
    ask({"registers", true, at, words.size(), mostRegistersWritten},
        [&](modbus_t* to, int from, int count) {
            return modbus_write_registers(to, from, count, words.data());
        });
}

void ModbusClient::writeAndReadRegisters(int writeAt, std::span<const std::uint16_t> written,
                                         int readAt, std::span<std::uint16_t> read) {
    const Request writing{"registers", true, writeAt, written.size(), mostWrittenBesideRead};
    if (written.empty() || written.size() > writing.most || writeAt < 0 ||
        static_cast<std::size_t>(writeAt) + written.size() > addresses) {
        throw Error(words(writing) + ": a request that also reads has 1 to " +
                    std::to_string(writing.most) + " of them, within the addresses 0 to 65535");
    }
    ask({"registers (beside writing)", false, readAt, read.size(), mostRegistersRead},
        [&](modbus_t* to, int from, int count) {
            return modbus_write_and_read_registers(to, writeAt, static_cast<int>(written.size()),
                                                   written.data(), from, count, read.data());
        });
}

}  // namespace cortex::modbus
