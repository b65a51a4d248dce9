// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"
#include "cortex/core/error.hpp"

#include "mirror/mirror_agents.hpp"
#include "mirror/mirror_endpoints.hpp"
#include "mirror/mirror_inbox.hpp"
#include "mirror/mirror_listeners.hpp"
#include "mirror/mirror_past.hpp"
#include "mirror/mirror_tools.hpp"
#include "peers/rejoin.hpp"
#include "peers/sent_commands.hpp"

#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace cortex::comms {

// The state of a mirror; used under its mutex.
struct MirrorState {
    explicit MirrorState(const Sender& tool)
        : agents{[this](const MirrorAgent& agent, const char* why) {
              commands.lose(agent.model.agent(), why);
          }},
          tools{std::string{tool.nameText()}},
          past{std::string{tool.nameText()}},
          commands{tool} {}

    // Whether all participants that were found, or that another one hears, have sent everything,
    // and no new one was found for that time.
    bool everybodyIsHere(Mirror::Milliseconds quiet = Mirror::usualQuiet) const;
    bool everybodyIsKnown(Moment now) const;
    // Whether the path has an owner, and nobody who was found may come before it. Whoever has not
    // said everything after that time does not count.
    bool isOwned(std::string_view path, Mirror::Milliseconds others);

    MirrorAgents agents;
    MirrorTools tools;  // the others
    ToolWords words;    // of this one
    MirrorPast past;
    SentCommands commands;
    MirrorView view;
    bool summarised = false;  // summaries are viewed
    Listeners<const AgentEvent&> listeners;
    Listeners<const std::string&, const AgentImage&> imageListeners;
    // How many participants send presences, whether theirs has come already or not.
    std::uint32_t speakers = 0;
    std::uint32_t nameless = 0;  // of those: theirs has not come
    std::uint32_t closed = 0;    // those with security, while this mirror has none
    Moment news = std::chrono::steady_clock::now();  // when the last of them was discovered
    bool mayCommand = false;                         // soon
    bool stopping = false;
    std::string failure;  // why the thread has ended
};

// The thread of a mirror. It processes what arrives, observes the time, and writes what is due.
class MirrorThread {
public:
    MirrorThread(const std::string& name, const NetworkOptions& options);
    ~MirrorThread();

    const std::string& name() const { return name_; }
    // Sends a command; `budget`: how long its answer may take. Returns its number, by which the
    // answer is found. Throws Error if no agent has the path or its type has no such command.
    std::uint64_t send(std::string_view path, std::string_view command,
                       const Mirror::Arguments& arguments, Mirror::Milliseconds budget);
    std::uint64_t refused() const;  // messages not believed or dropped, since the start
    // Those that never got as far as to be read, by the reason.
    std::map<std::string, Refused> refusals() const {
        const std::lock_guard lock{mutex_};
        return endpoints_->refusals();
    }

    // Calls `function` with the state, under the mutex.
    template <class Function>
    auto read(Function function) {
        const std::lock_guard lock{mutex_};
        return function(state_);
    }
    // The same, and the thread acts on it at once.
    template <class Function>
    void change(Function function) {
        read(function);
        inbox_.wake();
    }
    // Waits until `condition` holds, which is checked after everything that happens. False: not
    // within `limit`. Throws Error if the network refuses what was asked for.
    template <class Condition>
    bool waitFor(Mirror::Milliseconds limit, Condition condition) {
        std::unique_lock lock{mutex_};
        const bool held = changed_.wait_for(
            lock, limit, [&] { return !state_.failure.empty() || condition(state_); });
        if (!state_.failure.empty()) throw Error(state_.failure);
        return held;
    }

private:
    void run();
    bool turn();  // false: the thread is to end
    // What was received; returns the agent that has a new image, or null.
    const MirrorAgent* take(const MirrorSample& sample, Moment now);
    void takeAndTell(const MirrorSample& sample);  // outside of the mutex
    void serve(Moment now);                        // sends what is due, finds who is lost
    void join();
    void joinAnew(Moment now);  // where that is due
    void tellListeners();       // outside of the mutex

    std::string name_;
    const NetworkOptions options_;
    Sender tool_;
    MirrorInbox inbox_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    MirrorState state_;
    std::vector<AgentEvent> events_;              // to tell the listeners
    std::unique_ptr<MirrorEndpoints> endpoints_;  // another one under the mutex only
    Rejoin rejoin_;
    std::thread thread_;
};

}  // namespace cortex::comms
