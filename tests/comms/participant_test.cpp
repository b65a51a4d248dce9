// SPDX-License-Identifier: Apache-2.0
#include "dds/participant.hpp"

#include "comms/inbox.hpp"
#include "comms/raw_dds.hpp"
#include "wire/cdr.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <set>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

Id idNumber(std::size_t number) {
    Id id{};
    id.front() = 0xC0;
    id[14] = static_cast<std::uint8_t>(number / 256);
    id[15] = static_cast<std::uint8_t>(number % 256);
    return id;
}

Presence presence(std::size_t agent, std::int64_t cycle = 0) {
    Presence message;
    message.agent = idNumber(agent);
    message.name = "agent" + std::to_string(agent);
    message.cycle = cycle;
    return message;
}

template <class M>
std::vector<std::uint8_t> encoded(const M& message) {
    std::vector<std::uint8_t> octets(encodedSize(message));
    octets.resize(encode(message, octets));
    return octets;
}

TEST(Participant, GivesLateJoinersTheNewestStateOfAThousandKeys) {
    Participant early{loopback(), "early"};
    const auto writer = early.writer<Model>(topics::model);
    for (std::int64_t epoch : {1, 2}) {
        for (std::size_t i = 0; i < 1000; ++i) {
            Model model;
            model.id = idNumber(i);
            model.epoch = epoch;
            ASSERT_TRUE(writer->write(model)) << i;
        }
    }

    Participant late{loopback(), "late"};
    Inbox<Model> inbox;
    const auto reader = late.reader<Model>(topics::model, inbox.push());

    ASSERT_TRUE(inbox.waitFor(1000)) << inbox.elements().size();
    std::set<Id> ids;
    for (const Model& model : inbox.elements()) {
        EXPECT_EQ(model.epoch, 2);
        ids.insert(model.id);
    }
    EXPECT_EQ(ids.size(), 1000u);
    EXPECT_EQ(reader->writers(), 1u);
    EXPECT_EQ(writer->readers(), 1u);
}

TEST(Participant, GivesLateJoinersTheLastThousandEventsOfEachAgentInOrder) {
    constexpr std::size_t agents = 12;
    Participant early{loopback(), "early"};
    std::vector<std::unique_ptr<Writer<EventMessage>>> writers;
    for (std::size_t agent = 0; agent < agents; ++agent) {
        writers.push_back(early.writer<EventMessage>(topics::event));
    }
    for (std::uint64_t number = 0; number < 1010; ++number) {
        for (std::size_t agent = 0; agent < agents; ++agent) {
            EventMessage event;
            event.agent = idNumber(agent);
            event.number = number;
            ASSERT_TRUE(writers[agent]->write(event));
        }
    }

    Participant late{loopback(), "late"};
    Inbox<EventMessage> inbox;
    const auto reader = late.reader<EventMessage>(topics::event, inbox.push());

    ASSERT_TRUE(inbox.waitFor(agents * 1000)) << inbox.elements().size();
    std::map<Id, std::uint64_t> next;
    for (const EventMessage& event : inbox.elements()) {
        const auto& [id, expected] = *next.try_emplace(event.agent, 10).first;
        EXPECT_EQ(event.number, expected);
        next[id] = event.number + 1;
    }
    EXPECT_EQ(next.size(), agents);
}

TEST(Participant, DeliversAllCommandsOfALinkInOrderButNoneFromBefore) {
    constexpr std::size_t links = 20, each = 60;
    Participant tool{loopback(), "tool"};
    const auto writer = tool.writer<Command>(topics::command);
    Command command;
    command.sequenceNumber = 1000;
    ASSERT_TRUE(writer->write(command));
    Participant agent{loopback(), "agent"};
    Inbox<Command> inbox;
    const auto reader = agent.reader<Command>(topics::command, inbox.push());
    ASSERT_TRUE(comesTrue([&] { return writer->readers() == 1 && reader->writers() == 1; }));

    for (std::size_t number = 0; number < each; ++number) {
        for (std::size_t link = 0; link < links; ++link) {
            command.link = idNumber(link);
            command.sequenceNumber = number;
            ASSERT_TRUE(writer->write(command));
        }
    }

    ASSERT_TRUE(inbox.waitFor(links * each)) << inbox.elements().size();
    std::map<Id, std::uint64_t> next;
    for (const Command& one : inbox.elements()) EXPECT_EQ(one.sequenceNumber, next[one.link]++);
    EXPECT_EQ(next.size(), links);
}

