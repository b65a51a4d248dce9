// SPDX-License-Identifier: Apache-2.0
#include "agent/long_ends.hpp"

#include <algorithm>

namespace cortex {
namespace {

constexpr std::size_t remembered = 1024;

}  // namespace

LongEnds::LongEnds(std::uint32_t maxResponse)
    : sequences_(remembered), ends_(remembered), responses_(remembered * maxResponse) {
    for (std::size_t i = 0; i < remembered; ++i) {
        ends_[i].answer.response = &responses_[i * maxResponse];
    }
}

void LongEnds::keep(std::uint32_t interface, const OutsideAnswer& end) {
    End& place = ends_[next_];
    // The buffers are ours; the answers show them as const.
    auto* const response = const_cast<std::byte*>(place.answer.response);
    place.interface = interface;
    place.answer = end;
    place.answer.response = response;
    std::copy_n(end.response, end.size, response);
    sequences_[next_] = end.sequence;
    next_ = (next_ + 1) % remembered;
}

bool LongEnds::find(std::uint32_t interface, const Sender& sender, std::uint64_t sequence,
                    OutsideAnswer& end) const {
    auto place = std::ranges::find(sequences_, sequence);
    for (; place != sequences_.end(); place = std::find(place + 1, sequences_.end(), sequence)) {
        const End& kept = ends_[static_cast<std::size_t>(place - sequences_.begin())];
        const Sender& whose = kept.answer.sender;
        if (kept.interface != interface || whose.epoch != sender.epoch) continue;
        if (whose.nameText() != sender.nameText()) continue;
        end = kept.answer;
        return true;
    }
    return false;
}

}  // namespace cortex
