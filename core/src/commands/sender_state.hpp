// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/mailbox.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace cortex {

// What a handle owns: the records that the sender's task fills and reads. Its first cache line is
// all that a command of few parameters and its answer touch.
struct alignas(64) CommandSender::State {
    State(const CommandTable& commands, std::uint32_t entry, std::uint32_t edgeIndex,
          std::uint32_t room);
    bool storedExternally() const CORTEX_REALTIME { return requestWords == external; }
    std::byte* request() CORTEX_REALTIME {
        return reinterpret_cast<std::byte*>(storedExternally() ? records.data()
                                                               : smallRecords.data());
    }
    std::uint32_t requestSize() const CORTEX_REALTIME {
        return storedExternally() ? sizes.first : requestWords * 8U;
    }
    std::byte* response() CORTEX_REALTIME { return request() + requestSize(); }
    std::uint32_t responseSize() const CORTEX_REALTIME {
        return storedExternally() ? sizes.second : responseWords * 8U;
    }
    void storeFinal(const AnswerHead& head, const std::byte* record) CORTEX_REALTIME;
    std::uint64_t sentCount() const;
    std::uint64_t answeredCount() const;

    static constexpr std::uint8_t external = 0xff;

    Lane* lane = nullptr;                         // from start() on
    std::array<std::uint64_t, 2> smallRecords{};  // request, then response, where they fit
    std::uint8_t requestWords = 0, responseWords = 0;
    std::uint16_t command = 0, handle = 0;
    bool mayBeUnset : 1 = false;  // a parameter without a default: looked at by send()
    bool notSent : 1 = false;     // by the last send()
    std::uint8_t beyond : 2 = 0;  // kept places of the lane that it may take
    bool hasReason = false;       // answer.why is not empty
    AnswerHead answer;

    const CommandTable* table = nullptr;
    std::uint32_t edge = noSimplex, capacity = 0;
    std::pair<std::uint32_t, std::uint32_t> sizes;  // of request and response, bytes
    std::vector<std::uint64_t> records;             // where they do not fit
    std::set<std::string, std::less<>> given;       // parameters of which the sender has a handle
    std::uint64_t sent = 0, answered = 0;           // counted where handles share the lane
};

}  // namespace cortex
