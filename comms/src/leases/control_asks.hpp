// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/lease_client.hpp"

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace cortex::comms {

// Who holds a part of what lies at and below a prefix, `mirror` itself left out; by name.
std::vector<LeaseClient::Holder> holdersOf(const Mirror& mirror, const std::string& prefix);

// What we ask others for, and what they ask us for. One thread at a time.
class ControlAsks {
public:
    using Moment = std::chrono::steady_clock::time_point;
    using Leases = std::vector<LeaseClient::Lease>;

    explicit ControlAsks(Mirror& mirror) : mirror_{mirror} {}

    void ask(const std::string& prefix, Moment now);
    void withdraw();
    LeaseClient::Asking asking() const;
    // `held`: what we hold; of that we give.
    std::vector<LeaseClient::Asked> asked(const Leases& held) const;
    void refuse(const LeaseClient::Asked& asked);
    // To be called some times a second.
    void step(Moment now, std::vector<std::string>& news);

private:
    using Named = std::pair<std::string, std::uint64_t>;  // a tool, and the number of its ask

    bool addUnshown(const std::vector<LeaseClient::Holder>& before);
    void follow(Moment now, std::vector<std::string>& news);
    void end(std::string why, std::vector<std::string>& news);
    void tell(const ControlAsk& asks);

    Mirror& mirror_;
    ControlAsk own_;  // number 0: none
    std::uint64_t last_ = 0;
    Moment begun_{};
    bool met_ = false;  // somebody who holds a part of it
    std::vector<LeaseClient::Holder> holders_;
    struct Came {
        Named named;
        Moment when;
    };
    std::vector<Came> came_;      // asks of others, in the order in which they came
    std::vector<Named> refused_;  // those of them that we refused
};

}  // namespace cortex::comms
