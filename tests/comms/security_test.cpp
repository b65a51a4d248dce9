// SPDX-License-Identifier: Apache-2.0
// Agents and tools with security on, over real DDS on the loopback interface, and those who have no
// right to be there: among them clients on raw Fast DDS, without the checks of our library.
#include "cortex/comms/mirror.hpp"
#include "cortex/core/error.hpp"

#include "comms/raw_dds.hpp"
#include "comms/secured_plant.hpp"
#include "comms/stepped_agent.hpp"
#include "dds/security_guard.hpp"
#include "wire/cdr.hpp"

#include <optional>
#include <span>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

NetworkOptions secured(const std::string& folder) {
    NetworkOptions options = loopback();
    options.security = folder;
    return options;
}

template <class M>
std::vector<std::uint8_t> octetsOf(const M& message) {
    std::vector<std::uint8_t> octets(encodedSize(message));
    encode(message, std::span{octets});
    return octets;
}

// The agent "robot" with two simplexes, and whoever the test makes keys for.
struct Secured : testing::Test {
    Secured() {
        test::Hand &arm = agent.rig.hand("/cell/arm"), &belt = agent.rig.hand("/belt");
        agent.rig.make();
        for (test::Hand* each : {&arm, &belt}) {
            each->on("poke", [this](Call&) {
                ++pokes;
                return Outcome::Done;
            });
            each->on("add", [](Call& call) { return call.fail("it is full"); });
        }
        agent.run();
    }
    bool reports(std::string_view event) {
        return comesTrue([&] { return agent.rig.hasEvent(event); });
    }
    Command poke(const std::string& sender, const std::string& path) {
        Command message;
        message.link = linkId(sender, "robot");
        message.sender = sender;
        message.host = "desk";
        message.senderEpoch = 1'700'000'000'000'000;
        message.target = "robot";
        message.targetEpoch = agent.structure().epoch;
        message.sequenceNumber = ++sequence;
        message.answeredBelow = 1;
        message.notAfter = 3'000'000;
        message.path = path;
        message.command = "poke";
        return message;
    }
    // A tool whose commands all fail; each is an event. Then it leaves. Where a busy machine keeps
    // the agent silent, nobody knows what became of a command: it asks again.
    void failOften(const std::string& folder, std::size_t count) {
        Mirror early{"cortex", secured(folder)};
        ASSERT_TRUE(early.waitUntilComplete(test::patience));
        const Mirror::Arguments one{{"amount", Value{std::vector{1.0}}}};
        for (std::size_t i = 0; i < count; ++i) {
            CommandAnswer answer;
            ASSERT_TRUE(comesTrue([&] {
                answer = early.call("/cell/arm", "add", one, test::patience);
                return answer.outcome != Outcome::Unknown && answer.outcome != Outcome::Expired;
            }));
            ASSERT_EQ(answer.outcome, Outcome::Failed) << answer.text();
        }
    }
    // Writes it as often as it takes to be reported.
    bool isRefused(RawWriter& writer, const Command& command, std::string_view event) {
        const auto octets = octetsOf(command);
        EXPECT_TRUE(comesTrue([&] { return writer.readers() > 0; }));
        EXPECT_TRUE(writer.write(command.link, octets));
        return reports(event);
    }

    SecuredPlant plant;
    SteppedAgent agent{"robot", secured(plant.make("robot"))};
    std::atomic<int> pokes = 0;
    std::uint64_t sequence = 0;
};

TEST_F(Secured, AgentIsSeenAndCommanded) {
    Mirror mirror{"cortex", secured(plant.make("station", {"/cell"}))};
    ASSERT_TRUE(mirror.waitUntilComplete(test::patience));

    EXPECT_EQ(mirror.name().substr(0, 8), "station@");
    EXPECT_EQ(mirror.agents().at(0).name, "robot");
    EXPECT_EQ(mirror.agents().at(0).security, "authenticated, encrypted");
    EXPECT_EQ(mirror.call("/cell/arm", "poke", {}, test::patience).outcome, Outcome::Done);
    EXPECT_EQ(pokes, 1);
    EXPECT_EQ(mirror.refused(), 0U);
}

