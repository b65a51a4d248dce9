// SPDX-License-Identifier: Apache-2.0
#include "cli/hung_agent.hpp"

#include "cortex/comms/dds_interface.hpp"
#include "cortex/core/agent.hpp"
#include "cortex/core/clock.hpp"

#include "support/probe.hpp"
#include "support/waiting.hpp"

#include <atomic>
#include <chrono>
#include <thread>

namespace cortex::test {

struct HungAgent::Implementation {
    ProbeCluster cluster{{}, "robot"};
    std::atomic<bool> hangs{false}, slow{false}, fails{false};
    std::string failure;        // set before `fails`
    std::atomic<int> hooks{0};  // begun
    std::atomic<int> unsaid{0};

    void say(Probe& probe) {
        constexpr int inACycle = 50;
        for (int i = 0; i < inACycle && unsaid.load() > 0; ++i) {
            const int number = unsaid--;
            const std::string words{static_cast<char>('a' + number / 676 % 26),
                                    static_cast<char>('a' + number / 26 % 26),
                                    static_cast<char>('a' + number % 26)};
            probe.event(Severity::Info, EventText{words});
        }
    }
    void run(Probe& probe) {
        ++hooks;
        say(probe);
        if (fails.exchange(false)) probe.fault(7, failure);
        const std::int64_t end = monotonicNow() + (slow.load() ? 15'000'000 : 0);
        while (hangs.load() || monotonicNow() < end) std::this_thread::yield();
    }
    bool standsStill() const { return cluster.cluster->agent().standstill().get().has_value(); }
};

HungAgent::HungAgent(int domain) : implementation_{std::make_unique<Implementation>()} {
    Implementation& self = *implementation_;
    self.cluster.trigger = nullptr;
    self.cluster.cluster->setTriggerSource<cs::InternalClock>(std::chrono::milliseconds{5});
    comms::NetworkOptions options;
    options.domain = domain;
    options.interfaces = {"127.0.0.1"};
    self.cluster.cluster->addInterface<comms::DdsInterface>(options);
    Probe& task = self.cluster.probe("/ctl");
    task.onStandby = task.onActive = [&self](Probe& probe, const Tick&) { self.run(probe); };
    self.cluster.start();
}

// The loop ends before the cluster takes its hooks away.
HungAgent::~HungAgent() {
    implementation_->hangs.store(false);
    implementation_->cluster.cluster->stop();
}

// The second cycle has begun, so that the tools have the values of the first.
void HungAgent::hang() {
    const Implementation& self = *implementation_;
    waitUntil("the second cycle", [&] { return self.hooks.load() >= 2; });
    implementation_->hangs.store(true);
    waitUntil("that the watchdog sees a loop that hangs", [&] { return self.standsStill(); });
}

void HungAgent::overload() {
    implementation_->slow.store(true);
    auto& agent = implementation_->cluster.cluster->agent();
    waitUntil("that a slow loop says so", [&] { return agent.pace().overloaded(); });
}

void HungAgent::fail(const std::string& text) {
    implementation_->failure = text;
    implementation_->fails.store(true);
}

void HungAgent::chatter(int events) {
    implementation_->unsaid.store(events);
    waitUntil("that it has said all", [this] { return implementation_->unsaid.load() == 0; });
}

void HungAgent::release() {
    implementation_->hangs.store(false);
    waitUntil("that the watchdog sees a loop that goes on",
              [this] { return !implementation_->standsStill(); });
}

}  // namespace cortex::test
