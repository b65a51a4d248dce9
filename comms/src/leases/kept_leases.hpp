// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/lease_client.hpp"

#include "leases/errand.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace cortex::comms {

// The leases that agents have granted us or may have handed over to us, and their renewal. One
// thread at a time.
class KeptLeases {
public:
    using Lease = LeaseClient::Lease;
    using Moment = Errand::Moment;

    explicit KeptLeases(Mirror& mirror) : mirror_{mirror} {}

    // It is renewed from now on, and counts as held once settle() says so.
    void grant(const std::string& agent, const std::string& prefix, Moment sent);
    void settle(const std::string& agent, const std::string& prefix);
    void drop(const std::string& agent, const std::string& prefix);
    void dropBelow(const std::string& agent, const std::string& prefix);
    // Others may hand a lease over to us: it is ours once it is renewed. One that we lost is no
    // such lease, as long as its agent, which stood still meanwhile, takes it for ours.
    void findOffers();
    void renew(Moment now, bool renews);
    bool waits() const;  // for an answer

    std::vector<Lease> held() const;
    std::vector<Lease> granted() const;  // those held included
    std::vector<std::string> takeNews();

private:
    enum class State { Granted, Held, Offered };
    struct Kept {
        Lease lease;
        State state = State::Granted;
        Errand renewal{};
        Moment renewed{};
        std::int64_t cycle = 0;  // in which its agent gave it; 0: it was not seen yet
    };
    struct Lost {
        std::string agent, prefix;
        std::int64_t cycle = 0;
    };

    Kept* find(std::string_view agent, std::string_view prefix);
    bool renewOne(Kept& kept, Moment now, bool renews);  // false: it is over
    bool lose(const Kept& kept, const std::string& why);
    bool hasEnded(const std::string& agent) const;
    void take(const ShownLease& shown);
    bool wasLost(const ShownLease& shown) const;

    Mirror& mirror_;
    std::vector<Kept> leases_;
    std::vector<Lost> lost_;  // that their agents may still take for ours
    std::vector<std::string> news_;
};

}  // namespace cortex::comms
