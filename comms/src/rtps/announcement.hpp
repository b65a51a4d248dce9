// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rtps/submessages.hpp"
#include "rtps/writer_numbers.hpp"

namespace cortex::comms::rtps {

// What a DATA whose content was judged says of an endpoint.
struct Announcement {
    enum Says { Nothing, IsThere, IsGone, Unclear };
    Says says = Nothing;  // Nothing: it does not announce endpoints
    WriterGuid endpoint{};
};

Announcement announcementIn(const Submessage& data);

}  // namespace cortex::comms::rtps
