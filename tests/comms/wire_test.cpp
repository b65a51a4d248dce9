// SPDX-License-Identifier: Apache-2.0
// What one participant writes, another one gets, byte for byte, over real DDS. Fast DDS writes its
// statistics over the end of what it takes for them: of what has the byte 0x80 at one place.
#include "comms/any_messages.hpp"
#include "comms/inbox.hpp"
#include "wire/cdr.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms::wire {
namespace {

const std::string text80(3'000, '\x80');
// The same bytes in UTF-8, as a reader of texts takes them: 0xe2 0x80 0x80, again and again.
const std::string utf80 = [] {
    std::string text;
    for (int i = 0; i < 1'000; ++i) text += "\u2000";
    return text;
}();

template <class M>
std::vector<std::uint8_t> bytesOf(const M& message) {
    std::vector<std::uint8_t> bytes(encodedSize(message));
    bytes.resize(encode(message, bytes));
    return bytes;
}

struct Wire : testing::Test {
    // Writes one after the other; how many came as others than they were.
    template <class M>
    std::size_t changed(const Topic& topic, const std::vector<M>& messages) {
        Inbox<M> inbox;
        const auto reader = to.reader<M>(topic, inbox.push());
        const auto writer = from.writer<M>(topic);
        EXPECT_TRUE(comesTrue([&] { return writer->readers() == 1 && reader->writers() == 1; }));
        for (std::size_t i = 0; i < messages.size(); ++i) {
            EXPECT_TRUE(writer->write(messages[i]));
            if (!inbox.waitFor(i + 1)) break;
        }
        return compare(inbox, messages);
    }
    // Writes all of them before somebody reads, so that they travel together.
    template <class M>
    std::size_t changedForLateReaders(const Topic& topic, const std::vector<M>& messages) {
        const auto writer = from.writer<M>(topic);
        for (const M& each : messages) EXPECT_TRUE(writer->write(each));
        Inbox<M> inbox;
        const auto reader = to.reader<M>(topic, inbox.push());
        inbox.waitFor(messages.size());
        return compare(inbox, messages);
    }
    template <class M>
    std::size_t compare(const Inbox<M>& inbox, const std::vector<M>& messages) {
        const std::vector<M> came = inbox.elements();
        EXPECT_EQ(came.size(), messages.size());
        EXPECT_EQ(to.malformed(), 0U);
        std::size_t others = 0;
        for (std::size_t i = 0; i < std::min(came.size(), messages.size()); ++i) {
            if (bytesOf(came[i]) != bytesOf(messages[i])) ++others;
        }
        return others;
    }

    Participant from{loopback(), "from"}, to{loopback(), "to"};
};

EventMessage event(const std::string& text) {
    EventMessage message;
    message.text = text;
    return message;
}

Model model(const std::string& text, std::uint8_t number) {
    Model message;
    message.id.back() = number;
    message.types.resize(1);
    message.types.front().description = text;
    return message;
}

Command command(const std::string& text) {
    Command message;
    message.path = text;
    message.arguments = {{"text", "string", {}, {}, {}, {text}}};
    return message;
}

Answer answer(const std::string& text) {
    Answer message;
    message.why = text;
    return message;
}

Block block(std::uint64_t number, std::vector<double> values) {
    Block message;
    message.sequenceNumber = number;
    message.simplexes.resize(1);
    message.simplexes.front().floats = std::move(values);
    return message;
}

TEST_F(Wire, CarriesLongTextsAsTheyAre) {
    EXPECT_EQ(changed(topics::event, std::vector{event(text80), event(utf80)}), 0U);
    EXPECT_EQ(changed(topics::model, std::vector{model(text80, 1), model(utf80, 2)}), 0U);
    EXPECT_EQ(changed(topics::command, std::vector{command(text80), command(utf80)}), 0U);
    EXPECT_EQ(changed(topics::answerTo("tool"), std::vector{answer(text80), answer(utf80)}), 0U);
}

TEST_F(Wire, CarriesManyTextsAtOnceAsTheyAre) {
    const std::vector events(20, event(text80.substr(0, 600)));
    EXPECT_EQ(changedForLateReaders(topics::event, events), 0U);
    std::vector<Model> models;
    for (std::uint8_t i = 0; i < 20; ++i) models.push_back(model(utf80.substr(0, 600), i));
    EXPECT_EQ(changedForLateReaders(topics::model, models), 0U);
}

template <class M>
std::vector<M> anyMessages(std::uint64_t seed) {
    std::vector<M> messages;
    for (int i = 0; i < 20; ++i) messages.push_back(anyMessage<M>(seed++, 4'000));
    return messages;
}

TEST_F(Wire, CarriesManyMessagesOfAnyContentAtOnceAsTheyAre) {
    for (std::uint64_t seed = 0; seed < 100; seed += 20) {
        EXPECT_EQ(changedForLateReaders(topics::event, anyMessages<EventMessage>(seed)), 0U);
        EXPECT_EQ(changedForLateReaders(topics::model, anyMessages<Model>(seed)), 0U);
        EXPECT_EQ(changedForLateReaders(topics::interest, anyMessages<Interest>(seed)), 0U);
        EXPECT_EQ(changedForLateReaders(topics::presence, anyMessages<Presence>(seed)), 0U);
    }
}

TEST_F(Wire, CarriesABlockOfAnyNumbersAsItIs) {
    const std::vector values(200, std::bit_cast<double>(0x8080808080808080));
    EXPECT_EQ(changed(topics::linkOf("to"), std::vector{block(1, values)}), 0U);
}

TEST_F(Wire, CarriesRandomBlocksAsTheyAre) {
    const char* given = std::getenv("CORTEX_BLOCKS");
    const int count = given != nullptr ? std::stoi(given) : 5'000;
    std::mt19937_64 random{4711};
    std::uniform_real_distribution<double> number{-2, 2};
    std::vector<Block> blocks;
    for (int i = 0; i < count; ++i) {
        std::vector<double> values(200);
        for (double& each : values) each = number(random);
        blocks.push_back(block(static_cast<std::uint64_t>(i), std::move(values)));
    }
    EXPECT_EQ(changed(topics::linkOf("to"), blocks), 0U);
}

TEST_F(Wire, WritesNothingOfAMessageWithATextThatIsTooLong) {
    Inbox<EventMessage> inbox;
    const auto reader = to.reader<EventMessage>(topics::event, inbox.push());
    const auto writer = from.writer<EventMessage>(topics::event);
    for (int i = 0; i < 2; ++i) {
        EXPECT_FALSE(writer->write(event(std::string(maxTextLength + 1, 'x'))));
    }
    EXPECT_EQ(from.takeRefusals(),
              std::vector<std::string>{"a sample of cortex::EventMessage cannot be sent: one of "
                                       "its texts has more than 65536 octets"});
    EXPECT_EQ(from.takeRefusals(), std::vector<std::string>{});
    EXPECT_EQ(from.refusals()["a sample could not be encoded"].count, 2U);
    const EventMessage longest = event(std::string(maxTextLength - 1'000, 'x'));
    EXPECT_TRUE(writer->write(longest));
    ASSERT_TRUE(inbox.waitFor(1));
    EXPECT_EQ(compare(inbox, std::vector{longest}), 0U);
}

TEST_F(Wire, CountsAndNamesWhatIsTooLarge) {
    const std::string reason =
        "datagrams: they are fragments of what is never sent in fragments, or of too much";
    EventMessage large = event(text80);
    for (int i = 0; i < 30; ++i) large.extras.push_back({text80, text80});
    Inbox<EventMessage> events;
    const auto reader = to.reader<EventMessage>(topics::event, events.push());
    const auto writer = from.writer<EventMessage>(topics::event);
    EXPECT_TRUE(writer->write(large));
    EXPECT_TRUE(comesTrue([&] { return to.refusals().contains(reason); }));
    EXPECT_TRUE(events.elements().empty());
}

// What discovery says of a participant and of its endpoints. Fast DDS takes no longer names of
// topics.
TEST(WireOfAnyNames, FindsParticipantsAndEndpoints) {
    std::mt19937_64 random{4711};
    const auto name = [&](std::size_t most) {
        std::string name(1 + random() % most, '\x80');
        for (char& each : name) {
            if (random() % 2 == 0) each = static_cast<char>(1 + random() % 255);
        }
        return name;
    };
    for (int round = 0; round < 4; ++round) {
        Participant from{loopback(), name(255)}, to{loopback(), name(255)};
        std::vector<std::unique_ptr<Reader<EventMessage>>> readers;
        std::vector<std::unique_ptr<Writer<EventMessage>>> writers;
        std::vector<Inbox<EventMessage>> inboxes(12);
        for (Inbox<EventMessage>& each : inboxes) {
            const Topic topic{"cortex/" + name(244), Qos::Log};
            readers.push_back(to.reader<EventMessage>(topic, each.push()));
            writers.push_back(from.writer<EventMessage>(topic));
            EXPECT_TRUE(writers.back()->write(event(topic.name)));
        }
        for (std::size_t i = 0; i < inboxes.size(); ++i) {
            EXPECT_TRUE(inboxes[i].waitFor(1)) << "endpoint " << i << " of round " << round;
            EXPECT_EQ(readers[i]->writers(), 1U);
        }
    }
}

}  // namespace
}  // namespace cortex::comms::wire
