// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"
#include "cortex/cs/trigger_source.hpp"

#include "support/probe.hpp"
#include "support/waiting.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>

#include <fcntl.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>

namespace cortex::test {

namespace {

using namespace std::chrono_literals;

// Sends datagrams to the port that a socket is bound to.
class TickSender {
public:
    explicit TickSender(int receiver) {
        socklen_t size = sizeof place_;
        getsockname(receiver, reinterpret_cast<sockaddr*>(&place_), &size);
    }
    ~TickSender() { close(socket_); }
    TickSender(const TickSender&) = delete;
    TickSender& operator=(const TickSender&) = delete;
    void send(int count = 1) const {
        for (int i = 0; i < count; ++i) {
            sendto(socket_, "tick", 4, 0, reinterpret_cast<const sockaddr*>(&place_),
                   sizeof place_);
        }
    }
    int port() const { return ntohs(place_.sin_port); }

private:
    int socket_ = socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in place_{};
};

std::string whyRefused(int descriptor) {
    try {
        cs::DescriptorTrigger{descriptor, 1ms};
    } catch (const Error& error) {
        close(descriptor);
        return error.what();
    }
    return {};
}

testing::AssertionResult ranUpTo(std::int64_t cycle, const ProbeCluster& probes) {
    const auto seen = [&] { return probes.cluster->image().cycle(); };
    return comesTrue(
        "cycle " + std::to_string(cycle), [&] { return seen() >= cycle; },
        [&] { return std::to_string(seen()); });
}

TEST(DescriptorTrigger, RunsACycleOfAClusterForEachDatagram) {
    const int receiver = cs::DescriptorTrigger::openUdp("127.0.0.1", 0);
    const TickSender sender{receiver};
    sender.send();  // before the start: does not count
    ProbeCluster probes;
    probes.probe("/a");
    probes.cluster->setTriggerSource<cs::DescriptorTrigger>(receiver, 10ms);
    probes.start();

    for (std::int64_t cycle = 1; cycle <= 20; ++cycle) {
        sender.send();
        ASSERT_TRUE(ranUpTo(cycle, probes));
        const Image image = probes.cluster->image();
        EXPECT_EQ(image.cycle(), cycle);
        EXPECT_EQ(image.nominalTime(), (cycle - 1) * 10'000'000);
    }
    EXPECT_TRUE(probes.cluster->stop());
}

TEST(DescriptorTrigger, KeepsClustersInStepThatGetTheSameTicks) {
    const int first = cs::DescriptorTrigger::openUdp("127.0.0.1", 0);
    const int second = cs::DescriptorTrigger::openUdp("127.0.0.1", 0);
    const TickSender toFirst{first}, toSecond{second};
    ProbeCluster one{{}, "one"}, two{{}, "two"};
    for (ProbeCluster* each : {&one, &two}) {
        each->probe("/a");
        each->cluster->setTriggerSource<cs::DescriptorTrigger>(each == &one ? first : second, 1ms);
        each->start();
    }
    for (std::int64_t cycle = 1; cycle <= 10; ++cycle) {
        toFirst.send();
        toSecond.send();
        for (ProbeCluster* each : {&one, &two}) {
            ASSERT_TRUE(ranUpTo(cycle, *each));
        }
        EXPECT_EQ(one.cluster->image().nominalTime(), two.cluster->image().nominalTime());
    }
    EXPECT_TRUE(one.cluster->stop());
    EXPECT_TRUE(two.cluster->stop());
}

TEST(DescriptorTrigger, PassesOverTicksThatCameMeanwhileAndSaysHowMany) {
    const int receiver = cs::DescriptorTrigger::openUdp("127.0.0.1", 0);
    const TickSender sender{receiver};
    cs::DescriptorTrigger trigger{receiver, 1ms};
    trigger.start();
    sender.send();
    EXPECT_EQ(trigger.waitForTick().nominalTime, 0);

    sender.send(3);
    const cs::Trigger late = trigger.waitForTick();

    EXPECT_EQ(late.periods, 3);
    EXPECT_EQ(late.nominalTime, 3'000'000);
    EXPECT_EQ(trigger.missed(), 0);
}

TEST(DescriptorTrigger, ReturnsTicksThatCameMeanwhileAtOnceWhereTheyAreToBeCaughtUp) {
    const int receiver = cs::DescriptorTrigger::openUdp("127.0.0.1", 0);
    const TickSender sender{receiver};
    cs::DescriptorTrigger trigger{receiver, 1ms};
    trigger.start();
    trigger.skipMissed(false);
    sender.send(3);

    for (int i = 0; i < 3; ++i) {
        const cs::Trigger tick = trigger.waitForTick();
        EXPECT_EQ(tick.periods, 1);
        EXPECT_EQ(tick.nominalTime, i * 1'000'000);
        EXPECT_EQ(trigger.missed(), 2 - i);
    }
}

TEST(DescriptorTrigger, CountsTheBytesOfAPipeAndWhatAnEventfdCounts) {
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe(ends.data()), 0);
    cs::DescriptorTrigger bytes{ends[0], 1ms};
    bytes.start();
    ASSERT_EQ(write(ends[1], "xx", 2), 2);
    EXPECT_EQ(bytes.waitForTick().periods, 2);
    close(ends[1]);
    EXPECT_THROW(bytes.waitForTick(), Error) << "nobody is left who could send ticks";

