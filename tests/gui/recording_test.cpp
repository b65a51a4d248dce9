// SPDX-License-Identifier: Apache-2.0
// The recorder with real agents: what its listener shares with the thread of the window.
#include "cortex/comms/dds_interface.hpp"

#include "comms/network_agent.hpp"
#include "session/session.hpp"
#include "support/probe.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using gui::AgentTime;
using gui::RecordedItem;
using gui::RecordedStretch;
using gui::Ring;
using gui::Session;
using test::Probe;
using test::ProbeCluster;

// Its result is the number of its cycle.
struct CountingAgent : ProbeCluster {
    explicit CountingAgent(bool runs) : ProbeCluster{{}, "quick"} {
        if (runs) {
            trigger = nullptr;
            cluster->setTriggerSource<cs::InternalClock>(std::chrono::milliseconds{1});
        }
        cluster->addInterface<DdsInterface>(loopback());
        Probe& ctl = probe("/ctl");
        ctl.onPopulate = [this](Probe& of) { result = of.data<double>("result"); };
        ctl.onLoopStart = [this](Probe& of, const Tick& tick) {
            of.setQuality(Quality::Good);
            result = static_cast<double>(tick.cycle);
        };
        start();
    }

    Data<double> result;
};

RecordedItem counted() { return {"quick", "/ctl", "result", 0}; }

// The cycles of its samples, each beside its own value.
std::vector<std::int64_t> cyclesOf(Session& session, std::int64_t from = 0) {
    const Ring& ring = *session.recorder().ring(counted());
    const AgentTime& time = *session.recorder().time("quick");
    std::vector<std::int64_t> cycles;
    for (std::int64_t i = std::max(from, ring.begin()); i < ring.end(); ++i) {
        if (ring.quality(i) == Ring::notCome) continue;
        EXPECT_EQ(ring.value(i), static_cast<double>(time.cycleAt(i)));
        cycles.push_back(time.cycleAt(i));
    }
    return cycles;
}

// Each cycle between the first and the last is a sample, or missing and counted.
void expectEveryCycleOrAGap(Session& session) {
    const std::vector<std::int64_t> cycles = cyclesOf(session);
    ASSERT_FALSE(cycles.empty());
    const auto all = static_cast<std::uint64_t>(cycles.back() - cycles.front() + 1);
    EXPECT_LE(all - cycles.size(), session.recorder().time("quick")->skipped);
}

std::size_t startsOf(const AgentTime& time) {
    std::set<std::int64_t> epochs;
    for (const auto& each : time.stretches) epochs.insert(each.epoch);
    return epochs.size();
}

TEST(Recording, OfAnAgentAtOneKilohertzKeepsEveryCycleOrCountsItsGap) {
    CountingAgent agent{true};
    Session session{loopback()};
    session.recorder().record(&session, {counted()});
    EXPECT_TRUE(comesTrue([&] {
        session.recorder().take();
        const Ring* ring = session.recorder().ring(counted());
        return ring != nullptr && ring->end() - ring->begin() >= 1'000;
    }));
    agent.cluster->stop();
    expectEveryCycleOrAGap(session);
}

TEST(Recording, OfAnAgentThatIsSteppedMissesNothing) {
    CountingAgent agent{false};
    Session session{loopback()};
    session.recorder().record(&session, {counted()});
    const auto kept = [&] {
        session.recorder().take();
        const Ring* ring = session.recorder().ring(counted());
        return ring == nullptr ? 0 : ring->end() - ring->begin();
    };
    ASSERT_TRUE(comesTrue([&] {
        agent.step();
        return kept() > 0;
    }));
    const Ring& ring = *session.recorder().ring(counted());
    const AgentTime& time = *session.recorder().time("quick");
    ASSERT_TRUE(comesTrue([&] {  // all that was stepped before its view began
        return kept() > 0 && time.lastCycle == agent.cluster->image().cycle();
    }));
    const std::int64_t begin = ring.end();
    for (int step = 0; step < 100; ++step) {
        const std::int64_t before = kept();
        agent.step();
        ASSERT_TRUE(comesTrue([&] { return kept() > before; }));
    }
    expectEveryCycleOrAGap(session);
    const std::vector<std::int64_t> stepped = cyclesOf(session, begin);
    EXPECT_GE(stepped.size(), 100U);
    EXPECT_EQ(stepped.back() - stepped.front() + 1, static_cast<std::int64_t>(stepped.size()));
}

TEST(Recording, OfALaterStartOfAnAgentFollowsBehindAGap) {
    Session session{loopback()};
    session.recorder().record(&session, {counted()});
    std::int64_t before = 0;
    for (int start = 0; start < 2; ++start) {
        CountingAgent agent{false};
        ASSERT_TRUE(comesTrue([&] {
            agent.step();
            session.recorder().take();
            const Ring* ring = session.recorder().ring(counted());
            const AgentTime* time = session.recorder().time("quick");
            return ring != nullptr && ring->end() >= before + 20 &&
                   startsOf(*time) > static_cast<std::size_t>(start);
        }));
        before = session.recorder().ring(counted())->end();
    }
    const Ring& ring = *session.recorder().ring(counted());
    const AgentTime& time = *session.recorder().time("quick");
    ASSERT_EQ(startsOf(time), 2U);
    const std::int64_t second =
        std::ranges::find(time.stretches, time.stretches.back().epoch, &RecordedStretch::epoch)
            ->first;
    EXPECT_TRUE(std::isnan(ring.value(second - 1)));
    EXPECT_GE(time.table.utcAt(second), time.table.utcAt(ring.behindPresent(second - 1) - 1));
    const std::int64_t next = ring.nextPresent(second, ring.end());
    EXPECT_EQ(ring.value(next), static_cast<double>(time.cycleAt(next)));
}

}  // namespace
}  // namespace cortex::comms
