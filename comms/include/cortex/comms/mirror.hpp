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

// An agent on the network, as of its last message.
struct AgentStatus {
    std::string name, host;
    std::int64_t epoch = 0;  // UTC microseconds
    std::string state;       // "running", "overloaded", "standstill", "incomplete", "lost"
    bool ended = false;      // lost, as it said itself or as another start of it took its place
    // When it was heard first, by a clock that only grows; 0: it was there before this mirror. Of
    // several that claim a path, one that is heard owns it, then the least `since`, then `epoch`.
    std::int64_t since = 0;
    double age = 0;                          // s since its newest cycle
    std::uint32_t types = 0, simplexes = 0;  // as it announces them
    std::uint32_t missing = 0;               // those that have not come yet
    std::int64_t cycle = 0;                  // newest
    std::int64_t period = 0;                 // ns
    // Blocks and events that did not come; of a view of every cycle, cycles and events.
    std::uint64_t loss = 0;
    std::string security;
    std::string trouble;      // the contradiction in its model that keeps it incomplete
    std::string standstill;   // of its loop: "hangs in /ctl.stateActive for 8.5 s"
    double rate = 0;          // Hz, what its loop reached of late; 0: not said
    bool overloaded = false;  // its loop misses more than a tenth of its ticks
    std::string dropped;      // datagrams, by reason: "12 as a submessage is out of bounds; 3 as …"
    std::string refused;      // messages: "4: a command with a wrong id", the reason of the last
};

// An event of an agent, as it was published.
struct AgentEvent {
    std::string agent;
    std::int64_t epoch = 0;
    std::uint64_t number = 0;  // per agent and epoch, from 1
    std::int64_t cycle = 0;
    std::int64_t wallClock = 0;  // UTC ns
    Severity severity = Severity::Info;
    std::string kind, path, text;
    // Number among the events that the same input causes again; 0: it came from measured times.
    // None: its agent does not say so.
    std::optional<std::uint64_t> repeatable{};
};

// The answer to a command, with the time that it took.
struct CommandAnswer : CallResult {
    std::chrono::nanoseconds latency{};  // in the agent, from reading it to its end
};

// An image of another agent. It keeps its structure and its tables even after the agent is gone.
class AgentImage {
public:
    AgentImage() = default;
    AgentImage(std::shared_ptr<const void> keeps, Image image, std::vector<bool> came,
               bool lost = false)
        : keeps_{std::move(keeps)}, image_{std::move(image)}, came_{std::move(came)}, lost_{lost} {}
    AgentImage(AgentImage&&) noexcept = default;
    AgentImage& operator=(AgentImage&& other) noexcept {
        image_ = std::move(other.image_);  // releases the image before the memory that it lies in
        keeps_ = std::move(other.keeps_);
        came_ = std::move(other.came_);
        lost_ = other.lost_;
        return *this;
    }

    explicit operator bool() const { return static_cast<bool>(image_); }
    const Image& operator*() const { return image_; }
    const Image* operator->() const { return &image_; }
    // Whether the agent ever sent this simplex. Such a simplex may be `lost` because an input of it
    // is, or its agent; without it, `lost` means that only its constants are known.
    bool came(std::uint32_t simplex) const { return simplex < came_.size() && came_[simplex]; }
    // Whether the agent was not heard any longer. Then its values are the last ones that came.
    bool lost() const { return lost_; }

private:
    std::shared_ptr<const void> keeps_;
    Image image_;  // ends first
    std::vector<bool> came_;
    bool lost_ = false;
};

// All agents of a domain for tools: their models, values, events and commands, without any prior
// knowledge of them. It has a thread of its own, and any thread may call it. What nobody asks for
// is neither subscribed to nor decoded.
class Mirror {
public:
    using Arguments = ProgramInterface::Arguments;
    using Milliseconds = std::chrono::milliseconds;

    // Host and process are appended to the name, so that each instance has its own. Throws Error
    // with a remedy if the network cannot be used.
    explicit Mirror(const std::string& tool, const NetworkOptions& options = {});
    ~Mirror();

