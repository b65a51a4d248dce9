// SPDX-License-Identifier: Apache-2.0
// Two stations fight for one arm: they take control, hand it over, let it expire and crash, in
// random order, and write and stop all the while.
#include "support/agent_rig.hpp"
#include "support/share.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using test::AgentRig;
using test::Hand;
using test::share;
using Answer = test::PlayedInterface::Answer;

constexpr std::int64_t leaseCycles = 40;  // 2 s at 20 Hz

struct Station {
    std::string name;
    std::int64_t epoch = 1;
    std::uint64_t sequence = 0;
};

class Fight {
public:
    Fight(std::uint64_t seed, bool required)
        : rig{"rig", {.controlRequired = required, .period = 50'000'000}},
          required_{required},
          random_{seed} {
        rig.make();
        for (Hand* hand : {&arm, &axis}) {
            hand->on("poke", [](Call&) { return Outcome::Done; });
            hand->run = [this, hand] {
                if (rig.agent->takeLifeCycle(hand->index(), rig.agent->thread(0)) ==
                    LifeCycle::Shutdown) {
                    stopped_ = true;
                }
            };
        }
        rig.start();
    }

    // One thing that one of them, or both, or nobody does; then both write and one stops.
    void trial() {
        const std::size_t who = below(2);
        switch (below(9)) {
            case 0:
            case 1:
                take(who);
                break;
            case 2:
                takeBoth();
                break;
            case 3:
                ask(who, "handOverControl", true);
                break;
            case 4:
                ask(who, "releaseControl");
                break;
            case 5:
                ask(who, "renewControl");
                break;
            case 6:
                rig.step(static_cast<int>(below(leaseCycles + 3)));
                break;
            case 7:
                crash(who);
                break;
            default:
                writeAsBefore(who);
        }
        write();
        stop(below(2));
    }

    std::map<std::string, int> counts;

private:
    std::uint64_t below(std::uint64_t bound) { return random_() % bound; }

    std::uint64_t send(std::size_t who, const std::string& path, const std::string& command,
                       const ProgramInterface::Arguments& arguments = {}) {
        Station& station = stations_[who];
        rig.outside.send({.path = path,
                          .command = command,
                          .arguments = arguments,
                          .sender = station.name,
                          .sequence = ++station.sequence,
                          .answeredBelow = station.sequence,
                          .epoch = station.epoch,
                          .notAfter = rig.tick.cycle + 100});
        return station.sequence;
    }
    std::optional<Answer> answer(std::size_t who, std::uint64_t sequence) const {
        const auto found = std::ranges::find_if(rig.outside.answers, [&](const Answer& each) {
            return each.sender == stations_[who].name && each.sequence == sequence;
        });
        return found != rig.outside.answers.end() ? std::optional{*found} : std::nullopt;
    }
    void step() {
        rig.outside.answers.clear();
        rig.step();
    }
    bool done(std::size_t who, std::uint64_t sequence, const char* what) {
        const auto answered = answer(who, sequence);
        const bool good = answered && answered->outcome == Outcome::Done;
        counts[std::string{what} + (good ? " done" : " refused")]++;
        return good;
    }
    std::string prefix() {
        static const std::array<std::string, 3> prefixes{"/arm", "/arm/axis", "/"};
        return prefixes[below(prefixes.size())];
    }

    void take(std::size_t who) { ask(who, "takeControl"); }
    void ask(std::size_t who, const char* command, bool toOther = false) {
        ProgramInterface::Arguments arguments{{"prefix", Value{std::vector{prefix()}}}};
        if (toOther) arguments["to"] = Value{std::vector{stations_[1 - who].name}};
        const std::uint64_t sequence = send(who, "/rig", command, arguments);
        step();
        done(who, sequence, command);
    }
    // In one cycle, of prefixes that overlap.
    void takeBoth() {
        std::array<std::uint64_t, 2> sequences{};
        const std::size_t first = below(2);
        for (const std::size_t who : {first, 1 - first}) {
            sequences[who] =
                send(who, "/rig", "takeControl", {{"prefix", Value{std::vector{prefix()}}}});
        }
        step();
        const bool one = done(0, sequences[0], "take at once");
        const bool other = done(1, sequences[1], "take at once");
        EXPECT_FALSE(one && other);
    }
    // It is heard of no more, or heard again before that was noticed.
    void crash(std::size_t who) {
        Station& station = stations_[who];
        if (below(2) == 0) {
            rig.outside.loseSender(station.name, station.epoch);
            step();
        }
        if (below(2) == 0) {
            ++station.epoch;
            station.sequence = 0;
        }
        counts["crash"]++;
    }
    // What an earlier start of a station has sent comes now.
    void writeAsBefore(std::size_t who) {
        const Station now = stations_[who];
        if (now.epoch == 1) return;
        // The later start is known from here on.
        send(who, "/arm", "cancel");
        step();
        stations_[who] = {now.name, now.epoch - 1, now.sequence + 100};
        const std::uint64_t sequence = send(who, "/arm", "poke");
        step();
        EXPECT_FALSE(done(who, sequence, "write of an earlier start"));
        stations_[who] = {now.name, now.epoch, now.sequence + 1};
    }

