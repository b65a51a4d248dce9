// SPDX-License-Identifier: Apache-2.0
// What a mirror tells of agents (mirror.hpp).
#pragma once

#include "cortex/comms/simplex_mark.hpp"
#include "cortex/core/image.hpp"
#include "cortex/core/program_interface.hpp"
#include "cortex/core/report.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cortex::comms {

// An agent on the network, as of its last message.
struct AgentStatus {
    std::string name, host;
    std::int64_t epoch = 0;  // UTC microseconds
    std::string state;       // "running", "overloaded", "standstill", "incomplete", "lost"
    bool ended = false;      // lost, as it said itself or as another start of it took its place
    // When it was heard first, by a clock that only grows; 0: it was there before this mirror.
    std::int64_t since = 0;
    double age = 0;                          // s since its newest cycle
    std::uint32_t types = 0, simplexes = 0;  // as it announces them
    std::uint32_t missing = 0;               // those that have not come yet
    std::uint32_t missingTypes = 0;          // as many of them are types
    std::vector<std::string> missingNames;   // a few of these types, as others name them
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
    std::string otherSelf;    // who else speaks in its name, in words; empty: nobody
    std::uint32_t hears = 0;  // agents, itself included, as it says; 0: not said
    bool summarises = false;  // it can say how all its simplexes are (Mirror::viewSummary)
    bool remembers = false;   // it can say what it keeps of the past (Mirror::askPast)
    std::string refused;      // messages: "4: a command with a wrong id", the reason of the last
};

// What a tool asks those for who hold control of a part of it. The number tells its asks apart,
// from 1; 0: it asks for nothing.
struct ControlAsk {
    std::uint64_t number = 0;
    std::string prefix;
    bool operator==(const ControlAsk&) const = default;
};

// Another tool that says who uses it, as a window and a shell do: a person may hold control in it.
struct ToolStatus {
    std::string name, host;  // the name as agents see it: the holder of its leases
    std::string person;      // as it says; nobody proves it, and no right follows from it
    std::string security;    // as AgentStatus; if "on", the name up to '@' is its certificate's
    ControlAsk asks;
    // The asks of others that it has refused of late: the name of the other tool, and the number.
    std::vector<std::pair<std::string, std::uint64_t>> refuses;
};

// Whether it can be the name of a person: 1 to 63 bytes of UTF-8 without control characters and
// brackets, as a tool's name stands in these behind it, and without a blank at either end.
bool isPersonName(const std::string& name);
// "alice (cortex@desk.4711-5e1f0a)"; without a person the name of the tool alone.
std::string whoText(const std::string& tool, const std::string& person);

// What was not let in for one reason.
struct Refused {
    std::uint64_t count = 0;
    std::string lastFrom;  // the address of the last sender; empty: it is not known
};

// Paths, with all simplexes below, and how many images of them a second are wanted.
struct Viewed {
    std::vector<std::string> prefixes;
    std::uint32_t rate = 30;  // at least; 0: every cycle
};

// A path that several agents have, or one without a right to it.
struct Contested {
    std::string path;
    std::vector<std::string> agents;
    std::string owner;  // that is shown, linked and commanded; empty: none
    std::string why;    // "which was there first"
    std::string text;   // all of it in one sentence
    bool operator==(const Contested&) const = default;
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

// What an agent has kept of a time that is over: faults and errors, changes of state, commands,
// refusals, control, losses, and values that changed their state. Each kind has room of its own.
struct PastEvents {
    struct Since {
        std::string kind;       // "fault"
        std::int64_t time = 0;  // UTC ns: everything of this kind after it is kept
    };

    std::string agent;
    // As they came. Their number is 0 where no event was published, such as a value that changed or
    // the end of an agent that crashed.
    std::vector<AgentEvent> events;
    std::vector<Since> since;  // of each kind
    std::string trouble;       // why it is not all that the agent has; empty: it is
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
               bool lost = false, std::vector<bool> behind = {})
        : keeps_{std::move(keeps)},
          image_{std::move(image)},
          came_{std::move(came)},
          behind_{std::move(behind)},
          lost_{lost} {}
    AgentImage(AgentImage&&) noexcept = default;
    AgentImage& operator=(AgentImage&& other) noexcept {
        image_ = std::move(other.image_);  // releases the image before the memory that it lies in
        keeps_ = std::move(other.keeps_);
        came_ = std::move(other.came_);
        behind_ = std::move(other.behind_);
        lost_ = other.lost_;
        return *this;
    }

    explicit operator bool() const { return static_cast<bool>(image_); }
    const Image& operator*() const { return image_; }
    const Image* operator->() const { return &image_; }
    // Whether the agent ever sent this simplex. Such a simplex may be `lost` because an input of it
    // is, or its agent; without it, `lost` means that only its constants are known.
    bool came(std::uint32_t simplex) const { return simplex < came_.size() && came_[simplex]; }
    // Whether its values are of a cycle before that of the image, as of one that is viewed at a
    // lower rate.
    bool isBehind(std::uint32_t simplex) const {
        return simplex < behind_.size() && behind_[simplex];
    }
    // Whether the agent was not heard any longer. Then its values are the last ones that came.
    bool lost() const { return lost_; }

private:
    std::shared_ptr<const void> keeps_;
    Image image_;  // ends first
    std::vector<bool> came_, behind_;
    bool lost_ = false;
};

}  // namespace cortex::comms