    const std::string& name() const;  // as agents see it: the holder of its control leases

    std::vector<AgentStatus> agents() const;  // by name; without those lost for more than a minute
    std::uint32_t unheard() const;   // agents that another agent hears and this mirror does not
    std::uint32_t nameless() const;  // found on the network, and have not said yet who they are
    // Participants with security that were found, while this mirror has none: it cannot see more.
    std::uint32_t closed() const;
    // Waits until at least one agent is present, everything of all has come, all whom they hear are
    // known here, and no new one appears. False: not within `limit`.
    bool waitUntilComplete(Milliseconds limit) const;
    // Null until everything of the agent has come. A later start has a structure of its own.
    std::shared_ptr<const Structure> structure(const std::string& agent) const;
    // The agent that owns this simplex. Of several that claim it, the one that was heard
    // first; of those that were there before this mirror, the one that says it started first.
    std::optional<std::string> ownerOf(std::string_view path) const;
    // The same as soon as it is known. None: everything has come and nobody owns it, or `limit` is
    // over.
    std::optional<std::string> waitForOwner(std::string_view path, Milliseconds limit) const;

    // Receives from now on the values of all simplexes at and below these paths, at this rate or
    // more (images per second; 0: every cycle). It replaces the last call. No paths: no values.
    void view(std::vector<std::string> prefixes, std::uint32_t rate = 30);
    // Waits until every agent that is present has sent everything that is viewed at least once.
    bool waitForValues(Milliseconds limit) const;
    // The newest image; empty if nothing of the agent is viewed. Simplexes that are not viewed, or
    // have not come, have the quality `lost`. Those that should have come again have `stale`.
    AgentImage image(const std::string& agent) const;
    // Reports each image that an agent sends, in order and before the next is taken in. The
    // listener runs on the mirror's thread: it copies what it needs, does not throw, and returns.
    // Images that were lost on the way are counted in AgentStatus::loss; of a view of every cycle
    // they show as a gap in the cycles.
    void onImage(std::function<void(const std::string& agent, const AgentImage&)> listener);
    // Seconds since the measurement. None: no values have come.
    std::optional<double> age(const std::string& agent, std::uint32_t simplex) const;
    // The same for every simplex at one instant, by its index. Empty: nothing of it is viewed.
    std::vector<std::optional<double>> ages(const std::string& agent) const;
    // Waits until all agents together have published more than `last` images, and returns their
    // number.
    std::uint64_t waitForImage(std::uint64_t last, Milliseconds limit) const;

    // From now on its commands say that they are on behalf of this person or program (at most 31
    // bytes; empty: of the tool itself). Events and answers say it again; no right follows from it.
    // Throws Error for a longer name or one with control characters.
    void actFor(const std::string& person);
    // Sends a command. It expires if the agent has not read it within `budget` of the agent's time.
    // The number identifies the answer. Throws Error for unknown paths, commands and parameters,
    // and for values of the wrong kind. The agent checks states and ranges.
    std::uint64_t send(std::string_view path, std::string_view command,
                       const Arguments& arguments = {},
                       Milliseconds budget = std::chrono::seconds{5});
    bool poll(std::uint64_t number, CommandAnswer& answer);  // once; Running is not an answer
    bool waitForAnswer(std::uint64_t number, CommandAnswer& answer, Milliseconds limit);
    void abandon(std::uint64_t number);  // nobody will fetch the answer
    CommandAnswer call(std::string_view path, std::string_view command,
                       const Arguments& arguments = {},
                       Milliseconds timeout = std::chrono::seconds{5});

    // Reports the events of all agents, the last 1,000 of each first. The listener runs on the
    // mirror's thread.
    void onEvent(std::function<void(const AgentEvent&)> listener);
    // Whether all events have come that the present agents say they have written. They say so ten
    // times a second.
    bool eventsComplete() const;

    std::uint64_t refused() const;  // samples that were malformed or impossible

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace cortex::comms
