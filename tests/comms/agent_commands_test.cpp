// SPDX-License-Identifier: Apache-2.0
// Commands from the network on their way into the loop, without a network.
#include "agent/agent_commands.hpp"

#include "cortex/core/clock.hpp"

#include "agent/agent_model.hpp"
#include "agent/agent_peers.hpp"
#include "agent/agent_rivals.hpp"
#include "comms/secured_plant.hpp"
#include "security/security_identity.hpp"
#include "support/agent_rig.hpp"
#include "wire/ids.hpp"
#include "wire/presence_extras.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

constexpr int room = 256;  // of the pipe into the loop

class CommandsOnly final : public CommunicationInterface {
public:
    explicit CommandsOnly(SecurityIdentity* known = nullptr) : identity{known} {}
    void announce(const AgentAccess& agent) override {
        self = std::make_unique<AgentSelf>(agent);
        peers = std::make_unique<AgentPeers>(*self, [](const std::string&, std::int64_t) {});
        rivals = std::make_unique<AgentRivals>(*self, nullptr);
        commands = std::make_unique<AgentCommands>(
            *self, [this](const Answer& answer) { answers.push_back(answer); }, identity,
            rivals.get());
    }
    void read(Inbox& inbox) override { commands->read(inbox); }
    void write(std::int64_t, Outbox& outbox) override { commands->write(outbox); }
    void close() override {}

    SecurityIdentity* identity;
    std::unique_ptr<AgentSelf> self;
    std::unique_ptr<AgentPeers> peers;
    std::unique_ptr<AgentRivals> rivals;
    std::unique_ptr<AgentCommands> commands;
    std::vector<Answer> answers;
};

struct AgentCommandsTest : testing::Test {
    explicit AgentCommandsTest(SecurityIdentity* known = nullptr) : network{known} {
        rig.add(network);
        rig.make();
        worker.on("poke", [this](Call&) {
            ++pokes;
            return Outcome::Done;
        });
        rig.start();
    }
    // Number n of one of a few senders that poke in turn.
    Command commandOf(int number) const {
        Command command;
        command.sender = "tool" + std::to_string(number % 4);
        command.host = "desk";
        command.senderEpoch = 1;
        command.target = "rig";
        command.link = linkId(command.sender, command.target);
        command.targetEpoch = rig.agent->structure().epoch;
        command.sequenceNumber = static_cast<std::uint64_t>(number / 4 + 1);
        command.answeredBelow = 1;
        command.notAfter = 1000;
        command.path = "/worker";
        command.command = "poke";
        return command;
    }
    void send(int number, std::int64_t until = 0) {
        Command command = commandOf(number);
        if (until != 0) command.extras = {{validUntil, std::to_string(until)}};
        network.commands->take(command, now);
    }
    void step() {
        rig.step();
        network.commands->step(now);
    }
    std::map<std::string, int> outcomes() const {
        std::map<std::string, int> count;
        for (const Answer& each : network.answers) ++count[each.outcome];
        return count;
    }

    CommandsOnly network;
    test::AgentRig rig;
    test::Hand& worker = rig.hand("/worker");
    int pokes = 0;
    const std::int64_t now = monotonicNow();  // no sender is lost, however slow the test is
};

TEST_F(AgentCommandsTest, ThatTheLoopCannotTakeAreAnswered) {
    for (int i = 0; i < room + 20; ++i) send(i);

    EXPECT_EQ(outcomes(), (std::map<std::string, int>{{"MailboxFull", 20}}));
    EXPECT_EQ(network.answers.front().sequenceNumber, room / 4 + 1);
    EXPECT_EQ(network.answers.front().why, "too many commands are on their way");
    EXPECT_EQ(network.self->rejections.count(), 20U);
    step();
    EXPECT_EQ(outcomes(), (std::map<std::string, int>{{"MailboxFull", 20}, {"Done", room}}));
    EXPECT_EQ(pokes, room);
}

// Those of tool0 have the numbers 1, 2, 3, …
TEST_F(AgentCommandsTest, ThatTheLoopCannotTakeHoldUpNoLaterOnes) {
    for (int i = 0; i < room + 1; ++i) send(i);
    step();
    send(room + 4);
    step();

    EXPECT_EQ(outcomes(), (std::map<std::string, int>{{"MailboxFull", 1}, {"Done", room + 1}}));
}

TEST_F(AgentCommandsTest, ThatAreRefusedBesideTheLoopHoldUpNoLaterOnes) {
    Command unknown = commandOf(0);
    unknown.command = "dance";
    network.commands->take(unknown, now);
    send(4);
    step();

    EXPECT_EQ(outcomes(), (std::map<std::string, int>{{"Rejected", 1}, {"Done", 1}}));
    send(0);  // its sender may have read the answer
    step();
    EXPECT_EQ(pokes, 1);
}

// Its sender may have read the answer: it must stay true.
TEST_F(AgentCommandsTest, TurnedAwayOnceAreNotExecutedWhenTheyAreRepeated) {
    for (int i = 0; i < room + 1; ++i) send(i);
    step();
    send(room);
    step();

    EXPECT_EQ(outcomes(), (std::map<std::string, int>{{"MailboxFull", 2}, {"Done", room}}));
    EXPECT_EQ(pokes, room);
}

// What the loop has is answered by the loop alone.
TEST_F(AgentCommandsTest, RepeatedWhileTheLoopTakesNoMoreGetNoAnswerButTheirs) {
    for (int i = 0; i < room; ++i) send(i);
    send(0);
    EXPECT_TRUE(network.answers.empty());
    step();

    EXPECT_EQ(outcomes(), (std::map<std::string, int>{{"Done", room}}));
}

