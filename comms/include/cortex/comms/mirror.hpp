// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/network_options.hpp"
#include "cortex/core/image.hpp"
#include "cortex/core/program_interface.hpp"
#include "cortex/core/report.hpp"
#include "cortex/core/structure.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cortex::comms {

// An agent on the network as it was last heard.
struct AgentStatus {
    std::string name, host;
    std::int64_t epoch = 0;                  // UTC microseconds
    std::string state;                       // "running", "incomplete", "lost"
    double age = 0;                          // s since it was last heard
    std::uint32_t types = 0, simplexes = 0;  // that it says to have
    std::uint32_t missing = 0;               // of them not here yet
    std::int64_t cycle = 0;                  // newest
    std::int64_t period = 0;                 // ns
    std::uint64_t loss = 0;                  // blocks and events that did not come
    std::string security;
    std::string trouble;  // why it stays incomplete: what in its model contradicts itself
};

struct AgentEvent {
    std::string agent;
    std::int64_t epoch = 0;
    std::uint64_t number = 0;  // per agent and epoch, from 1
    std::int64_t cycle = 0;
    std::int64_t wallClock = 0;  // UTC ns
    Severity severity = Severity::Info;
    std::string kind, path, text;
};

struct CommandAnswer : CallResult {
    std::chrono::nanoseconds latency{};  // in the agent, from reading it to its end
};

// An image of another agent. It keeps its structure and its tables, whatever becomes of the agent.
class AgentImage {
public:
    AgentImage() = default;
    AgentImage(std::shared_ptr<const void> keeps, Image image)
        : keeps_{std::move(keeps)}, image_{std::move(image)} {}
    AgentImage(AgentImage&&) noexcept = default;
    AgentImage& operator=(AgentImage&& other) noexcept {
        image_ = std::move(other.image_);  // lets go before what it lies in may end
        keeps_ = std::move(other.keeps_);
        return *this;
    }

    explicit operator bool() const { return static_cast<bool>(image_); }
    const Image& operator*() const { return image_; }
    const Image* operator->() const { return &image_; }

private:
    std::shared_ptr<const void> keeps_;
    Image image_;  // ends first
};

// All agents of a domain for tools: who is there, what they consist of, their values, events and
// commands, without knowing any of it before. Has a thread of its own; any thread may call. What is
// not asked for is neither subscribed nor decoded.
class Mirror {
public:
    using Arguments = ProgramInterface::Arguments;
    using Milliseconds = std::chrono::milliseconds;

    // Other instances of the tool have names of their own: host and process are appended. Throws
    // Error if the network cannot be used, with a remedy.
    explicit Mirror(const std::string& tool, const NetworkOptions& options = {});
    ~Mirror();

    const std::string& name() const;  // as agents see it: the holder of its control leases

    std::vector<AgentStatus> agents() const;  // by name; one lost for a minute is forgotten
    std::uint32_t unheard() const;  // so many agents are heard by one of them, and not here
    // Waits until somebody is there, everybody has told everything, all whom they hear are here,
    // and nobody new comes. False: not within `limit`.
    bool waitUntilComplete(Milliseconds limit) const;
    // Null until everything of the agent is here. Later starts have structures of their own.
    std::shared_ptr<const Structure> structure(const std::string& agent) const;
    // The agent whose simplex this is; of several that claim it, the one that started first.
    std::optional<std::string> ownerOf(std::string_view path) const;
    // The same as soon as it is known; none: everything is here without it, or `limit` is over.
    std::optional<std::string> waitForOwner(std::string_view path, Milliseconds limit) const;

    // From now on the values of all simplexes at and below these paths, at this many images per
    // second or more; 0: every cycle. It takes the place of the last call; no paths: none.
    void view(std::vector<std::string> prefixes, std::uint32_t rate = 30);
    // Waits until all that is viewed has come at least once from every agent that is heard.
    bool waitForValues(Milliseconds limit) const;
    // The newest; empty if nothing of the agent is viewed. Simplexes that are not viewed, or have
    // not come, have quality `lost`; those that should have come again, `stale`.
    AgentImage image(const std::string& agent) const;
    // s since it was measured; none: its values have not come.
    std::optional<double> age(const std::string& agent, std::uint32_t simplex) const;
    // Waits until an image newer than `last` images of all agents together; says how many there
    // are.
    std::uint64_t waitForImage(std::uint64_t last, Milliseconds limit) const;

    // A command that is over if the agent has not read it within `budget` of its own time. The
    // number identifies the answer. Throws Error for unknown paths, commands and parameters and for
    // values of the wrong kind; states and ranges are checked by the agent.
    std::uint64_t send(std::string_view path, std::string_view command,
                       const Arguments& arguments = {},
                       Milliseconds budget = std::chrono::seconds{5});
    bool poll(std::uint64_t number, CommandAnswer& answer);  // once; Running is not an answer
    CommandAnswer call(std::string_view path, std::string_view command,
                       const Arguments& arguments = {},
                       Milliseconds timeout = std::chrono::seconds{5});

    // Events of all agents, the last 1,000 of each first. Called on the mirror's thread.
    void onEvent(std::function<void(const AgentEvent&)> listener);
    // Whether the newest event that each agent which is heard says to have written has come: it
    // says so ten times a second.
    bool eventsComplete() const;

    std::uint64_t refused() const;  // samples that were malformed or said what cannot be

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace cortex::comms
