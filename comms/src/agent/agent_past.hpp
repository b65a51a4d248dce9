// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "agent/agent_self.hpp"
#include "agent/allowance.hpp"
#include "dds/participant.hpp"
#include "wire/past_ask.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace cortex::comms {

// Answers tools that ask for what this agent keeps of the past, a part at a time: a tool asks for
// the next one when it has it. Until then a part is said a few times, as its tool may not hear us
// yet. However many ask, all get their turn, and not too much is said. Communication thread only.
// Times are ns of monotonicNow().
class AgentPast {
public:
    AgentPast(AgentSelf& self, Participant& participant) : self_{self}, participant_{participant} {}

    void take(const Presence& presence, std::int64_t now);  // of a tool, with what it asks
    void step(std::int64_t now);
    void renew() { writer_.reset(); }  // before its participant is replaced

private:
    struct Asked {
        PastAsk ask;
        std::int64_t until = 0;     // unless it is heard again, it has gone
        std::int64_t answered = 0;  // when last
        int times = 0;              // that it is still to be answered
    };
    void answer(const std::string& tool, const PastAsk& ask);

    AgentSelf& self_;
    Participant& participant_;
    std::map<std::string, Asked> asked_;           // by tool
    std::string last_;                             // the tool that was answered last
    Allowance allowance_;                          // of answers
    std::unique_ptr<Writer<PastMessage>> writer_;  // once somebody has asked
};

}  // namespace cortex::comms
