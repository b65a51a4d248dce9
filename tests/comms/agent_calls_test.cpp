// SPDX-License-Identifier: Apache-2.0
// Commands of an agent's tasks to simplexes of another agent, over real DDS on the loopback
// interface.
#include "comms/network_agent.hpp"
#include "comms/secured_plant.hpp"

#include <memory>
#include <optional>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

NetworkOptions securedBy(const std::string& folder) {
    NetworkOptions options = loopback();
    options.security = folder;
    return options;
}

// The agent "chief" commands /work, one command after the other.
struct BossAgent : NetworkAgent {
    explicit BossAgent(const NetworkOptions& network = loopback())
        : NetworkAgent{"chief", network}, hand{rig.hand("/boss", "Boss")} {
        rig.tree.relateRemote(hand, "peers", "/work");
        rig.make();
        add = hand.input("peers").command("add");
        sum = add.response<double>("sum");
        rig.start();
    }
    void send() {
        hand.run = [this] { add.send(); };
        rig.step();
        hand.run = {};
    }
    bool answered() const { return add.sent() == add.answered(); }

    test::Hand& hand;
    CommandSender add;
    Data<const double> sum;
};

// The agent "worker" has /work and counts. A test steps fast: at this period a second lasts.
struct WorkAgent : NetworkAgent {
    explicit WorkAgent(const NetworkOptions& network = loopback())
        : NetworkAgent{"worker", network, {.period = 1'000}}, hand{rig.hand("/work")} {
        rig.make();
        const Argument<double> amount = hand.argument<double>("add", "amount");
        const Result<double> sum = hand.result<double>("add", "sum");
        hand.on("add", [this, amount, sum](Call& call) {
            total += call[amount];
            call[sum] = total;
            return Outcome::Done;
        });
        rig.start();
    }

    test::Hand& hand;
    double total = 0;
};

bool becomeTrue(BossAgent& boss, WorkAgent* worker, const std::function<bool()>& condition) {
    return comesTrue([&] {
        boss.rig.step();
        if (worker != nullptr) worker->rig.step();
        return condition();
    });
}

bool linked(BossAgent& boss, WorkAgent& worker) {
    return becomeTrue(boss, &worker, [&] {
        return boss.rig.agent->images().newest().quality("/work") == Quality::Good;
    });
}

TEST(DdsAgentCalls, RunOnceEachAndAreAnswered) {
    BossAgent boss;
    WorkAgent worker;
    ASSERT_TRUE(linked(boss, worker));
    for (int i = 1; i <= 50; ++i) {
        boss.send();
        ASSERT_TRUE(becomeTrue(boss, &worker, [&] { return boss.answered(); })) << i;
        EXPECT_EQ(boss.add.answer().outcome, Outcome::Done) << boss.add.answer().why.view();
        EXPECT_EQ(static_cast<double>(boss.sum), i);
    }
    EXPECT_EQ(worker.total, 50);
    EXPECT_TRUE(worker.rig.hasEvent("chief@"));
}

TEST(DdsAgentCalls, AreUnknownOrExpiredWhenTheAgentEndsAndReachItsNextStart) {
    BossAgent boss;
    auto worker = std::make_unique<WorkAgent>();
    ASSERT_TRUE(linked(boss, *worker));
    boss.send();
    worker.reset();
    ASSERT_TRUE(becomeTrue(boss, nullptr, [&] { return boss.answered(); }));
    const Outcome outcome = boss.add.answer().outcome;
    EXPECT_TRUE(outcome == Outcome::Unknown || outcome == Outcome::Expired) << name(outcome);

    ASSERT_TRUE(becomeTrue(boss, nullptr, [&] {
        return boss.rig.agent->images().newest().quality("/work") == Quality::Lost;
    }));
    boss.send();
    ASSERT_TRUE(becomeTrue(boss, nullptr, [&] { return boss.answered(); }));
    EXPECT_EQ(boss.add.answer().outcome, Outcome::Expired);

    WorkAgent next;
    ASSERT_TRUE(linked(boss, next));
    boss.send();
    ASSERT_TRUE(becomeTrue(boss, &next, [&] { return boss.answered(); }));
    EXPECT_EQ(boss.add.answer().outcome, Outcome::Done);
    EXPECT_EQ(next.total, 1) << "what had expired did not run";
}

TEST(DdsAgentCalls, EndAsTheCertificateOfTheSenderSays) {
    const SecuredPlant plant;
    WorkAgent worker{securedBy(plant.make("worker"))};
    std::optional<BossAgent> boss;
    boss.emplace(securedBy(plant.make("chief", {"/elsewhere"})));
    ASSERT_TRUE(linked(*boss, worker));
    boss->send();
    ASSERT_TRUE(becomeTrue(*boss, &worker, [&] { return boss->answered(); }));
    EXPECT_EQ(boss->add.answer().outcome, Outcome::Rejected);
    EXPECT_EQ(boss->add.answer().reason, Reason::Authority);
    EXPECT_EQ(worker.total, 0);
}

TEST(DdsAgentCalls, AreSignedWhereSecurityIsOn) {
    const SecuredPlant plant;
    WorkAgent worker{securedBy(plant.make("worker"))};
    BossAgent boss{securedBy(plant.make("chief", {"/work"}))};
    ASSERT_TRUE(linked(boss, worker));
    boss.send();
    ASSERT_TRUE(becomeTrue(boss, &worker, [&] { return boss.answered(); }));
    EXPECT_EQ(boss.add.answer().outcome, Outcome::Done) << boss.add.answer().why.view();
    EXPECT_EQ(worker.total, 1);
}

}  // namespace
}  // namespace cortex::comms
