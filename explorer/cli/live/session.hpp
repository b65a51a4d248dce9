// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/lease_client.hpp"

#include "live/ask_news.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace cortex::cli {

// A participant with its mirror and its leases. A verb has one for itself; those of a shell share
// one, one after the other. Main thread.
class Session {
public:
    static constexpr std::uint32_t slowRate = 5;  // of a view that nobody waits for
    using Milliseconds = std::chrono::milliseconds;
    using Listener = std::function<void(const comms::AgentEvent&)>;

    // `named`: interfaces that its user named; `timeout`: of a verb in it that names none.
    Session(const comms::NetworkOptions& options, std::vector<std::string> named,
            Milliseconds timeout);

    comms::Mirror& mirror() { return mirror_; }
    comms::LeaseClient& leases() { return leases_; }
    int domain() const { return domain_; }
    const std::vector<std::string>& named() const { return named_; }
    const std::string& discoveryServer() const { return server_; }  // empty: none
    Milliseconds timeout() const { return timeout_; }
    std::chrono::steady_clock::time_point since() const { return since_; }  // on the network
    // Tells the others who uses this session. Throws Error for what nobody may be called.
    void introduce(const std::string& person);
    const std::string& person() const { return person_; }  // empty: nobody was introduced
    // Commands are on behalf of this person from now on; empty: of whoever uses this session.
    void actFor(const std::string& person);
    AskNews& askNews() { return askNews_; }
    // As the mirror does, but an interrupt ends it; `meanwhile` is called ten times a second.
    comms::CommandAnswer call(const std::string& path, const std::string& command,
                              const comms::Mirror::Arguments& arguments, Milliseconds limit,
                              const std::function<void()>& meanwhile = {});
    // As the mirror does; it replaces the last view.
    void view(std::vector<std::string> prefixes, std::uint32_t rate);
    // From now on agents may hand leases over to us: their own simplexes are always viewed.
    void acceptOffers();
    // The last 1,000 events of each agent that came since the first call, and then all others.
    // It replaces the last listener; an empty one ends it.
    void listen(Listener listener);

private:
    void take(const comms::AgentEvent& event);
    void applyView();  // with the agents that are there now

    int domain_;
    std::vector<std::string> named_;
    std::string server_;
    Milliseconds timeout_;
    std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
    std::string person_;
    AskNews askNews_;
    std::mutex viewMutex_;
    std::vector<std::string> wanted_, viewed_;
    std::uint32_t rate_ = slowRate, viewedRate_ = slowRate;
    bool viewsAgents_ = false;
    std::mutex mutex_;  // of what follows, until the mirror
    bool listens_ = false;
    std::map<std::string, std::vector<comms::AgentEvent>> events_;
    Listener listener_;
    comms::Mirror mirror_;       // its thread calls take()
    comms::LeaseClient leases_;  // ends first, and releases what it holds
};

}  // namespace cortex::cli
