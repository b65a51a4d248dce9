// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace cortex::explorer {

// The control leases that this process holds. A thread of its own renews them, notices that one is
// lost, and accepts those that are handed over to us. The end releases all. Any thread.
class Leases {
public:
    using Milliseconds = std::chrono::milliseconds;
    struct Key {
        std::string agent, prefix;
        bool operator==(const Key&) const = default;
    };

    explicit Leases(comms::Mirror& mirror);
    ~Leases();
    Leases(const Leases&) = delete;
    Leases& operator=(const Leases&) = delete;

    // What the agent answers. A lease that is Done is renewed from now on.
    comms::CommandAnswer take(const Key& key, Milliseconds limit);
    comms::CommandAnswer release(const Key& key, Milliseconds limit);
    comms::CommandAnswer handOver(const Key& key, const std::string& to, Milliseconds limit);

    std::vector<Key> held() const;
    bool covers(const std::string& agent, const std::string& path) const;
    // From now on accepts what is handed over to us; `look` is called about twice a second.
    void acceptOffers(std::function<void()> look);
    // What happened to leases without us, as sentences; each once.
    std::vector<std::string> news();

private:
    using Moment = std::chrono::steady_clock::time_point;
    enum class State { Asked, Held, Offered };
    struct Lease {
        Key key;
        State state = State::Asked;
        std::uint64_t number = 0;  // of the renewal that is on its way; 0: none
        Moment sent{}, renewed{};
    };

    comms::CommandAnswer ask(const Key& key, const char* command, const std::string& to,
                             Milliseconds limit);
    void set(const Key& key, State state);
    void forget(const Key& key);
    void keep();
    bool renew(Lease& lease, Moment now);  // false: it is over
    void send(Lease& lease, Moment now);
    void findOffers();

    comms::Mirror& mirror_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Lease> leases_;
    std::vector<std::string> news_;
    std::function<void()> look_;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace cortex::explorer