TEST_F(Secured, CommandOutsideThePrefixIsRefusedAndReported) {
    Mirror mirror{"cortex", secured(plant.make("station", {"/cell"}))};
    ASSERT_TRUE(mirror.waitUntilComplete(test::patience));
    const CommandAnswer answer = mirror.call("/belt", "poke", {}, test::patience);

    EXPECT_EQ(answer.outcome, Outcome::Rejected);
    EXPECT_EQ(answer.reason, Reason::Authority);
    EXPECT_EQ(answer.why, "its authority ends at /cell");
    EXPECT_TRUE(reports("refused: its authority ends at /cell"));
    EXPECT_EQ(pokes, 0);
}

TEST_F(Secured, ControlIsTakenWithinThePrefixOnly) {
    Mirror mirror{"cortex", secured(plant.make("station", {"/cell"}))};
    ASSERT_TRUE(mirror.waitUntilComplete(test::patience));
    const auto take = [&](const std::string& prefix) {
        return mirror.call("/robot", "takeControl",
                           {{"prefix", Value{std::vector<std::string>{prefix}}}}, test::patience);
    };
    EXPECT_EQ(take("/cell").outcome, Outcome::Done);
    EXPECT_EQ(take("/").reason, Reason::Authority);
    EXPECT_EQ(take("//").reason, Reason::Authority);
    EXPECT_EQ(take("").reason, Reason::Authority);
    EXPECT_EQ(take("/belt").why, "its authority ends at /cell");
}

TEST_F(Secured, CommandOfAReaderIsRefusedAndReported) {
    Mirror mirror{"cortex", secured(plant.make("display", {}))};
    ASSERT_TRUE(mirror.waitUntilComplete(test::patience));

    EXPECT_EQ(mirror.call("/cell/arm", "poke", {}, test::patience).why, "it may only look");
    EXPECT_TRUE(reports("refused: it may only look"));
    EXPECT_EQ(pokes, 0);
}

// More than a datagram holds, and that needs room for what security adds to it.
TEST_F(Secured, ALateToolHearsHundredsOfEventsAtOnce) {
    constexpr std::size_t count = 600;
    const std::string folder = plant.make("station", {"/cell"});
    ASSERT_NO_FATAL_FAILURE(failOften(folder, count));
    // How they are packed is a matter of luck. Each leaves once it has them: all in one process
    // take turns at one gate, and each newcomer exchanges keys with each that stayed.
    for (int i = 0; i < 6; ++i) {
        Inbox<AgentEvent> events;
        Mirror tool{"cortex", secured(folder)};
        tool.onEvent(events.push());

        ASSERT_TRUE(events.waitFor(count)) << events.elements().size();
    }
}

// The agent hears nobody any more, and a participant of that name is the one that is asked. It
// neither answers nor knows the agent, as one whose first handshake takes long: to join anew for it
// would only cost what was written.
TEST_F(Secured, AStrangerThatProvesNothingCostsALateToolNoEvents) {
    constexpr std::size_t count = 100;  // for long enough that the agent hears the tool
    const std::string folder = plant.make("station", {"/cell"});
    ASSERT_NO_FATAL_FAILURE(failOften(folder, count));
    const SecuredPlant other;
    Mirror stranger{"cortex", secured(other.make("kim"))};
    ASSERT_TRUE(reports("is refused: it does not prove that it has a certificate"));

    Inbox<AgentEvent> events;
    Mirror late{"cortex", secured(folder)};
    late.onEvent(events.push());
    EXPECT_TRUE(events.waitFor(count)) << events.elements().size();
}

TEST_F(Secured, WithoutACertificateNothingIsSeenAndTheAgentReportsIt) {
    Mirror mirror{"thief", loopback()};
    RawWriter writer{loopback(), topics::command, "cortex::Command"};

    EXPECT_TRUE(reports("that calls itself thief@"));
    EXPECT_TRUE(reports("that calls itself raw is refused: it has no certificate"));
    EXPECT_TRUE(mirror.agents().empty());
    EXPECT_EQ(writer.readers(), 0U);
}

