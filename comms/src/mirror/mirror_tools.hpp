// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror_data.hpp"

#include "peers/moment.hpp"
#include "wire/messages.hpp"

#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace cortex::comms {

// What a tool says of itself in its presences.
struct ToolWords {
    std::string person;
    ControlAsk asks;
    std::vector<std::pair<std::string, std::uint64_t>> refuses;
    std::vector<std::string> past{};  // what it asks agents for

    std::vector<Extra> extras() const;
    bool operator==(const ToolWords&) const = default;
};

// Whether control of it can be asked for: "/", or the path of a simplex, of at most 127 bytes.
bool canBeAskedFor(const std::string& prefix);

// The other tools of the domain that say who uses them. Of several starts of one name the one that
// was heard first counts. Used under the mutex of the mirror.
class MirrorTools {
public:
    explicit MirrorTools(std::string self) : self_{std::move(self)} {}

    void take(const Presence& presence, Moment now);
    void withdraw(const Id& tool);
    void tick(Moment now);
    void excuse(std::chrono::nanoseconds still, Moment now);  // as MirrorAgents
    std::vector<ToolStatus> list() const;                     // by name

private:
    struct Tool {
        Presence presence;
        Moment heard;
        bool ends = false;  // as it or somebody in its name says
    };
    bool isGone(const Tool& tool, Moment now) const;

    std::string self_;
    std::map<std::string, Tool, std::less<>> tools_;
};

}  // namespace cortex::comms