TEST(Participant, DeliversTheNewestCyclesOfSeveralAgentsAlsoInManyDatagrams) {
    Participant reading{loopback(), "reading"};
    Inbox<Block> inbox;
    const auto reader = reading.reader<Block>(topics::linkOf("agent"), inbox.push());
    Participant left{loopback(), "left"}, right{loopback(), "right"};
    const auto leftWriter = left.writer<Block>(topics::linkOf("agent"));
    const auto rightWriter = right.writer<Block>(topics::linkOf("agent"));
    Block block;
    block.simplexes.resize(1);
    block.simplexes[0].floats.assign(20'000, 0.5);

    const auto bothWereHeard = [&] {
        std::map<Id, std::uint64_t> heard;
        for (const Block& one : inbox.elements()) ++heard[one.agent];
        return heard[idNumber(1)] >= 5 && heard[idNumber(2)] >= 5;
    };
    ASSERT_TRUE(comesTrue([&] {
        ++block.sequenceNumber;
        block.agent = idNumber(1);
        leftWriter->write(block);
        block.agent = idNumber(2);
        rightWriter->write(block);
        return bothWereHeard();
    }));

    std::map<Id, std::uint64_t> last;
    for (const Block& one : inbox.elements()) {
        EXPECT_GT(one.sequenceNumber, last[one.agent]);
        last[one.agent] = one.sequenceNumber;
        EXPECT_EQ(one.simplexes, block.simplexes);
    }
}

TEST(Participant, TellsWhichKeyWasDisposedAndThatItCameBack) {
    Participant agent{loopback(), "agent"}, tool{loopback(), "tool"};
    const auto writer = agent.writer<Presence>(topics::presence);
    Inbox<Presence> inbox;
    Inbox<Id> disposed;
    const auto reader = tool.reader<Presence>(topics::presence, inbox.push(), disposed.push());
    ASSERT_TRUE(writer->write(presence(1)));
    ASSERT_TRUE(writer->write(presence(2)));
    ASSERT_TRUE(inbox.waitFor(2));

    EXPECT_FALSE(writer->dispose(presence(3))) << "it was never written";
    EXPECT_TRUE(writer->dispose(presence(2)));
    ASSERT_TRUE(disposed.waitFor(1));
    EXPECT_TRUE(writer->write(presence(2, 7)));

    ASSERT_TRUE(inbox.waitFor(3));
    EXPECT_EQ(disposed.elements(), std::vector<Id>{idNumber(2)});
    EXPECT_EQ(inbox.elements().back(), presence(2, 7));
}

TEST(Participant, DoesNotGiveLateJoinersWhatWasDisposed) {
    Participant agent{loopback(), "agent"};
    const auto writer = agent.writer<Presence>(topics::presence);
    ASSERT_TRUE(writer->write(presence(1)));
    ASSERT_TRUE(writer->write(presence(2)));
    ASSERT_TRUE(writer->dispose(presence(1)));

    Participant tool{loopback(), "tool"};
    Inbox<Presence> inbox;
    const auto reader = tool.reader<Presence>(topics::presence, inbox.push());
    ASSERT_TRUE(inbox.waitFor(1));
    ASSERT_TRUE(writer->write(presence(3)));

    ASSERT_TRUE(inbox.waitFor(2));
    EXPECT_EQ(inbox.elements(), (std::vector{presence(2), presence(3)}));
}

TEST(Participant, CountsMalformedSamplesAndReadsOn) {
    Participant tool{loopback(), "tool"};
    Inbox<Presence> inbox;
    const auto reader = tool.reader<Presence>(topics::presence, inbox.push());
    RawWriter raw{loopback(), topics::presence, Presence::typeName};
    const std::vector<std::uint8_t> good = encoded(presence(1));
    std::vector<std::uint8_t> otherEncapsulation = good, longText = good;
    otherEncapsulation[1] = 0x77;
    std::fill_n(longText.begin() + 20, 4, std::uint8_t{0xFF});
    const std::vector<std::vector<std::uint8_t>> malformed{
        {1}, {0, 1, 0, 0}, {good.begin(), good.end() - 5}, otherEncapsulation, longText};

    // One key each, and only once they have met: in 1 of 100 runs under load Fast DDS 2.9 stops
    // delivering in the middle of what is written while they meet.
    ASSERT_TRUE(raw.write(idNumber(1), good));
    ASSERT_TRUE(inbox.waitFor(1));
    for (std::size_t i = 0; i < malformed.size(); ++i) {
        ASSERT_TRUE(raw.write(idNumber(10 + i), malformed[i]));
    }
    ASSERT_TRUE(raw.write(idNumber(2), encoded(presence(2))));

    ASSERT_TRUE(inbox.waitFor(2)) << inbox.elements().size() << " came, " << tool.malformed()
                                  << " malformed";
    ASSERT_TRUE(comesTrue([&] { return tool.malformed() >= malformed.size(); }));
    EXPECT_EQ(tool.malformed(), malformed.size());
    ASSERT_TRUE(raw.write(idNumber(3), encoded(presence(3))));
    ASSERT_TRUE(inbox.waitFor(3));
    EXPECT_EQ(inbox.elements().back(), presence(3));
}

TEST(Participant, IsCountedOnceHoweverManyWritersItHas) {
    Participant agent{loopback(), "agent"}, tool{loopback(), "tool"};
    Inbox<Presence> inbox;
    const auto reader = tool.reader<Presence>(topics::presence, inbox.push());
    std::vector<std::unique_ptr<Writer<Presence>>> writers;
    for (std::size_t i = 1; i <= 3; ++i) {
        writers.push_back(agent.writer<Presence>(topics::presence));
        ASSERT_TRUE(comesTrue([&] { return writers.back()->readers() == 1; }));
        ASSERT_TRUE(writers.back()->write(presence(i)));
    }
    ASSERT_TRUE(inbox.waitFor(3)) << "all of them are met";

    EXPECT_EQ(reader->writers(), 1U);
    EXPECT_EQ(reader->unheard(), 0U);
}

TEST(Participant, DoesNotWriteWhatCannotBeEncoded) {
    Participant agent{loopback(), "agent"}, tool{loopback(), "tool"};
    Inbox<Presence> inbox;
    const auto reader = tool.reader<Presence>(topics::presence, inbox.push());
    const auto writer = agent.writer<Presence>(topics::presence);
    Presence wrong = presence(1);
    wrong.name.assign(100'000, 'x');

    EXPECT_FALSE(writer->write(wrong));
    EXPECT_TRUE(writer->write(presence(2)));

    ASSERT_TRUE(inbox.waitFor(1));
    EXPECT_EQ(inbox.elements().front(), presence(2));
}

TEST(Participant, SurvivesACallbackThatThrows) {
    Participant agent{loopback(), "agent"}, tool{loopback(), "tool"};
    Inbox<Presence> inbox;
    const auto reader = tool.reader<Presence>(topics::presence, [&](Presence&& one) {
        if (one.cycle == 1) throw std::runtime_error{"no memory"};
        inbox.push()(std::move(one));
    });
    const auto writer = agent.writer<Presence>(topics::presence);
    ASSERT_TRUE(comesTrue([&] { return writer->readers() == 1; }));

    ASSERT_TRUE(writer->write(presence(1, 1)));
    ASSERT_TRUE(writer->write(presence(2, 2)));

    ASSERT_TRUE(inbox.waitFor(1));
    EXPECT_EQ(inbox.elements().front(), presence(2, 2));
    EXPECT_EQ(tool.malformed(), 1u);
}

TEST(Participant, CallsBackOnThreadsOfItsOwnEvenWithinOneProcess) {
    Participant agent{loopback(), "agent"}, tool{loopback(), "tool"};
    Inbox<std::thread::id> threads;
    const auto reader = tool.reader<Presence>(
        topics::presence, [&](Presence&&) { threads.push()(std::this_thread::get_id()); });
    const auto writer = agent.writer<Presence>(topics::presence);
    ASSERT_TRUE(comesTrue([&] { return writer->readers() == 1 && reader->writers() == 1; }));

    for (std::size_t count = 1; count <= 3; ++count) {
        ASSERT_TRUE(writer->write(presence(1)));
        ASSERT_TRUE(threads.waitFor(count));
        EXPECT_NE(threads.elements().back(), std::this_thread::get_id());
    }
}

TEST(Participant, CallsNobodyBackOnceAReaderIsDestroyed) {
    Participant agent{loopback(), "agent"}, tool{loopback(), "tool"};
    const auto writer = agent.writer<Block>(topics::linkOf("agent"));
    std::atomic<bool> stop = false;
    // No more than 10,000 samples a second, as a reader drops what comes without a pause.
    std::thread writing{[&] {
        while (!stop) {
            writer->write(Block{});
            std::this_thread::sleep_for(std::chrono::microseconds{100});
        }
    }};
    bool called = true;
    for (int round = 0; round < 20 && called; ++round) {
        std::atomic<std::uint64_t> calls = 0;
        auto reader = tool.reader<Block>(topics::linkOf("agent"), [&](Block&&) { ++calls; });
        called = comesTrue([&] { return calls > 10; });

        reader.reset();

        const std::uint64_t last = calls;
        std::atomic<bool> otherCalled = false;
        const auto other =
            tool.reader<Block>(topics::linkOf("agent"), [&](Block&&) { otherCalled = true; });
        called = called && comesTrue([&] { return otherCalled.load(); });
        EXPECT_EQ(calls, last);
    }
    stop = true;
    writing.join();
    EXPECT_TRUE(called);
}

TEST(Participant, MatchesNobodyAfterTheOthersAreGone) {
    Participant tool{loopback(), "tool"};
    const auto reader = tool.reader<Presence>(topics::presence, [](Presence&&) {});
    {
        Participant agent{loopback(), "agent"};
        const auto writer = agent.writer<Presence>(topics::presence);
        ASSERT_TRUE(comesTrue([&] { return reader->writers() == 1; }));
    }
    EXPECT_TRUE(comesTrue([&] { return reader->writers() == 0; }));
}

TEST(Participant, FindsOthersThroughADiscoveryServer) {
    const DiscoveryServer server{loopback()};
    NetworkOptions options = loopback();
    options.discoveryServer = server.address();
    Participant agent{options, "agent"}, tool{options, "tool"};
    Inbox<Presence> inbox;
    const auto reader = tool.reader<Presence>(topics::presence, inbox.push());
    const auto writer = agent.writer<Presence>(topics::presence);

    ASSERT_TRUE(writer->write(presence(1)));

    EXPECT_TRUE(inbox.waitFor(1));
}

TEST(Participant, HearsNothingOnceItIsToldToStopListening) {
    constexpr std::size_t before = 1, after = 50;
    Participant talker{loopback(), "talker"}, staying{loopback(), "staying"};
    Participant leaving{loopback(), "leaving"};
    Inbox<Model> stayed, left;
    const auto staysOn = staying.reader<Model>(topics::model, stayed.push());
    const auto leaves = leaving.reader<Model>(topics::model, left.push());
    const auto writer = talker.writer<Model>(topics::model);
    ASSERT_TRUE(comesTrue([&] { return writer->readers() == 2; }));
    Model model;
    model.id = idNumber(0);
    ASSERT_TRUE(writer->write(model));
    ASSERT_TRUE(stayed.waitFor(before) && left.waitFor(before));

    leaving.stopListening();
    for (std::size_t i = 1; i <= after; ++i) {
        model.id = idNumber(i);
        ASSERT_TRUE(writer->write(model));
    }

    EXPECT_TRUE(stayed.waitFor(before + after));
    EXPECT_EQ(left.elements().size(), before);
}

TEST(Participant, TakesInterfacesAndPeersByName) {
    NetworkOptions options = loopback();
    options.interfaces = {"lo"};
    options.peers = {"localhost", "127.0.0.1:65000"};
    Participant agent{options, "agent"}, tool{loopback(), "tool"};
    Inbox<Presence> inbox;
    const auto reader = tool.reader<Presence>(topics::presence, inbox.push());
    const auto writer = agent.writer<Presence>(topics::presence);

    ASSERT_TRUE(writer->write(presence(1)));

    EXPECT_TRUE(inbox.waitFor(1));
}

}  // namespace
}  // namespace cortex::comms