TEST_F(Secured, WithTheCertificateOfAnotherAuthorityNothingIsSeenAndTheAgentReportsIt) {
    const SecuredPlant other;
    Mirror mirror{"cortex", secured(other.make("station"))};
    RawWriter writer{secured(other.make("thief")), topics::command, "cortex::Command"};

    // Of the two, one is asked for its certificate first, the other one asks: the ids say which.
    EXPECT_TRUE(reports("that calls itself station@"));
    EXPECT_TRUE(reports("that calls itself raw is refused"));
    EXPECT_TRUE(mirror.agents().empty());
    EXPECT_EQ(writer.readers(), 0U);
}

TEST_F(Secured, RawClientOfAReaderIsRefusedWhateverItSays) {
    const std::string display = plant.make("display", {}), boss = plant.make("boss");
    const SecurityIdentity reader{display, "display", 0};
    RawWriter writer{secured(display), topics::command, "cortex::Command"};

    const Command bare = poke("display@desk.1", "/belt");
    EXPECT_TRUE(isRefused(writer, bare, "refused: it does not say what it may command"));
    Command honest = poke("display@desk.1", "/belt");
    reader.sign(honest);
    EXPECT_TRUE(isRefused(writer, honest, "refused: it may only look"));
    Command stolen = poke("display@desk.1", "/belt");
    stolen.extras.push_back({"authority", test::textOf(plant.path("boss") / "commands.smime")});
    stolen.extras.push_back({"signature", "MEQC"});
    EXPECT_TRUE(isRefused(writer, stolen, "refused: its list of commands is that of boss"));
    Command named = poke("boss@desk.1", "/belt");
    EXPECT_TRUE(isRefused(writer, named, "uses the name boss@desk.1"));
    EXPECT_EQ(pokes, 0);
}

TEST_F(Secured, RawClientOutsideItsPrefixIsRefused) {
    const std::string folder = plant.make("station", {"/cell"});
    const SecurityIdentity station{folder, "station", 0};
    RawWriter writer{secured(folder), topics::command, "cortex::Command"};

    Command outside = poke("station@desk.1", "/belt");
    station.sign(outside);
    EXPECT_TRUE(isRefused(writer, outside, "refused: its authority ends at /cell"));
    EXPECT_EQ(pokes, 0);
    Command inside = poke("station@desk.1", "/cell/arm");
    station.sign(inside);
    EXPECT_TRUE(writer.write(inside.link, octetsOf(inside)));
    EXPECT_TRUE(comesTrue([&] { return pokes == 1; }));
}

TEST_F(Secured, AnotherAgentsNameIsRefusedInEverySample) {
    RawWriter writer{secured(plant.make("display", {})), topics::presence, "cortex::Presence"};
    ASSERT_TRUE(comesTrue([&] { return writer.readers() > 0; }));
    Presence lie;
    lie.name = "station";
    lie.agent = agentId(lie.name);
    lie.epoch = 1'700'000'000'000'000;
    lie.role = "agent";
    lie.state = "running";
    lie.majors = {1};
    const auto said = [&](std::string_view event) {  // agents read it with best effort
        return comesTrue(
            [&] { return writer.write(lie.agent, octetsOf(lie)) && agent.rig.hasEvent(event); });
    };

    EXPECT_TRUE(said("uses the name station, and its certificate is that of another"));
    EXPECT_FALSE(agent.rig.hasEvent("agent station was found"));
    lie.name = "display";
    lie.agent = agentId(lie.name);
    EXPECT_TRUE(said("agent display was found"));
}

TEST_F(Secured, AgentWithAWrongFolderDoesNotStart) {
    const std::string changed = plant.make("arm");
    tamper(std::filesystem::path{changed} / "governance.smime", "ENCRYPT", "NONE");
    NetworkAgent tampered{"arm", secured(changed)};
    EXPECT_THROW(tampered.rig.start(), Error);
    NetworkAgent another{"gripper", secured(plant.make("hand"))};
    EXPECT_THROW(another.rig.start(), Error);
    EXPECT_THROW(Mirror("cortex", secured("/nowhere")), Error);
}

}  // namespace
}  // namespace cortex::comms