TEST_F(AgentCommandsTest, ComeFromAHundredSendersAtOnce) {
    for (int i = 0; i < 100; ++i) {
        Command command;
        command.sender = "tool" + std::to_string(i);
        command.senderEpoch = 1;
        command.target = "rig";
        command.link = linkId(command.sender, command.target);
        command.targetEpoch = rig.agent->structure().epoch;
        command.sequenceNumber = 1;
        command.answeredBelow = 1;
        command.notAfter = 1000;
        command.path = "/worker";
        command.command = "poke";
        network.commands->take(command, now);
    }
    step();

    EXPECT_EQ(outcomes(), (std::map<std::string, int>{{"Done", 100}}));
}

// Otherwise one datagram would lock the sender of that name out.
TEST_F(AgentCommandsTest, OfAStartThatNoClockCanSayAreNotTaken) {
    Command command = commandOf(0);
    command.senderEpoch = std::numeric_limits<std::int64_t>::max();
    network.commands->take(command, now);
    send(0);
    step();

    EXPECT_EQ(network.self->rejections.last(), "a command of a sender that cannot be");
    EXPECT_EQ(outcomes(), (std::map<std::string, int>{{"Done", 1}}));
    EXPECT_EQ(pokes, 1);
}

TEST_F(AgentCommandsTest, CommandWhoseTimeIsOverByTheClockOfItsTargetIsExpired) {
    send(0, monotonicNow() - 1);
    send(4, monotonicNow() + 3'600'000'000'000);
    step();

    EXPECT_EQ(outcomes(), (std::map<std::string, int>{{"Done", 1}, {"Expired", 1}}));
    EXPECT_EQ(pokes, 1);
}

// Another agent that has /worker as well, and was there a minute before "rig".
struct ContestedCommands : AgentCommandsTest {
    ContestedCommands() {
        earlier.hand("/worker");
        earlier.start();
    }
    void meetTheOwner() {
        const AgentSelf self{earlier.outside.access};
        const AgentModel model{self};
        Presence presence = model.presence("running", 1, 0);
        presence.extras.push_back({uptimeOfAgent, std::to_string(60'000'000'000)});
        network.peers->take(presence, now);
        for (const Model& each : model.samples()) network.peers->take(each, now);
        network.rivals->update(network.peers->all());
    }
    void loseTheOwner() {
        for (int tenth = 0; tenth <= 20; ++tenth) {
            network.peers->expire(now + tenth * 100'000'000LL);
        }
        network.rivals->update(network.peers->all());
    }

    test::AgentRig earlier{"earlier"};
};

// What was executed was not rejected: a caller that tries again would do it twice.
TEST_F(ContestedCommands, ThatTheLoopHasEndAsItSaysThoughTheirPathTurnsOutToBelongToAnother) {
    send(0);
    meetTheOwner();
    send(0);
    EXPECT_TRUE(network.answers.empty());
    step();
    EXPECT_EQ(outcomes(), (std::map<std::string, int>{{"Done", 1}}));

    send(0);  // the answer was lost
    send(4);
    step();

    EXPECT_EQ(outcomes(), (std::map<std::string, int>{{"Done", 2}, {"Rejected", 1}}));
    EXPECT_EQ(network.answers[1].why, "/worker belongs to agent earlier, which was there first");
    EXPECT_EQ(pokes, 1);
}

// As of a long command that is known to run: its sender asks on until it has ended.
TEST_F(ContestedCommands, ThatWereAcknowledgedAreNotRejectedAfterwards) {
    send(0);
    step();
    Command next = commandOf(4);
    next.answeredBelow = 2;
    network.commands->take(next, now);
    step();
    meetTheOwner();
    send(0);
    step();

    EXPECT_EQ(outcomes(), (std::map<std::string, int>{{"Done", 2}}));
}

TEST_F(ContestedCommands, RefusedForTheOwnerStayRefusedWhenItIsGone) {
    meetTheOwner();
    send(0);
    loseTheOwner();
    send(0);
    send(4);
    step();

    EXPECT_EQ(outcomes(), (std::map<std::string, int>{{"Done", 1}, {"Rejected", 2}}));
    EXPECT_EQ(pokes, 1);
}

struct Secured {
    SecuredPlant plant;
    SecurityIdentity robot{plant.make("rig"), "rig", 0};
    SecurityIdentity tool{plant.make("tool0", {"/worker"}), "tool0", 0};
};

struct SecuredAgentCommands : Secured, AgentCommandsTest {
    SecuredAgentCommands() : AgentCommandsTest{&robot} {}

    // Number n of tool0.
    void take(int number, const char* name, bool isSigned) {
        Command command = commandOf(4 * (number - 1));
        command.command = name;
        if (isSigned) tool.sign(command);
        network.commands->take(command, now);
    }
};

// Otherwise anybody could let a command of somebody else overtake an earlier one.
TEST_F(SecuredAgentCommands, OnlyTheirSenderLetsANumberCountAsCome) {
    take(2, "poke", true);
    take(1, "dance", false);
    step();
    EXPECT_EQ(outcomes(), (std::map<std::string, int>{{"Rejected", 1}}));
    EXPECT_EQ(pokes, 0);
    take(1, "dance", true);
    step();

    EXPECT_EQ(outcomes(), (std::map<std::string, int>{{"Rejected", 2}, {"Done", 1}}));
}

TEST_F(SecuredAgentCommands, AForgedRepetitionRefusesNothing) {
    take(1, "poke", true);
    take(1, "poke", false);
    take(1, "dance", true);
    step();

    EXPECT_EQ(outcomes(), (std::map<std::string, int>{{"Done", 1}}));
}

}  // namespace
}  // namespace cortex::comms