    const int counter = eventfd(0, 0);
    cs::DescriptorTrigger counts{counter, 1ms};
    counts.start();
    eventfd_write(counter, 5);
    EXPECT_EQ(counts.waitForTick().periods, 5);
}

TEST(DescriptorTrigger, IsInterruptedFromAnotherThread) {
    cs::DescriptorTrigger trigger{eventfd(0, 0), 1ms};
    trigger.start();
    std::thread interrupting{[&] { trigger.interrupt(); }};
    EXPECT_TRUE(trigger.waitForTick().stopped);
    interrupting.join();
}

TEST(DescriptorTrigger, EndsAWaitOnceWhereNoTickComes) {
    const int counter = eventfd(0, 0);
    cs::DescriptorTrigger trigger{counter, 1ms};
    trigger.start();
    EXPECT_TRUE(trigger.timeOut());
    EXPECT_TRUE(trigger.waitForTick().timedOut);

    const std::uint64_t one = 1;
    ASSERT_EQ(write(counter, &one, sizeof one), static_cast<ssize_t>(sizeof one));
    const cs::Trigger next = trigger.waitForTick();
    EXPECT_FALSE(next.timedOut);
    EXPECT_EQ(next.nominalTime, 1'000'000) << "the cycle without a tick counted as one";
}

TEST(DescriptorTrigger, RefusesWhatHasNoTicks) {
    EXPECT_NE(whyRefused(open("/proc/self/exe", O_RDONLY)).find("it is no socket for datagrams"),
              std::string::npos);
    EXPECT_NE(whyRefused(socket(AF_INET, SOCK_STREAM, 0)).find("it is no socket for datagrams"),
              std::string::npos);
    EXPECT_NE(whyRefused(-1).find("Bad file descriptor"), std::string::npos);
    EXPECT_THROW(cs::DescriptorTrigger::openUdp("localhost", 5005), Error);
    const TickSender taken{cs::DescriptorTrigger::openUdp("127.0.0.1", 0)};
    EXPECT_THROW(
        cs::DescriptorTrigger::openUdp("127.0.0.1", static_cast<std::uint16_t>(taken.port())),
        Error);
}

TEST(DescriptorTrigger, EndsTheLoopWhenItsSenderIsGone) {
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe(ends.data()), 0);
    ProbeCluster probes;
    probes.probe("/a");
    probes.cluster->setTriggerSource<cs::DescriptorTrigger>(ends[0], 1ms);
    probes.start();
    EXPECT_TRUE(probes.cluster->running());

    close(ends[1]);

    EXPECT_TRUE(comesTrue("the end of the loop", [&] { return !probes.cluster->running(); }));
    EXPECT_EQ(probes.cluster->ended(), cs::Ended::Stopped);
    EXPECT_TRUE(probes.cluster->stop());
    EXPECT_TRUE(probes.hasEvent("the trigger threw: whoever sent the ticks has closed its end"));
}

}  // namespace

}  // namespace cortex::test
