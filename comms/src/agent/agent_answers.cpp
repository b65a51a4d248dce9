// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_answers.hpp"

namespace cortex::comms {

void AgentAnswers::send(const Answer& answer) { writerTo(answer.sender).write(answer); }

Writer<Answer>& AgentAnswers::writerTo(const std::string& sender) {
    const Topic topic = topics::answerTo(sender);
    std::unique_ptr<Writer<Answer>>& writer = writers_[topic.name];
    if (!writer) writer = participant_.writer<Answer>(topic);
    return *writer;
}

}  // namespace cortex::comms
