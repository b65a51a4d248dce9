// SPDX-License-Identifier: Apache-2.0
// Mutated samples, replayed against a live agent over real DDS: counted, and nothing else happens.
#include "comms/mutated.hpp"
#include "comms/network_agent.hpp"
#include "comms/raw_dds.hpp"
#include "wire/cdr.hpp"
#include "wire/named_values.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <random>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using Octets = std::vector<std::uint8_t>;

constexpr int rounds = 500;  // of each topic

template <class M>
Octets encoded(const M& message) {
    Octets octets(encodedSize(message));
    octets.resize(encode(message, octets));
    return octets;
}

template <class M>
bool isMessage(const Octets& payload) {
    M message;
    return decode(payload, message);
}

// "near" links /far of "away", which a tool listens to; the mutants are of what was heard.
struct MutatedSamples : testing::Test {
    MutatedSamples() {
        near.rig.tree.relateRemote(near.rig.hand("/boss", "Boss"), "readings", "/far");
        near.rig.tree.add("/plate", "Plate");
        away.rig.tree.add("/far", "Reading").set("a", 7.0);
        near.rig.start();
        away.rig.start();
        tool.connect(2);
    }
    bool works(double value) {
        away.rig.tree.at("/far").data<double>("a") = value;
        const Command set = tool.command(near.structure(), "/plate", "set",
                                         {namedValue("level", Value{std::vector{value}})});
        std::chrono::steady_clock::time_point next;
        return comesTrue([&] {
            // Clients repeat a command, as a start that a mutant made up may count for a second.
            if (const auto now = std::chrono::steady_clock::now(); now >= next) {
                tool.commands->write(set);
                next = now + std::chrono::milliseconds{100};
            }
            away.rig.step();
            near.rig.step();
            return near.rig.get<double>("/far", "a") == value &&
                   near.rig.get<double>("/plate", "level") == value;
        });
    }
    // All that does not decode must be counted: each topic is a reliable one with a key a sample.
    template <class M>
    void replay(const Topic& topic, const std::vector<M>& originals) {
        ASSERT_FALSE(originals.empty());
        RawWriter writer{loopback(), topic, M::typeName};
        const std::uint64_t first = near.dds.rejected();
        ASSERT_TRUE(comesTrue([&] {  // both ends know each other
            writer.write(Id{0xff, 0xff}, {0, 1, 0, 0, 0xff});
            return near.dds.rejected() > first;
        }));
        const std::uint64_t before = near.dds.rejected();
        std::uint64_t malformed = 0;
        for (int round = 0; round < rounds; ++round) {
            const M& original = originals[random() % originals.size()];
            Octets payload = mutated(encoded(original), random);
            payload.resize((payload.size() + 3) / 4 * 4);  // as DDS does, which may mend it
            if (!isMessage<M>(payload)) ++malformed;
            Id key{};
            key[0] = static_cast<std::uint8_t>(round);
            key[1] = static_cast<std::uint8_t>(round >> 8);
            ASSERT_TRUE(writer.write(key, payload));
            if (round % 20 != 0) continue;
            near.rig.step();
            away.rig.step();
        }
        EXPECT_GT(malformed, 50U);
        EXPECT_TRUE(comesTrue([&] { return near.dds.rejected() >= before + malformed; }))
            << topic.name << ": " << malformed << " are malformed, counted are "
            << near.dds.rejected() - before;
    }

    std::mt19937_64 random{20261120};
    NetworkAgent near{"near"}, away{"away"};
    RawTool tool{"operator"};
};

TEST_F(MutatedSamples, OfPresencesAreCountedAndDoNothing) {
    ASSERT_TRUE(works(1.5));
    // Of one that is not there: who is, and hears a later start of its name, must fall silent.
    Presence ghost = tool.presence();
    ghost.name = "ghost";
    ghost.agent = agentId("ghost");
    ghost.role = "agent";
    ghost.simplexes = 3;
    replay<Presence>(topics::presence, {ghost, tool.presence()});
    EXPECT_TRUE(works(2.5)) << near.dds.lastRejection();
}

TEST_F(MutatedSamples, OfModelsAreCountedAndDoNothing) {
    Inbox<Model> heard;
    const auto reader = tool.participant.reader<Model>(topics::model, heard.push());
    ASSERT_TRUE(works(1.5));
    ASSERT_TRUE(heard.waitFor(3));
    replay(topics::model, heard.elements());
    EXPECT_TRUE(works(2.5)) << near.dds.lastRejection();
}

TEST_F(MutatedSamples, OfCommandsAreCountedAndDoNothing) {
    ASSERT_TRUE(works(1.5));
    std::vector<Command> commands;
    for (const char* path : {"/plate", "/boss", "/near"}) {
        commands.push_back(tool.command(near.structure(), path, "set",
                                        {namedValue("level", Value{std::vector{0.5}})}));
        // Not the tool's own: who speaks in its name can close its window.
        commands.back().sender = "stranger";
        commands.back().link = linkId("stranger", "near");
    }
    replay(topics::command, commands);
    EXPECT_TRUE(works(2.5)) << near.dds.lastRejection();
}

// Best effort and without a key: what comes is counted.
TEST_F(MutatedSamples, OfBlocksDoNothing) {
    Inbox<Block> heard;
    const auto reader = tool.participant.reader<Block>(topics::linkOf("away"), heard.push());
    ASSERT_TRUE(works(1.5));
    ASSERT_TRUE(comesTrue([&] {
        away.rig.step();
        return !heard.elements().empty();
    }));
    RawWriter raw{loopback(), topics::linkOf("away"), Block::typeName, false};
    ASSERT_TRUE(comesTrue([&] { return raw.readers() > 1; }));
    const std::uint64_t before = near.dds.rejected();
    for (int round = 0; round < rounds; ++round) {
        raw.write({}, mutated(encoded(heard.elements().front()), random));
        if (round % 20 != 0) continue;
        near.rig.step();
        away.rig.step();
    }
    EXPECT_TRUE(comesTrue([&] { return near.dds.rejected() > before + 50; }))
        << near.dds.rejected() - before;
    EXPECT_TRUE(works(2.5)) << near.dds.lastRejection();
}

}  // namespace
}  // namespace cortex::comms
