// SPDX-License-Identifier: Apache-2.0
// The client against a server of libmodbus.
#include "cortex/core/error.hpp"

#include "modbus/test_servers.hpp"
#include "modbus_client.hpp"
#include "modbus_words.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <modbus/modbus.h>

namespace cortex::modbus::test {
namespace {

using toolkit::LinkError;
using toolkit::LinkRefused;
using Words = std::vector<std::uint16_t>;

// No clock judges: whoever answers has time enough.
ModbusClient clientOf(const std::string& address, int unit = 1) {
    return ModbusClient{{ModbusAddress::parse(address), unit, std::chrono::seconds{30}}};
}

class Client : public testing::Test {
protected:
    Client() { client.connect(); }
    // What went out behind the number of the transaction.
    std::string lastRequest() {
        const Bytes request = server.requests().back();
        return hex({request.begin() + 2, request.end()});
    }

    ModbusServer server;
    ModbusClient client = clientOf(server.address());
};

TEST_F(Client, ReadsAndWritesEachKindOfPlaceOctetForOctet) {
    server.look([](modbus_mapping_t& map) {
        map.tab_input_bits[7] = map.tab_input_bits[9] = 1;
        map.tab_input_registers[3] = 0x1234;
        map.tab_input_registers[4] = 0xFFFE;
    });

    client.writeCoils(5, Bytes{1, 0, 1, 1});
    EXPECT_EQ(lastRequest(), "00 00 00 08 01 0f 00 05 00 04 01 0d");
    client.writeRegisters(20, Words{0x0102, 0xFFFE});
    EXPECT_EQ(lastRequest(), "00 00 00 0b 01 10 00 14 00 02 04 01 02 ff fe");
    Bytes bits(4);
    client.readDiscreteInputs(6, bits);
    EXPECT_EQ(bits, (Bytes{0, 1, 0, 1}));
    EXPECT_EQ(lastRequest(), "00 00 00 06 01 02 00 06 00 04");
    client.readCoils(4, bits);
    EXPECT_EQ(bits, (Bytes{0, 1, 0, 1}));
    Words words(2);
    client.readInputRegisters(3, words);
    EXPECT_EQ(words, (Words{0x1234, 0xFFFE}));
    EXPECT_EQ(lastRequest(), "00 00 00 06 01 04 00 03 00 02");
    client.readHoldingRegisters(20, words);
    EXPECT_EQ(words, (Words{0x0102, 0xFFFE}));

    server.look([](modbus_mapping_t& map) {
        EXPECT_EQ((Bytes{map.tab_bits + 4, map.tab_bits + 10}), (Bytes{0, 1, 0, 1, 1, 0}));
        EXPECT_EQ(map.tab_registers[19], 0);
        EXPECT_EQ(map.tab_registers[20], 0x0102);
        EXPECT_EQ(map.tab_registers[21], 0xFFFE);
        EXPECT_EQ(map.tab_registers[22], 0);
    });
}

TEST_F(Client, WritesBeforeItReadsInOneRequest) {
    Words read(3);
    client.writeAndReadRegisters(50, Words{7, 8}, 49, read);
    EXPECT_EQ(read, (Words{0, 7, 8}));
    EXPECT_EQ(lastRequest(), "00 00 00 0f 01 17 00 31 00 03 00 32 00 02 04 00 07 00 08");
}

TEST_F(Client, SplitsNumbersOf32BitsInBothOrders) {
    for (const auto& [order, wire] : {std::pair{WordOrder::HighWordFirst, "12 34 56 78"},
                                      std::pair{WordOrder::LowWordFirst, "56 78 12 34"}}) {
        std::array<std::uint16_t, 2> words{};
        split(0x12345678, order, words);
        client.writeRegisters(0, words);
        EXPECT_TRUE(lastRequest().ends_with(wire)) << lastRequest();
        words = {};
        client.readHoldingRegisters(0, words);
        EXPECT_EQ(joined(words, order), 0x12345678U);
    }
}

TEST_F(Client, AsksTheUnitOfItsSettings) {
    ModbusClient other = clientOf(server.address(), 17);
    server.leave();
    server.comeBack();
    other.connect();
    Words words(1);
    other.readHoldingRegisters(0, words);
    EXPECT_EQ(server.requests().back()[6], 17);

    server.unreachable = 17;
    try {
        other.readHoldingRegisters(0, words);
        ADD_FAILURE() << "nobody is behind the gateway";
    } catch (const LinkRefused&) {
        ADD_FAILURE() << "it may come back";
    } catch (const LinkError& error) {
        EXPECT_EQ(error.what(), server.address() +
                                    ": reading 1 holding registers at 0: gateway target failed to "
                                    "respond (exception 11): look at its item unit");
    }
}

TEST_F(Client, TellsWhatItHasNotGotInWords) {
    Words words(2);
    try {
        client.readInputRegisters(99, words);  // the server has 100
        ADD_FAILURE() << "it has no register 100";
    } catch (const LinkRefused& error) {
        EXPECT_EQ(error.what(), server.address() +
                                    ": reading 2 input registers at 99: illegal data address "
                                    "(exception 2): addresses count from 0");
    }
    client.readInputRegisters(98, words);  // it goes on
}

TEST_F(Client, ComesBackWhenTheServerDoes) {
    Words words(1);
    client.readHoldingRegisters(0, words);
    server.leave();
    EXPECT_THROW(client.readHoldingRegisters(0, words), LinkError);
    client.close();
    try {
        client.connect();
        ADD_FAILURE() << "nobody listens";
    } catch (const LinkError& error) {
        EXPECT_EQ(error.what(), server.address() +
                                    ": nobody listens there; start the device, or "
                                    "correct address");
    }
    EXPECT_FALSE(client.isOpen());
    EXPECT_THROW(client.readHoldingRegisters(0, words), LinkError) << "not open";

    server.comeBack();
    server.look([](modbus_mapping_t& map) { map.tab_registers[0] = 42; });
    client.connect();
    client.connect();  // without a close(): the server serves one at a time
    client.readHoldingRegisters(0, words);
    EXPECT_EQ(words[0], 42);
}

TEST_F(Client, AsksForNothingThatNoRequestCanHold) {
    Words many(126), none;
    Bytes bits(2001);
    EXPECT_THROW(client.readHoldingRegisters(0, many), Error);
    EXPECT_THROW(client.readInputRegisters(0, none), Error);
    EXPECT_THROW(client.readHoldingRegisters(-1, many), Error);
    EXPECT_THROW(client.writeRegisters(0, many), Error);
    EXPECT_THROW(client.readCoils(0, bits), Error);
    EXPECT_THROW(client.writeCoils(65535, Bytes{1, 1}), Error);
    EXPECT_THROW(
        client.writeAndReadRegisters(0, std::span{many}.first(122), 0, std::span{many}.first(1)),
        Error);
    try {
        client.readHoldingRegisters(65530, std::span{many}.first(7));
        ADD_FAILURE() << "beyond 65535";
    } catch (const LinkError&) {
        ADD_FAILURE() << "connecting anew would mend nothing";
    } catch (const Error& error) {
        EXPECT_EQ(error.what(), server.address() +
                                    ": reading 7 holding registers at 65530: a request has 1 to "
                                    "125 of them, within the addresses 0 to 65535");
    }
    EXPECT_TRUE(server.requests().empty());
    EXPECT_THROW(clientOf("localhost", 248), Error);
}

}  // namespace
}  // namespace cortex::modbus::test
