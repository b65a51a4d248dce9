// SPDX-License-Identifier: Apache-2.0
// What an agent sends after its communication thread was held back. Here that thread is the test.
#include "agent/agent_streams.hpp"

#include "comms/network_agent.hpp"
#include "mirror/mirror_tables.hpp"

#include <cstdint>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

// The loop's end of the streams; nobody empties the other one by himself.
class HeldBack final : public CommunicationInterface {
public:
    explicit HeldBack(Participant& participant) : participant_{participant} {}

    void announce(const AgentAccess& agent) override {
        structure = agent.structure;
        self_ = std::make_unique<AgentSelf>(agent);
        streams = std::make_unique<AgentStreams>(*self_, Id{}, participant_);
    }
    void read(cortex::Inbox& /*inbox*/) override {}
    void write(std::int64_t /*cycle*/, Outbox& /*outbox*/) override { streams->keep(); }
    void close() override { streams.reset(); }

    std::shared_ptr<const Structure> structure;
    std::unique_ptr<AgentStreams> streams;

private:
    Participant& participant_;
    std::unique_ptr<AgentSelf> self_;
};

class AgentStreamsTest : public testing::Test {
protected:
    AgentStreamsTest() {
        rig.tree.add("/plate", "Plate");
        rig.add(thread);
        rig.start();
    }
    // A second later each time, so that every stream is due.
    void send() { thread.streams->step(now_ += 1'000'000'000); }
    // Somebody views everything at this rate, and has met the writer.
    void view(std::uint32_t rate, const Topic& topic) {
        reader = tool.reader<Block>(topic, blocks.push());
        Peer peer;
        peer.heard = true;
        peer.current.emplace("tool", 1).interest.views = {{rate, {"/"}}};
        thread.streams->update({{"tool", peer}});
        ASSERT_TRUE(comesTrue([&] { return reader->writers() == 1; }));
        ASSERT_TRUE(comesTrue([&] {
            rig.step();
            send();
            return !blocks.elements().empty();
        }));
        ASSERT_TRUE(comesTrue([&] { return blocks.elements().back().cycle == rig.tick.cycle; }));
    }
    // The blocks up to this cycle, without those that came before.
    std::vector<Block> blocksFrom(std::size_t before, std::int64_t last) {
        EXPECT_TRUE(blocks.waitUntil([&](const auto& all) { return all.back().cycle >= last; }));
        const std::vector<Block> all = blocks.elements();
        return {all.begin() + static_cast<std::ptrdiff_t>(before), all.end()};
    }

    Participant participant{loopback(), "rig"}, tool{loopback(), "tool"};
    HeldBack thread{participant};
    test::AgentRig rig;
    Inbox<Block> blocks;
    std::unique_ptr<Reader<Block>> reader;

private:
    std::int64_t now_ = 0;
};

TEST_F(AgentStreamsTest, SendEveryCycleInOrderToWhoAsksForEveryCycle) {
    view(0, topics::viewEvery);
    const std::size_t before = blocks.elements().size();
    const std::int64_t first = rig.tick.cycle + 1;
    const std::int64_t kept = imagesToKeep(rig.agent->images().octetsOfImage());
    rig.step(static_cast<int>(kept));

    send();

    std::int64_t cycle = first;
    for (const Block& each : blocksFrom(before, rig.tick.cycle)) EXPECT_EQ(each.cycle, cycle++);
    EXPECT_EQ(cycle, first + kept);
    EXPECT_GE(kept, 16);
}

TEST_F(AgentStreamsTest, ShowAsAGapInTheCyclesWhatTheyLeftOut) {
    view(0, topics::viewEvery);
    const std::size_t before = blocks.elements().size();
    MirrorTables tables{thread.structure, Id{}, viewOf({{{"/"}, 0}})};
    tables.apply(blocks.elements().back(), 0, Moment{});
    rig.step(500);
    send();

    const std::vector<Block> came = blocksFrom(before, rig.tick.cycle);

    for (const Block& each : came) ASSERT_TRUE(tables.apply(each, 0, Moment{}));
    EXPECT_GT(came.size(), 16U);
    EXPECT_EQ(came.size() + tables.loss(), 500U) << "each came or is counted";
    EXPECT_EQ(tables.newest().cycle(), rig.tick.cycle);
}

TEST_F(AgentStreamsTest, SayTheLastBlockOfTheLinksAgain) {
    EXPECT_FALSE(thread.streams->repeatLinks()) << "nobody has links";
    reader = tool.reader<Block>(topics::linkOf(rig.agent->name()), blocks.push());
    Peer peer;
    peer.heard = true;
    peer.current.emplace("other", 1).interest.links = {"/plate"};
    thread.streams->update({{"other", peer}});
    ASSERT_TRUE(comesTrue([&] { return reader->writers() == 1; }));
    ASSERT_TRUE(comesTrue([&] {  // the writer may not have met the reader yet
        rig.step();
        send();
        return !blocks.elements().empty();
    }));
    ASSERT_TRUE(comesTrue([&] { return blocks.elements().back().cycle == rig.tick.cycle; }));
    const Block last = blocks.take().back();

    EXPECT_TRUE(thread.streams->repeatLinks());

    ASSERT_TRUE(blocks.waitFor(1));
    EXPECT_EQ(blocks.take().back(), last);
}

TEST_F(AgentStreamsTest, SendTheNewestCycleAloneToSlowerViews) {
    view(100, topics::view100);
    const std::size_t before = blocks.elements().size();
    rig.step(20);

    send();

    ASSERT_EQ(blocksFrom(before, rig.tick.cycle).size(), 1U);
}

// All images that the pool has are held by readers, so nothing that was kept is left.
TEST_F(AgentStreamsTest, KeepNothingWhereNobodyAsksForEveryCycleAnyMore) {
    const auto free = [&] {
        std::vector<Image> held;
        do {
            held.push_back(rig.agent->images().newest());
        } while (held.back());
        return held.size();
    };
    const std::size_t all = free();
    view(0, topics::viewEvery);
    rig.step(8);
    EXPECT_EQ(free(), all - 8);

    thread.streams->update({});
    rig.step(8);
    send();

    EXPECT_EQ(free(), all);
}

}  // namespace
}  // namespace cortex::comms
