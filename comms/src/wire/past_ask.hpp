// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cortex::comms {

// What a tool asks an agent for of the past, as it stands in the tool's presence:
// "NUMBER FROM UNTIL AFTER AGENT". From and until are UTC ns, both included; after is the place of
// the last entry that the tool has, 0: none.
struct PastAsk {
    std::uint64_t number = 0;
    std::int64_t from = 0, until = 0;
    std::uint64_t after = 0;
    std::string agent;
    bool operator==(const PastAsk&) const = default;
};

std::string textOf(const PastAsk& ask);
std::optional<PastAsk> pastAskFrom(std::string_view text);  // none: it is something else

}  // namespace cortex::comms
