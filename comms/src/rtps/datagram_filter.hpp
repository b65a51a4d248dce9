// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rtps/endpoint_limits.hpp"
#include "rtps/fragments.hpp"
#include "rtps/participant_limits.hpp"
#include "rtps/participant_places.hpp"
#include "rtps/refusal.hpp"
#include "rtps/submessages.hpp"
#include "rtps/writer_numbers.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace cortex::comms::rtps {

// Judges each datagram before Fast DDS sees it, and drops what could end, stop or mute a
// participant. Fast DDS 2.9 trusts what it reads: docs/security.md lists what follows from that.
// It takes memory for fragments and for names of endpoints only, both within bounds. Any thread.
class DatagramFilter {
public:
    // `isRelayed`: a Discovery Server passes on what participants say.
    explicit DatagramFilter(const Prefix& us, int domain = 0, bool isRelayed = false)
        : us_{us}, domain_{domain}, places_{domain, isRelayed} {}

    struct Admitted {
        // The fragments of a sample that has all of them now, to be processed before the rest.
        std::vector<Message> whole;
        std::size_t left = 0;  // bytes of the datagram, its first ones; 0: it is dropped
    };
    // What is left of a datagram from an IPv4 address. The bytes may be changed: statistics of
    // Fast DDS are taken out, and so are fragments, which wait until their sample has all of them;
    // parameters that nobody needs become padding, endpoints of foreign topics become gaps, and
    // great steps of numbers become smaller.
    Admitted admit(Bytes datagram, std::uint32_t address, std::int64_t now);

    // Whether the participant was heard, but not for a while.
    bool isSilent(const Prefix& participant, std::int64_t now) const;

    // Whether Fast DDS skips what this writer says, as others gave greater numbers in its name.
    bool skips(const WriterGuid& writer, std::int64_t now) const;

    // What is sent is noted: nobody can acknowledge more than our writers have written.
    void noteSent(Bytes datagram, std::int64_t now);

    // Samples of this writer may come in fragments; whether it sends again what was lost.
    void allowFragments(const WriterGuid& writer, bool comesAgain, std::int64_t now);

    std::uint64_t dropped(Refusal reason) const;
    std::string lastSender(Refusal reason) const;  // address of the last that was dropped
    std::uint64_t dropped() const;                 // for any reason
    std::string summary() const;  // by reason, in words; empty: nothing was dropped
    // A sentence for each reason for which something was dropped, at most one a second.
    std::vector<std::string> takeReports(std::int64_t now);

private:
    Refusal judge(Bytes& datagram, std::uint32_t address, std::int64_t now);
    Refusal judgeNumbers(Bytes& datagram, Prefix sender, std::uint32_t address, std::int64_t now);
    Refusal judgeNumber(const Submessage& submessage, const Prefix& sender, std::uint32_t address,
                        std::int64_t now);
    Refusal judgeEndpoint(const Submessage& submessage, const Prefix& sender, std::int64_t now);
    bool isEcho(const Submessage& data, const Prefix& sender) const;
    std::vector<Message> takeFragments(Bytes& datagram, std::int64_t now);
    void note(Refusal refusal, std::uint64_t count, std::uint32_t address);
    bool admitsHeartbeat(const Submessage& heartbeat, const Prefix& sender, std::int64_t now);
    bool admitsGap(const Submessage& gap, const Prefix& sender, std::int64_t now);
    void askFromTheBeginning(const Submessage& ackNack, const Prefix& sender, std::int64_t now);

    const Prefix us_;
    const std::int64_t domain_;
    mutable std::mutex mutex_;
    ParticipantLimits participants_;
    ParticipantPlaces places_;
    WriterNumbers numbers_;
    RecentTable<WriterGuid, std::int64_t> sent_{256};  // the newest number of each of our writers
    RecentTable<WriterGuid, bool> fragmented_{4096};   // whether a lost sample comes again
    struct Asked {
        std::uint32_t count = 0;  // of the newest ACKNACK
        std::int64_t base = 0;
    };
    // By participant and announcing writer of ours: from where on it asked last.
    RecentTable<WriterGuid, Asked> asked_{1024};
    Fragments fragments_;
    EndpointLimits endpoints_;
    struct Dropped {
        std::uint64_t count = 0, reported = 0;
        std::uint32_t address = 0;  // of the last
        std::int64_t told = 0;      // when
    };
    std::array<Dropped, refusals> dropped_{};
};

}  // namespace cortex::comms::rtps
