// SPDX-License-Identifier: Apache-2.0
// The recorder with real agents: what its listener shares with the thread of the window.
#include "cortex/comms/dds_interface.hpp"

#include "comms/network_agent.hpp"
#include "session/session.hpp"
#include "support/probe.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using gui::AgentTime;
using gui::RecordedItem;
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

// Every sample between the first and the last is either its own cycle, or missing and counted.
void expectEveryCycleOrAGap(Session& session) {
    const Ring& ring = *session.recorder().ring(counted());
    const AgentTime& time = *session.recorder().time("quick");
    std::uint64_t missing = 0;
    for (std::int64_t i = ring.begin(); i < ring.end(); ++i) {
        if (ring.quality(i) == Ring::notCome) {
            ++missing;
        } else {
            ASSERT_EQ(ring.value(i), static_cast<double>(time.cycleAt(i)));
        }
    }
    EXPECT_LE(missing, time.skipped);
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
    EXPECT_GE(ring.end(), begin + 100);
    EXPECT_EQ(ring.nextMissing(begin, ring.end()), ring.end());
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
                   time->starts.size() > static_cast<std::size_t>(start);
        }));
        before = session.recorder().ring(counted())->end();
    }
    const Ring& ring = *session.recorder().ring(counted());
    const AgentTime& time = *session.recorder().time("quick");
    ASSERT_EQ(time.starts.size(), 2U);
    const std::int64_t second = time.starts.back().first;
    EXPECT_TRUE(std::isnan(ring.value(second - 1)));
    EXPECT_GE(time.table.utcAt(second), time.table.utcAt(ring.behindPresent(second - 1) - 1));
    const std::int64_t next = ring.nextPresent(second, ring.end());
    EXPECT_EQ(ring.value(next), static_cast<double>(time.cycleAt(next)));
}

}  // namespace
}  // namespace cortex::comms
