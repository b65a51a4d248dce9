// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/mailbox.hpp"
#include "cortex/core/record.hpp"

#include "commands/lane_position.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace cortex {

// The last answers to long commands of a lane, which were answered Running before: a ring beside
// the lane from its receiver to its sender, with room for what runs and all that wait.
class FinalAnswers {
public:
    FinalAnswers(std::uint32_t room, std::uint32_t responseSize, bool delayed)
        : finals_(std::bit_ceil(room)),
          responseSize_{responseSize},
          responses_{std::make_unique<std::byte[]>(finals_.size() * responseSize)},
          delayed_{delayed} {}

    // Receiver's end.
    void add(const AnswerHead& answer, std::uint16_t handle, const std::byte* response,
             std::uint32_t size, std::int64_t cycle) CORTEX_REALTIME {
        noteStart(cycle, tail_, tailStart_);
        const std::size_t place = placeOf(now(tail_));
        finals_[place] = {answer, handle};
        copyRecord(&responses_[place * responseSize_], response, size);
        advance(tail_);
    }

    // Sender's end: calls `store(handle, answer, response)` for each that is there. The numbers of
    // answers are modulo 2^32 until they are compared with those `taken` so far.
    template <class Store>
    void take(std::int64_t cycle, std::uint64_t taken, const Store& store) CORTEX_REALTIME {
        const std::uint32_t end = delayed_ ? seenDelayed(cycle, tail_, tailStart_) : now(tail_);
        for (; distance(head_, end) > 0; ++head_) {
            const std::size_t place = placeOf(head_);
            Final& final = finals_[place];
            final.answer.number = taken - lowHalf(taken - final.answer.number);
            store(final.handle, final.answer, &responses_[place * responseSize_]);
        }
    }

private:
    struct Final {
        AnswerHead answer;
        std::uint16_t handle = 0;
    };
    std::size_t placeOf(std::uint32_t position) const { return position & (finals_.size() - 1U); }

    std::vector<Final> finals_;
    std::uint32_t responseSize_;
    std::unique_ptr<std::byte[]> responses_;
    bool delayed_;
    LanePosition tail_{0};
    LaneStart tailStart_{0};
    std::uint32_t head_ = 0;  // the sender's
};

}  // namespace cortex
