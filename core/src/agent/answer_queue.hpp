// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/transport.hpp"

#include "agent/agent_calls.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace cortex {

// What one interface gets: answers in the order in which they were given, and the commands of our
// tasks to what it links. Loop thread only.
class AnswerQueue final : public Outbox {
public:
    AnswerQueue(std::uint32_t capacity, std::uint32_t maxResponse, AgentCalls& calls,
                std::uint32_t interface)
        : answers_(capacity),
          stride_{maxResponse},
          responses_(std::size_t{capacity} * maxResponse),
          calls_{&calls},
          interface_{interface} {}

    // Copies the response; false: full.
    bool push(const OutsideAnswer& answer) CORTEX_REALTIME {
        if (tail_ - head_ == answers_.size()) return false;
        const std::size_t place = tail_++ % answers_.size();
        answers_[place] = answer;
        if (answer.size > 0) {
            std::byte* to = &responses_[place * stride_];
            std::memcpy(to, answer.response, answer.size);
            answers_[place].response = to;
        }
        return true;
    }
    bool nextAnswer(OutsideAnswer& answer) CORTEX_REALTIME override {
        if (head_ == tail_) return false;
        answer = answers_[head_++ % answers_.size()];
        return true;
    }
    bool nextCall(AgentCall& call) CORTEX_REALTIME override {
        return calls_->next(interface_, call);
    }

private:
    std::vector<OutsideAnswer> answers_;
    std::size_t stride_;
    std::vector<std::byte> responses_;
    std::uint64_t head_ = 0, tail_ = 0;
    AgentCalls* calls_;
    std::uint32_t interface_;
};

}  // namespace cortex