    // Of a path, as the agent shows it; empty: nobody.
    std::string holder(const std::string& path) {
        const Image image = rig.agent->images().newest();
        const auto prefixes =
            std::get<std::vector<std::string>>(image.value("/rig", "leasePrefix"));
        const auto holders = std::get<std::vector<std::string>>(image.value("/rig", "leaseHolder"));
        std::string found;
        for (std::size_t i = 0; i < prefixes.size(); ++i) {
            const bool covers =
                !prefixes[i].empty() && (prefixes[i] == "/" || path.starts_with(prefixes[i]));
            if (!covers) continue;
            EXPECT_TRUE(found.empty() || found == holders[i]) << found << " and " << holders[i];
            found = holders[i];
        }
        return found;
    }

    void write() {
        const std::string path = below(2) == 0 ? "/arm" : "/arm/axis";
        const std::string before = holder(path);
        const std::size_t first = below(2);
        std::array<std::uint64_t, 2> sequences{};
        for (const std::size_t who : {first, 1 - first}) sequences[who] = send(who, path, "poke");
        step();
        const std::string after = holder(path);
        const bool open = !required_ && after.empty();
        int accepted = 0;
        for (std::size_t who = 0; who < 2; ++who) {
            if (!done(who, sequences[who], open ? "write in the open" : "write")) continue;
            ++accepted;
            const std::string& name = stations_[who].name;
            EXPECT_TRUE(open || name == before || name == after)
                << name << " wrote, " << before << " held " << path << ", then " << after;
        }
        EXPECT_TRUE(open || accepted <= 1) << "two writers of " << path;
        // A lease that lasted lets its holder write.
        if (!before.empty() && before == after) {
            EXPECT_EQ(accepted, 1) << before << " holds " << path;
        }
    }

    void stop(std::size_t who) {
        Hand& hand = below(2) == 0 ? arm : axis;
        rig.step(2);  // onLeaseLost may have asked for the same
        rig.setState(hand, State::Active);
        stopped_ = false;
        const std::uint64_t sequence = send(who, hand.path(), "shutdown");
        step();
        const auto answered = answer(who, sequence);
        ASSERT_TRUE(answered);
        EXPECT_EQ(answered->outcome, Outcome::Running) << answered->why;
        EXPECT_TRUE(stopped_) << "a stop had no effect";
        rig.setState(hand, State::Standby);
        step();
        rig.setState(hand, State::Active);
        counts["stop"]++;
    }

    AgentRig rig;
    Hand& arm = rig.hand("/arm", "Holding");
    Hand& axis = rig.hand("/arm/axis", "Careful");
    std::array<Station, 2> stations_{Station{"desk"}, Station{"hall"}};
    bool required_;
    bool stopped_ = false;
    std::mt19937_64 random_;
};

class LeaseFight : public testing::TestWithParam<bool> {};

// 10,000 trials with both values of the parameter together, in the gate a tenth of them.
TEST_P(LeaseFight, NeverHasTwoWritersAndNeverRefusesAStop) {
    const int fights = share(50);
    std::map<std::string, int> counts;
    for (int seed = 1; seed <= fights; ++seed) {
        Fight fight{static_cast<std::uint64_t>(seed), GetParam()};
        for (int trial = 1; trial <= 100; ++trial) {
            fight.trial();
            ASSERT_FALSE(HasFailure()) << "seed " << seed << ", trial " << trial;
        }
        for (const auto& [what, count] : fight.counts) counts[what] += count;
    }
    for (const auto& [what, count] : counts) RecordProperty(what, count);
    EXPECT_EQ(counts["stop"], 100 * fights);
    for (const char* what :
         {"takeControl done", "takeControl refused", "handOverControl done",
          "handOverControl refused", "releaseControl done", "releaseControl refused",
          "renewControl done", "renewControl refused", "take at once done", "take at once refused",
          "write done", "write refused", "write of an earlier start refused", "crash"}) {
        EXPECT_GT(counts[what], fights / 5) << what << " did not happen often enough";
    }
}

INSTANTIATE_TEST_SUITE_P(Control, LeaseFight, testing::Bool(), [](const auto& each) {
    return std::string{each.param ? "Required" : "Open"};
});

}  // namespace
}  // namespace cortex
