// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/io_exchange.hpp"

#include "support/probe.hpp"
#include "support/waiting.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

namespace cortex::test {

struct IoSample {
    double position = 0;
    std::int64_t number = 0;
};
struct IoWish {
    double position = 0;
    std::int64_t cycle = 0;
};

// A drive whose thread is a function of the test.
class IoDrive final : public cs::IoSimplex<IoSample, IoWish> {
public:
    using IoSimplex::IoSimplex;
    std::function<void(Line&)> talk;
    std::atomic<int> talks{0};
    std::chrono::nanoseconds lose = std::chrono::milliseconds{5};
    std::chrono::nanoseconds stale{};  // 0: never
    std::function<void()> work;        // that its next hook asks the thread for
    bool asks = false, wasBegun = false;
    // As its last hook saw it.
    IoSample seen;
    std::int64_t ageSeen = -1;
    bool lost = false;
    cs::SlowWork asked;

private:
    void populate() override {
        demand_ = input("demand").data<double>("position");
        position_ = output("observation").data<double>("position");
        loseAfter(lose);
        if (stale.count() > 0) staleAfter(stale);
        asked = atDevice([this] { work(); });
    }
    void loopEnd(const Tick& tick) override {
        seen = received();
        ageSeen = age();
        lost = isLost();
        position_ = seen.position;
        if (std::exchange(asks, false)) wasBegun = asked.begin();
        give({demand_, tick.cycle});
    }
    void communicate(Line& line) override {
        ++talks;
        talk(line);
    }
    Data<const double> demand_;
    Data<double> position_;
};

class IoExchange : public testing::Test {
protected:
    using Line = IoDrive::Line;

    void start(std::function<void(Line&)> talk) {
        drive.talk = std::move(talk);
        cluster.start();
    }
    // The next thing that the thread does; returns when it is done.
    void onThread(std::function<void(Line&)> step) {
        next = std::move(step);
        turn = 1;
        waitUntil("the thread's step", [this] { return turn == 0; });
    }
    // Does what onThread() says.
    std::function<void(Line&)> obeying() {
        return [this](Line& line) {
            while (!line.isEnding()) {
                if (turn != 1) {
                    line.waitFor(std::chrono::milliseconds{1});
                    continue;
                }
                const auto done = [this](void*) { turn = 0; };
                const std::unique_ptr<void, decltype(done)> atEnd{this, done};
                next(line);
            }
        };
    }
    template <class Condition>
    void stepUntil(const Condition& condition) {
        waitUntil("what the thread does", [&] {
            if (condition()) return true;
            cluster.step();
            return false;
        });
    }
    Quality quality() { return cluster.quality("/axis"); }

    ProbeCluster cluster;
    IoDrive& drive = cluster.tree.add<IoDrive>("/drive", "Drive");
    std::atomic<int> turn{0};
    std::function<void(Line&)> next;

    void SetUp() override {
        cluster.tree.relate(drive, "demand", cluster.tree.add("/wish", "Demand"));
        cluster.tree.relate(drive, "observation", cluster.tree.add("/axis", "Observation"));
    }
    void TearDown() override { cluster.cluster->stop(); }
};

}  // namespace cortex::test
