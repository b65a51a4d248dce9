// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_answers.hpp"

#include "comms/inbox.hpp"

#include <cstdint>
#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

constexpr std::int64_t second = 1'000'000'000;

struct AgentAnswersTest : testing::Test {
    static Answer answerFor(const std::string& sender) {
        Answer answer;
        answer.agent = "robot";
        answer.sender = sender;
        answer.outcome = "Done";
        return answer;
    }
    static auto nobody() {
        return [](const std::string&) { return false; };
    }

    Participant agent{loopback(), "robot"}, tools{loopback(), "tools"};
    AgentAnswers answers{agent};
    Inbox<Answer> mine, others;
    std::unique_ptr<Reader<Answer>> reader =
        tools.reader<Answer>(topics::answerTo("mine"), mine.push());
};

TEST_F(AgentAnswersTest, GoToTheirSenderAlone) {
    const auto other = tools.reader<Answer>(topics::answerTo("other"), others.push());
    const auto comesTo = [&](const std::string& sender, Inbox<Answer>& inbox) {
        return comesTrue([&] {
            answers.send(answerFor(sender), 0);
            return !inbox.elements().empty();
        });
    };
    EXPECT_TRUE(comesTo("mine", mine));
    EXPECT_TRUE(comesTo("other", others));
    for (const Answer& each : mine.elements()) EXPECT_EQ(each.sender, "mine");
    for (const Answer& each : others.elements()) EXPECT_EQ(each.sender, "other");
}

TEST_F(AgentAnswersTest, EndAMinuteAfterTheirSenderWasKnown) {
    EXPECT_TRUE(answers.send(answerFor("mine"), 0));
    ASSERT_TRUE(comesTrue([&] { return reader->writers() == 1; }));

    answers.keep([](const std::string& sender) { return sender == "mine"; }, 50 * second);
    answers.keep(nobody(), 110 * second);
    EXPECT_EQ(reader->writers(), 1U);
    answers.keep(nobody(), 111 * second);
    EXPECT_TRUE(comesTrue([&] { return reader->writers() == 0; }));
}

TEST_F(AgentAnswersTest, BeginAgainForASenderWhoComesBack) {
    for (int round = 0; round < 3; ++round) {
        EXPECT_TRUE(answers.send(answerFor("mine"), 0));
        ASSERT_TRUE(comesTrue([&] { return reader->writers() == 1; }));
        answers.keep(nobody(), 61 * second);
        ASSERT_TRUE(comesTrue([&] { return reader->writers() == 0; }));
    }
}

TEST_F(AgentAnswersTest, AreForSoManyNewSendersASecondAndNoMore) {
    for (int i = 0; i < 256; ++i) {
        ASSERT_TRUE(answers.send(answerFor("sender" + std::to_string(i)), 0));
    }
    EXPECT_FALSE(answers.send(answerFor("one more"), second - 1));
    EXPECT_TRUE(answers.send(answerFor("sender7"), second - 1)) << "those that are there go on";
    EXPECT_TRUE(answers.send(answerFor("one more"), second));
}

}  // namespace
}  // namespace cortex::comms
