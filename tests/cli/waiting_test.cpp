// SPDX-License-Identifier: Apache-2.0
// How long verbs wait for agents, and what they say where nobody came.
#include "cli/controlled_agent.hpp"
#include "cli/hung_agent.hpp"
#include "cli/on_terminal.hpp"
#include "comms/datagrams.hpp"

#include <chrono>
#include <cstdint>
#include <regex>
#include <stop_token>
#include <thread>

#include <sys/socket.h>
#include <unistd.h>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>

namespace cortex::test {
namespace {

using Words = std::vector<std::string>;

Outcome tool(const std::string& timeout, const Words& arguments) {
    return cortex(arguments + network, {{"CORTEX_TIMEOUT", timeout}});
}

TEST(CortexWaits, AsLongAsTheVariableSaysUnlessTheOptionSaysOtherwise) {
    const std::string byVariable = tool("0.002", {"list"}).errors;
    EXPECT_TRUE(contains(byVariable, "within 0.002 s")) << byVariable;
    for (const char* variable : {"60", "soon"}) {
        const std::string byOption = tool(variable, {"list", "--timeout", "0.003"}).errors;
        EXPECT_TRUE(contains(byOption, "within 0.003 s")) << byOption;
    }
}

TEST(CortexWaits, AsLongAsItsShellUnlessTheVerbSaysOtherwise) {
    const ModelFolder folder;
    const Words shell{"shell", "--keep-going",
                      folder.write("lines.txt", "list\nlist --timeout 0.003\n").string()};

    const std::string said = tool("0.002", shell).errors;
    EXPECT_TRUE(contains(said, "within 0.002 s")) << said;
    EXPECT_TRUE(contains(said, "within 0.003 s")) << said;
    const std::string other = tool("60", shell + Words{"--timeout", "0.004"}).errors;
    EXPECT_TRUE(contains(other, "within 0.004 s")) << other;
    EXPECT_TRUE(contains(other, "within 0.003 s")) << other;
}

TEST(CortexWaits, NotAtAllWhereTheVariableIsNoTime) {
    for (const char* wrong : {"soon", "3s", "0", "-1", "nan", "inf", "1e7", " "}) {
        for (const char* verb : {"list", "shell"}) {
            const Outcome outcome = tool(wrong, {verb});
            EXPECT_EQ(outcome.exit, 1) << wrong;
            EXPECT_EQ(outcome.errors, std::string{"cortex: CORTEX_TIMEOUT is '"} + wrong +
                                          "'; set it to seconds, a number from 0.001 to 1000000, "
                                          "or unset it for 3 s\n");
        }
    }
}

TEST(CortexWaits, AsHelpSays) {
    EXPECT_TRUE(contains(cortex({"list", "--help"}).output, "CORTEX_TIMEOUT or 3 s"));
}

// What comes a little later than the first agent is not said to be nowhere.
TEST_F(CortexLive, APathIsNowhereOnlyOnceNobodyNewHasComeForASecond) {
    const std::string words =
        "/drvie was not found within 0.9 s, which does not mean that it is not there: mixer was "
        "heard; wait longer (--timeout)";
    const Outcome early =
        lookUntil([] { return tool("0.9", {"show", "/drvie"}); },
                  [&](const Outcome& seen) { return contains(seen.errors, words); });
    EXPECT_TRUE(contains(early.errors, words)) << early.errors;
    EXPECT_EQ(early.exit, 3);

    const Outcome late = live({"show", "/drvie"});
    EXPECT_TRUE(contains(late.errors, "no agent has a simplex /drvie")) << late.errors;
    EXPECT_TRUE(contains(late.errors, "; nearest of: /drive\n")) << late.errors;
    EXPECT_EQ(late.exit, 3);
}

// It is heard all the time, so that it is found, and answers nothing for longer than one try takes.
TEST(CortexTake, TakesControlAgainWhileTheAgentDoesNotAnswerAndTimeIsLeft) {
    HungAgent robot{std::stoi(domain)};
    robot.hang();
    const Words call{"call", "/ctl", "startup", "--take"};
    const std::string words = "no control of /ctl of agent robot: ";
    OnTerminal patient{cortexCommand(call)};
    const Outcome brief =  // again, where the agent was not found in that time
        lookUntil([&] { return tool("2", call); },
                  [&](const Outcome& seen) { return contains(seen.errors, words); });
    EXPECT_TRUE(contains(brief.errors, words)) << brief.errors;
    EXPECT_EQ(brief.exit, 3);

    EXPECT_FALSE(patient.shows("no control", std::chrono::seconds{2})) << patient.output();
    robot.release();

    EXPECT_TRUE(patient.shows("Done")) << patient.output();
    EXPECT_EQ(patient.exit(), 0) << patient.output();
}

// Sends to all participants of the domain on this machine what no participant sends, until its end.
class Nuisance {
public:
    Nuisance() : socket_{socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)} {
        using namespace comms::datagrams;
        using comms::datagrams::operator+;  // that of texts hides it
        const Datagram bad = header() + announcement(parameter(0x70, Datagram(16)));  // has no end
        thread_ = std::jthread{[this, bad](const std::stop_token& stop) {
            while (!stop.stop_requested()) {
                for (int participant = 0; participant < 10; ++participant) send(bad, participant);
                std::this_thread::sleep_for(std::chrono::milliseconds{10});
            }
        }};
    }
    ~Nuisance() {
        thread_ = {};
        close(socket_);
    }
    Nuisance(const Nuisance&) = delete;
    Nuisance& operator=(const Nuisance&) = delete;

private:
    void send(const comms::datagrams::Datagram& bad, int participant) const {
        sockaddr_in place{};
        place.sin_family = AF_INET;
        place.sin_port =
            htons(static_cast<std::uint16_t>(7410 + 250 * std::stoi(domain) + 2 * participant));
        place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        sendto(socket_, bad.data(), bad.size(), 0, reinterpret_cast<const sockaddr*>(&place),
               sizeof place);
    }

    int socket_;
    std::jthread thread_;
};

TEST(CortexFilter, SaysWhyItRefusedMessagesHowManyAndWhoSentTheLastWhereNobodyIsHeard) {
    const Nuisance nuisance;
    const std::regex words{"cortex: no agent on domain " + domain +
                           "; this tool itself refused messages: [1-9][0-9]* \\(datagrams: a list "
                           "of parameters is out of bounds, the last from 127\\.0\\.0\\.1\\)\n"};

    const Outcome outcome =
        lookUntil([] { return tool("1", {"list"}); },
                  [&](const Outcome& seen) { return std::regex_match(seen.errors, words); });

    EXPECT_TRUE(std::regex_match(outcome.errors, words)) << outcome.errors;
    EXPECT_EQ(outcome.exit, 3);
}

}  // namespace
}  // namespace cortex::test
