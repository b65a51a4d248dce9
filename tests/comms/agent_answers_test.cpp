// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_answers.hpp"

#include "comms/inbox.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

struct AgentAnswersTest : testing::Test {
    static Answer answerFor(const std::string& sender) {
        Answer answer;
        answer.agent = "robot";
        answer.sender = sender;
        answer.outcome = "Done";
        return answer;
    }
    // A sender whose answers go elsewhere.
    static std::string other() {
        std::string name = "other";
        while (topics::answerTo(name).name == topics::answerTo("mine").name) name += "x";
        return name;
    }

    Participant agent{loopback(), "robot"}, tools{loopback(), "tools"};
    AgentAnswers answers{agent};
    Inbox<Answer> mine, others;
    std::unique_ptr<Reader<Answer>> reader =
        tools.reader<Answer>(topics::answerTo("mine"), mine.push());
};

TEST_F(AgentAnswersTest, GoToTheTopicOfTheirSenderAlone) {
    const auto another = tools.reader<Answer>(topics::answerTo(other()), others.push());
    const auto comesTo = [&](const std::string& sender, Inbox<Answer>& inbox) {
        return comesTrue([&] {
            answers.send(answerFor(sender));
            return !inbox.elements().empty();
        });
    };
    EXPECT_TRUE(comesTo("mine", mine));
    EXPECT_TRUE(comesTo(other(), others));
    for (const Answer& each : mine.elements()) EXPECT_EQ(each.sender, "mine");
    for (const Answer& each : others.elements()) EXPECT_EQ(each.sender, other());
}

// Whoever joins is told of each endpoint that there is or ever was.
TEST_F(AgentAnswersTest, ToThreeHundredSendersTakeSixteenWritersThatStay) {
    std::vector<std::unique_ptr<Reader<Answer>>> readers;
    for (const char digit : std::string{"0123456789abcdef"}) {
        const Topic topic{"cortex/1/answer/" + std::string{digit}, Qos::Exchange};
        readers.push_back(tools.reader<Answer>(topic, others.push()));
    }
    for (int i = 0; i < 300; ++i) answers.send(answerFor("sender" + std::to_string(i)));

    const auto writers = [&] {
        std::vector<std::uint32_t> counts;
        for (const auto& each : readers) counts.push_back(each->writers());
        return counts;
    };
    EXPECT_TRUE(comesTrue([&] { return writers() == std::vector<std::uint32_t>(16, 1); }));
    EXPECT_TRUE(comesTrue([&] {
        answers.send(answerFor("sender299"));
        const auto came = others.elements();
        return std::ranges::count(came, "sender299", &Answer::sender) > 0;
    }));
    EXPECT_EQ(writers(), std::vector<std::uint32_t>(16, 1));
}

}  // namespace
}  // namespace cortex::comms
