// SPDX-License-Identifier: Apache-2.0
#include "sample_messages.hpp"

#include <algorithm>
#include <sstream>

namespace cortex::comms {
namespace {

Id idFrom(std::uint8_t first) {
    Id id;
    for (std::uint8_t& octet : id) octet = first++;
    return id;
}

void appendNumber(Octets& octets, std::size_t size, std::uint64_t value, std::endian order) {
    for (std::size_t i = 0; i < size; ++i) {
        const std::size_t place = order == std::endian::little ? i : size - 1 - i;
        octets.push_back(static_cast<std::uint8_t>(value >> (8 * place)));
    }
}

}  // namespace

Octets payloadOf(std::string_view layout, std::endian order) {
    Octets octets{0, static_cast<std::uint8_t>(order == std::endian::little), 0, 0};
    std::istringstream tokens{std::string{layout}};
    for (std::string token; tokens >> token;) {
        if (token.front() == '\'') {
            octets.insert(octets.end(), token.begin() + 1, token.end() - 1);
        } else if (const auto colon = token.find(':'); colon != std::string::npos) {
            const auto negative = token[colon + 1] == '-';
            const std::uint64_t value = std::stoull(token.substr(colon + 1 + negative), nullptr, 0);
            appendNumber(octets, std::stoul(token), negative ? ~value + 1 : value, order);
        } else {
            const auto star = token.find('*');
            const std::size_t times =
                star == std::string::npos ? 1 : std::stoul(token.substr(star + 1));
            octets.insert(octets.end(), times,
                          static_cast<std::uint8_t>(std::stoul(token, nullptr, 16)));
        }
    }
    return octets;
}

template <>
Sample<Presence> sample() {
    return {.message = {.agent = idFrom(0),
                        .name = "ab",
                        .host = "",
                        .epoch = 2,
                        .role = "tool",
                        .state = "x",
                        .majors = {1, 258},
                        .cycle = -1,
                        .period = 1'000'000,
                        .interval = 100'000'000,
                        .types = 3,
                        .typesHash = idFrom(0xf8),
                        .simplexes = 4,
                        .structureHash = {},
                        .security = "",
                        .extras = {{"k", "v"}}},
            .layout = R"(
                00 01 02 03 04 05 06 07 08 09 0a 0b 0c 0d 0e 0f
                4:3 'ab' 00
                00 4:1 00
                00*3 8:2
                4:5 'tool' 00
                00*3 4:2 'x' 00
                00*2 4:2 2:1 2:258
                00*4 8:-1
                8:1000000
                8:100000000
                4:3
                f8 f9 fa fb fc fd fe ff 00 01 02 03 04 05 06 07
                4:4
                00*16
                4:1 00
                00*3 4:1 4:2 'k' 00 00*2 4:2 'v' 00)"};
}

template <>
Sample<Model> sample() {
    TypeMessage type{.name = "T",
                     .hash = idFrom(0x10),
                     .parents = {"P"},
                     .description = "",
                     .attributes = {},
                     .data = {{"d", "int", 1, 64, "", true, "", {{"min", "0"}}}},
                     .commands = {{"go", "", {}, {{"to", {}}}, {}}},
                     .rules = {{"r", "input", "P", "", {}}}};
    SimplexMessage simplex{.index = 5,
                           .path = "/s",
                           .type = "T",
                           .typeHash = idFrom(0x10),
                           .role = "active",
                           .every = 10,
                           .phase = -1,
                           .relationships = {{"r", "/o", true, false}},
                           .constants = {{"c", "bool", {}, {}, {true, false}, {}}}};
    return {.message = {.id = idFrom(1),
                        .agent = "a",
                        .epoch = 7,
                        .types = {type},
                        .simplexes = {simplex},
                        .extras = {}},
            .layout = R"(
                01 02 03 04 05 06 07 08 09 0a 0b 0c 0d 0e 0f 10
                4:2 'a' 00
                00*2 8:7
                4:1
                    4:2 'T' 00
                    10 11 12 13 14 15 16 17 18 19 1a 1b 1c 1d 1e 1f
                    00*2 4:1 4:2 'P' 00
                    00*2 4:1 00
                    00*3 4:0
                    4:1
                        4:2 'd' 00
                        00*2 4:4 'int' 00
                        4:1
                        4:64
                        4:1 00
                        01
                        00*2 4:1 00
                        00*3 4:1 4:4 'min' 00 4:2 '0' 00
                    00*2 4:1
                        4:3 'go' 00
                        00 4:1 00
                        00*3 4:0
                        4:1 4:3 'to' 00 00 4:0
                        4:0
                    4:1
                        4:2 'r' 00
                        00*2 4:6 'input' 00
                        00*2 4:2 'P' 00
                        00*2 4:1 00
                        00*3 4:0
                4:1
                    4:5
                    4:3 '/s' 00
                    00 4:2 'T' 00
                    10 11 12 13 14 15 16 17 18 19 1a 1b 1c 1d 1e 1f
                    00*2 4:7 'active' 00
                    00 4:10
                    4:-1
                    4:1 4:2 'r' 00 00*2 4:3 '/o' 00 01 00
                    00*3 4:1 4:2 'c' 00 00*2 4:5 'bool' 00 00*3 4:0 4:0 4:2 01 00 00*2 4:0
                4:0)"};
}

template <>
Sample<Interest> sample() {
    return {.message = {.agent = idFrom(1),
                        .name = "a",
                        .epoch = 7,
                        .links = {"/o"},
                        .views = {{30, {"/"}}},
                        .extras = {}},
            .layout = R"(
                01 02 03 04 05 06 07 08 09 0a 0b 0c 0d 0e 0f 10
                4:2 'a' 00
                00*2 8:7
                4:1 4:3 '/o' 00
                00 4:1 4:30 4:1 4:2 '/' 00
                00*2 4:0)"};
}

template <>
Sample<Block> sample() {
    SimplexData full{.index = 0,
                     .quality = 1,
                     .cause = 4294967295,
                     .cycle = 3,
                     .time = 4,
                     .ints = {-1, 2},
                     .floats = {1.5},
                     .bools = {true, false, true},
                     .strings = {"up", ""}};
    SimplexData empty;
    empty.index = 1;
    return {.message = {.agent = idFrom(0),
                        .epoch = 1,
                        .structureHash = idFrom(0x20),
                        .sequenceNumber = 2,
                        .cycle = 3,
                        .nominalTime = 4,
                        .wallClock = 5,
                        .keyFrame = true,
                        .simplexes = {full, empty},
                        .extras = {}},
            .layout = R"(
                00 01 02 03 04 05 06 07 08 09 0a 0b 0c 0d 0e 0f
                8:1
                20 21 22 23 24 25 26 27 28 29 2a 2b 2c 2d 2e 2f
                8:2
                8:3
                8:4
                8:5
                01
                00*3 4:2
                    4:0
                    01
                    00*3 4:4294967295
                    00*4 8:3
                    8:4
                    4:2 00*4 8:-1 8:2
                    4:1 00*4 8:0x3ff8000000000000
                    4:3 01 00 01
                    00 4:2 4:3 'up' 00 00 4:1 00
                    00*3 4:1
                    00
                    00*3 4:0
                    8:0
                    8:0
                    4:0
                    4:0
                    4:0
                    4:0
                4:0)"};
}

template <>
Sample<Summary> sample() {
    return {.message = {.agent = idFrom(0),
                        .epoch = 1,
                        .structureHash = idFrom(0x20),
                        .cycle = 3,
                        .marks = {0x0c, 0x36, 0x03},
                        .extras = {}},
            .layout = R"(
                00 01 02 03 04 05 06 07 08 09 0a 0b 0c 0d 0e 0f
                8:1
                20 21 22 23 24 25 26 27 28 29 2a 2b 2c 2d 2e 2f
                8:3
                4:3 0c 36 03
                00 4:0)"};
}

template <>
Sample<Command> sample() {
    return {.message = {.link = idFrom(0),
                        .sender = "s",
                        .host = "h",
                        .senderEpoch = 1,
                        .target = "t",
                        .targetEpoch = 2,
                        .sequenceNumber = 3,
                        .answeredBelow = 4,
                        .notAfter = -5,
                        .path = "/p",
                        .command = "go",
                        .arguments = {{"x", "float", {}, {-2.0}, {}, {}}},
                        .extras = {}},
            .layout = R"(
                00 01 02 03 04 05 06 07 08 09 0a 0b 0c 0d 0e 0f
                4:2 's' 00
                00*2 4:2 'h' 00
                00*2 8:1
                4:2 't' 00
                00*2 8:2
                8:3
                8:4
                8:-5
                4:3 '/p' 00
                00 4:3 'go' 00
                00 4:1
                    4:2 'x' 00
                    00*2 4:6 'float' 00
                    00*2 4:0
                    4:1 8:0xc000000000000000
                    4:0
                    4:0
                4:0)"};
}

template <>
Sample<Answer> sample() {
    return {.message = {.link = idFrom(0),
                        .agent = "a",
                        .epoch = 1,
                        .sender = "s",
                        .senderEpoch = 2,
                        .sequenceNumber = 3,
                        .outcome = "Done",
                        .reason = "",
                        .why = "",
                        .latencyCycles = 1,
                        .latency = 5,
                        .response = {{"y", "string", {}, {}, {}, {"ok"}}},
                        .extras = {}},
            .layout = R"(
                00 01 02 03 04 05 06 07 08 09 0a 0b 0c 0d 0e 0f
                4:2 'a' 00
                00*2 8:1
                4:2 's' 00
                00*2 8:2
                8:3
                4:5 'Done' 00
                00*3 4:1 00
                00*3 4:1 00
                00*7 8:1
                8:5
                4:1
                    4:2 'y' 00
                    00*2 4:7 'string' 00
                    00 4:0
                    4:0
                    4:0
                    4:1 4:3 'ok' 00
                00 4:0)"};
}

template <>
Sample<EventMessage> sample() {
    return {.message = {.agent = idFrom(0),
                        .name = "a",
                        .epoch = 1,
                        .number = 2,
                        .cycle = 3,
                        .wallClock = 4,
                        .severity = "error",
                        .kind = "fault",
                        .path = "/p",
                        .text = "\u00e9",
                        .extras = {{"n", ""}}},
            .layout = R"(
                00 01 02 03 04 05 06 07 08 09 0a 0b 0c 0d 0e 0f
                4:2 'a' 00
                00*2 8:1
                8:2
                8:3
                8:4
                4:6 'error' 00
                00*2 4:6 'fault' 00
                00*2 4:3 '/p' 00
                00 4:3 c3 a9 00
                00 4:1 4:2 'n' 00 00*2 4:1 00)"};
}

template <>
Sample<PastMessage> sample() {
    return {.message = {.agent = idFrom(0),
                        .name = "a",
                        .epoch = 1,
                        .tool = "t",
                        .ask = 2,
                        .after = 3,
                        .last = 4,
                        .more = true,
                        .events = {{5, 6, 7, 8, "info", "value", "/p", "x"}},
                        .kept = {{"loss", 9}},
                        .extras = {}},
            .layout = R"(
                00 01 02 03 04 05 06 07 08 09 0a 0b 0c 0d 0e 0f
                4:2 'a' 00
                00*2 8:1
                4:2 't' 00
                00*2 8:2
                8:3
                8:4
                01
                00*3 4:1
                    8:5
                    8:6
                    8:7
                    8:8
                    4:5 'info' 00
                    00*3 4:6 'value' 00
                    00*2 4:3 '/p' 00
                    00 4:2 'x' 00
                00*2 4:1
                    4:5 'loss' 00
                    00*3 8:9
                4:0)"};
}

}  // namespace cortex::comms
