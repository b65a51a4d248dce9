// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rtps/submessages.hpp"
#include "rtps/writer_numbers.hpp"

#include <cstdint>

namespace cortex::comms::rtps {

// What a DATA whose content was judged says of an endpoint.
struct Announcement {
    enum Says { Nothing, IsThere, IsForeign, IsGone, Unclear };
    Says says = Nothing;  // Nothing: it does not announce endpoints
    // IsForeign: one of a topic that is none of CorteX.
    WriterGuid endpoint{};
};

Announcement announcementIn(const Submessage& data);

// The domain that the announcement of a participant names, as RTPS 2.3 and later have it; -1: none.
std::int64_t domainIn(const Submessage& data);

}  // namespace cortex::comms::rtps
