// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include "live/nobody.hpp"
#include "live/patience.hpp"
#include "live/session.hpp"
#include "text/output.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::cli {

inline constexpr double usualTimeout = 3, shortestTimeout = 0.001, longestTimeout = 1e6;  // s

// Which network to look at, and for how long to wait for it.
struct NetworkArguments {
    std::optional<int> domain;  // none: CORTEX_DOMAIN, or 0
    std::vector<std::string> interfaces, peers;
    std::optional<std::string> discoveryServer;  // none: CORTEX_DISCOVERY_SERVER
    std::optional<std::string> security;         // folder; none: CORTEX_SECURITY
    std::optional<double> timeout;               // s; none: that of its shell, CORTEX_TIMEOUT or 3
    std::shared_ptr<Session> session;            // that of a shell; none: one of its own
};

comms::NetworkOptions optionsOf(const NetworkArguments& arguments);
int domainOf(const NetworkArguments& arguments);
std::shared_ptr<Session> makeSession(const NetworkArguments& arguments);

// One simplex of an agent that is not lost.
struct FoundSimplex {
    std::string agent;
    std::shared_ptr<const Structure> structure;
    std::uint32_t index = 0;

    const SimplexInfo& info() const { return structure->simplexes[index]; }
    const Type& type() const { return *info().layout->type; }
};

// The network as verbs see it: waits as long as was asked for, and fails in words.
class Live {
public:
    explicit Live(const NetworkArguments& arguments);
    ~Live();
    Live(const Live&) = delete;
    Live& operator=(const Live&) = delete;

    comms::Mirror& mirror() { return session_->mirror(); }
    const comms::Mirror& mirror() const { return session_->mirror(); }
    comms::LeaseClient& leases() { return session_->leases(); }
    AskNews& askNews() { return session_->askNews(); }
    const std::string& person() const { return session_->person(); }  // who uses it, if known
    // On whose behalf its commands are, to its end; empty: of whoever uses it.
    void actFor(const std::string& person) { session_->actFor(person); }
    std::chrono::steady_clock::time_point since() const { return session_->since(); }
    void view(std::vector<std::string> prefixes, std::uint32_t rate) {
        session_->view(std::move(prefixes), rate);
    }
    void listen(Session::Listener listener) { session_->listen(std::move(listener)); }
    // Everything that waits ends with the time to wait, or throws Interrupted.
    bool waitForValues();
    comms::CommandAnswer call(const std::string& path, const std::string& command,
                              const comms::Mirror::Arguments& arguments,
                              const std::function<void()>& meanwhile = {}) {
        return session_->call(path, command, arguments, left(), meanwhile);
    }
    // Until everything of everybody is here, and where nothing of it is at or below the prefix,
    // until nobody new comes; throws Failure if nobody is there.
    void waitForAll(const std::string& prefix = "/");
    bool waitForAny();  // the first half of it; false: nobody is there
    // The path, if several agents have it.
    std::optional<comms::Contested> contestOf(const std::string& path) const;
    void tellContest(const std::string& path);  // on standard error, once
    // Paths of several agents, agents whose loop is not well, and participants that cannot be seen
    // without security, on standard error.
    void printWarnings() const;
    void printClosed() const;  // the last of these alone
    comms::AgentStatus statusOf(const std::string& agent) const;
    // Participants that did not say who they are. Who comes when everybody was there does not
    // count.
    std::uint32_t nameless() const { return everybodyCame_ ? 0 : mirror().nameless(); }
    // "incomplete: 37 of 44 from robot", or "" when all is here of everybody who was found.
    std::string incomplete() const;
    // "this tool itself refused messages: 12 (…, the last from 127.0.0.1), …", or "" where it let
    // everything in.
    std::string refusedHere() const;
    // Throws Failure naming the nearest. `others`: how long after everything of its agent has come
    // others are awaited that may own it, too.
    FoundSimplex find(const std::string& path,
                      std::chrono::milliseconds others = comms::Mirror::timeToMeet);
    std::optional<std::string> ownerOf(const std::string& path) const {
        return mirror().ownerOf(path);
    }
    // Waits until its agent is heard, or nobody is left who may be it and nobody new comes.
    std::optional<std::string> waitForOwner(
        const std::string& path, std::chrono::milliseconds others = comms::Mirror::timeToMeet);
    std::vector<FoundSimplex> below(const std::string& prefix) const;  // by path
    // Its newest values, with those of others of its agent; waits for them. Throws Failure if its
    // own do not come.
    comms::AgentImage values(const FoundSimplex& simplex,
                             const std::vector<std::uint32_t>& others = {});

    // Of the time to wait; 1 ms when it is over.
    std::chrono::milliseconds left() const {
        return patience_.left(std::chrono::steady_clock::now());
    }
    bool isLimited() const { return !patience_.grows(); }  // somebody has said how long to wait
    bool over() const { return patience_.over(std::chrono::steady_clock::now()); }
    std::chrono::milliseconds timeout() const { return patience_.time(); }
    std::string limitText() const;  // "3 s": for how long it waits, as far as is known by now
    int domain() const { return session_->domain(); }
    Trouble nobody() const;  // why no agent is heard, with what to try
    // Throws Failure naming the nearest, unless somebody has, or may have, something there.
    void failIfNothingIsAt(const std::string& prefix) const;
    [[noreturn]] void failWithNobody() const;  // throws that as Failure

private:
    template <class Wait>
    bool waitInSlices(Wait wait);
    std::uint64_t known() const;
    std::vector<std::string> paths() const;
    std::string heard() const;
    std::string elsewhere() const;
    std::vector<int> otherDomains() const;
    std::uint64_t strangers() const;

    Patience patience_;
    std::shared_ptr<Session> session_;
    std::set<std::string> told_;  // paths of several agents
    bool everybodyCame_ = false;
};

// Throws Failure unless it can be the path of a simplex; a prefix may be "/" too.
void checkPath(const std::string& path);
void checkPrefix(const std::string& prefix);

}  // namespace cortex::cli
