// SPDX-License-Identifier: Apache-2.0
// What no Modbus server should do: the client tells it in words, and is right again after the next
// connection. Under the sanitizers nothing is read or written that is not there.
#include "modbus/test_servers.hpp"
#include "modbus_client.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::modbus::test {
namespace {

using namespace std::chrono_literals;
using toolkit::LinkError;
using toolkit::LinkRefused;
using Answer = RawServer::Answer;

ModbusClient clientWithin(const RawServer& server, std::chrono::nanoseconds time) {
    return ModbusClient{{ModbusAddress::parse(server.address()), 1, time}};
}

// What two registers at 10 come to: their text, or what was thrown.
std::string readFrom(ModbusClient& client) {
    std::array<std::uint16_t, 2> words{};
    try {
        if (!client.isOpen()) client.connect();
        client.readHoldingRegisters(10, words);
        return std::to_string(words[0]) + " " + std::to_string(words[1]);
    } catch (const LinkRefused& error) {
        client.close();
        return std::string{"refused: "} + error.what();
    } catch (const LinkError& error) {
        client.close();
        return error.what();
    }
}

// Wrong at first, right from the next connection on.
std::string readTwice(const std::function<Answer(const Bytes&)>& wrong,
                      std::chrono::nanoseconds time = 30s) {
    std::atomic<bool> isFirst{true};
    const RawServer server{[&](const Bytes& request) {
        return isFirst.exchange(false) ? wrong(request) : Answer{rightAnswer(request, {7, 8})};
    }};
    ModbusClient client = clientWithin(server, time);
    std::string text = readFrom(client);
    const std::string who = server.address() + ": reading 2 holding registers at 10: ";
    if (const std::size_t at = text.find(who); at != std::string::npos) text.erase(at, who.size());
    if (time < 1s) return text;  // a busy machine might be late once more
    EXPECT_EQ(readFrom(client), "7 8");
    return text;
}

Bytes changed(Bytes bytes, std::size_t place, int by) {
    bytes[place] = static_cast<std::uint8_t>(bytes[place] + by);
    return bytes;
}

constexpr const char* noAnswer = "its answer is none to this; is it a Modbus/TCP device?";

TEST(HostileServer, IsNotTakenForWhatWasAsked) {
    const auto with = [](std::size_t place, int by) {
        return [place, by](const Bytes& request) {
            return Answer{changed(rightAnswer(request, {1, 2}), place, by)};
        };
    };
    EXPECT_EQ(readTwice(with(0, 1)), noAnswer) << "the number of the transaction";
    EXPECT_EQ(readTwice(with(1, 1)), noAnswer);
    EXPECT_EQ(readTwice(with(2, 1)), noAnswer) << "the protocol";
    EXPECT_EQ(readTwice(with(3, 1)), noAnswer);
    EXPECT_EQ(readTwice(with(5, 1)), noAnswer) << "how many octets follow";
    EXPECT_EQ(readTwice(with(6, 8)),
              "unit 9 answers; where that is this device, set its item unit to 9");
    EXPECT_EQ(readTwice(with(7, 1)), noAnswer) << "the function";
    EXPECT_EQ(readTwice([](const Bytes& request) { return Answer{rightAnswer(request, {1})}; }),
              noAnswer)
        << "one register for two";
    EXPECT_EQ(
        readTwice([](const Bytes& request) { return Answer{rightAnswer(request, {1, 2, 3})}; }),
        noAnswer);
    EXPECT_EQ(readTwice([](const Bytes& request) { return Answer{exceptionAnswer(request, 99)}; }),
              noAnswer)
        << "an exception that there is not";
    EXPECT_EQ(readTwice([](const Bytes& request) { return Answer{exceptionAnswer(request, 0)}; }),
              noAnswer);
}

// What a request that writes comes to: "", or what was thrown.
std::string writtenTo(ModbusClient& client, bool bits) {
    try {
        if (!client.isOpen()) client.connect();
        if (bits)
            client.writeCoils(10, Bytes{1, 0});
        else
            client.writeRegisters(10, std::array<std::uint16_t, 2>{7, 8});
        return "";
    } catch (const LinkError& error) {
        client.close();
        const std::string text = error.what();
        return text.substr(text.rfind(": ") + 2);
    }
}

// Head, unit, function, first address and count: 12 octets.
TEST(HostileServer, MustEchoWhatWasWrittenAndWhere) {
    for (const bool bits : {true, false}) {
        std::atomic<std::size_t> wrong{0};
        const RawServer server{[&](const Bytes& request) {
            Bytes answer{request.begin(), request.begin() + 12};
            answer[5] = 6;
            return Answer{wrong == 0 ? answer : changed(answer, wrong, 1)};
        }};
        ModbusClient client = clientWithin(server, 30s);
        EXPECT_EQ(writtenTo(client, bits), "");
        for (const std::size_t place : {1U, 2U, 3U, 5U, 7U, 8U, 9U, 10U, 11U}) {
            wrong = place;
            EXPECT_EQ(writtenTo(client, bits), noAnswer) << "octet " << place << " from 0";
            wrong = 0;
            EXPECT_EQ(writtenTo(client, bits), "") << "after octet " << place;
        }
    }
}

TEST(HostileServer, MayEndInTheMiddle) {
    for (const std::size_t octets : {0U, 1U, 6U, 7U, 8U, 9U, 12U}) {
        const std::string text = readTwice([octets](const Bytes& request) {
            Bytes answer = rightAnswer(request, {1, 2});
            answer.resize(octets);
            return Answer{answer, true};
        });
        EXPECT_EQ(text, "it closed the connection") << octets;
    }
}

TEST(HostileServer, ThatIsSilentOrGivesOctetByOctetHasNoMoreTime) {
    const std::string late = "no answer within 50 ms; look at the device, or raise responseTimeout";
    EXPECT_EQ(readTwice([](const Bytes&) { return Answer{}; }, 50ms), late);
    EXPECT_EQ(readTwice(
                  [](const Bytes& request) {
                      Bytes answer = rightAnswer(request, {1, 2});
                      answer.pop_back();
                      return Answer{answer};
                  },
                  50ms),
              late);
    EXPECT_EQ(readTwice(
                  [](const Bytes& request) {  // half a second long
                      return Answer{rightAnswer(request, std::vector<std::uint16_t>(125)), false,
                                    true};
                  },
                  50ms),
              late);
}

TEST(HostileServer, AnswersAreTakenAfterTheTimeOfAnExchangeByNobody) {
    const RawServer server{
        [](const Bytes& request) { return Answer{rightAnswer(request, {7, 8})}; }};
    ModbusClient client = clientWithin(server, 30s);
    EXPECT_EQ(readFrom(client), "7 8");

    client.allow(0s);  // the requests before took all of it
    EXPECT_NE(readFrom(client).find("no answer within 0 ms"), std::string::npos);
    EXPECT_EQ(readFrom(client), "7 8");
}

struct NamedException {
    std::uint8_t code;
    bool isRefusal;
    const char* name;
};

TEST(HostileServer, NamesEachExceptionOfTheStandard) {
    for (const NamedException& each :
         {NamedException{1, true, "illegal function"},
          NamedException{2, true, "illegal data address"},
          NamedException{3, true, "illegal data value"},
          NamedException{4, false, "server device failure"},
          NamedException{5, false, "acknowledge"}, NamedException{6, false, "server device busy"},
          NamedException{7, false, "negative acknowledge"},
          NamedException{8, false, "memory parity error"},
          NamedException{10, false, "gateway path unavailable"},
          NamedException{11, false, "gateway target failed to respond"}}) {
        const std::string text = readTwice(
            [&](const Bytes& request) { return Answer{exceptionAnswer(request, each.code)}; });
        const std::string expected = std::string{each.isRefusal ? "refused: " : ""} + each.name +
                                     " (exception " + std::to_string(each.code) + ")";
        EXPECT_TRUE(text.starts_with(expected)) << text;
    }
}

// Random octets of random sizes, sometimes behind the begin of a right answer, and then the end.
TEST(HostileServer, SaysGarbageAndNothingBreaks) {
    std::mt19937 random{42};
    std::atomic<int> whole{0};  // with a right head, and octets enough for two registers
    const RawServer server{[&](const Bytes& request) {
        Bytes answer = rightAnswer(request, {1, 2});
        const std::size_t size = answer.size();
        answer.resize(random() % 2 == 0 ? 0 : random() % size);
        const bool isRight = answer.size() > 8;
        const std::size_t more = random() % 400;
        for (std::size_t i = 0; i < more; ++i)
            answer.push_back(static_cast<std::uint8_t>(random() & 0xFF));
        if (isRight && answer.size() >= size) ++whole;
        return Answer{answer, true};
    }};
    ModbusClient client = clientWithin(server, 30s);
    int read = 0;
    for (int i = 0; i < 300; ++i) {
        if (readFrom(client).find(server.address()) == std::string::npos) ++read;
        client.close();
    }
    EXPECT_EQ(read, whole);
    EXPECT_GT(whole, 0);
}

// Each other kind of request, against answers of random length to it.
TEST(HostileServer, SaysGarbageToEachKindOfRequest) {
    std::mt19937 random{7};
    const RawServer server{[&](const Bytes& request) {
        Bytes answer{request.begin(), request.begin() + 8};
        const std::size_t more = random() % 260;
        for (std::size_t i = 0; i < more; ++i)
            answer.push_back(static_cast<std::uint8_t>(random() & 0xFF));
        answer[4] = static_cast<std::uint8_t>(random() & 1);
        answer[5] = static_cast<std::uint8_t>(random() & 0xFF);
        return Answer{answer, true};
    }};
    ModbusClient client = clientWithin(server, 30s);
    std::array<std::uint8_t, 9> bits{};
    std::array<std::uint16_t, 5> words{};
    int answered = 0;
    for (int i = 0; i < 200; ++i) {
        try {
            client.connect();
            if (i % 5 == 0) client.readCoils(3, bits);
            if (i % 5 == 1) client.readDiscreteInputs(3, bits);
            if (i % 5 == 2) client.writeCoils(3, bits);
            if (i % 5 == 3) client.writeRegisters(3, words);
            if (i % 5 == 4) client.writeAndReadRegisters(3, words, 4, words);
            ++answered;
        } catch (const LinkError&) {
        }
    }
    EXPECT_LT(answered, 20);
}

}  // namespace
}  // namespace cortex::modbus::test
