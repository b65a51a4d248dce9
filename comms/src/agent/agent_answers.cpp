// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_answers.hpp"

namespace cortex::comms {

void AgentAnswers::send(const Answer& answer) {
    const Topic topic = topics::answerTo(answer.sender);
    std::unique_ptr<Writer<Answer>>& writer = writers_[topic.name];
    if (!writer) writer = participant_.writer<Answer>(topic);
    writer->write(answer);
}

}  // namespace cortex::comms
