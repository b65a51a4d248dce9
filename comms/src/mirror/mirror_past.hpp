// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mirror/mirror_agents.hpp"
#include "peers/moment.hpp"
#include "wire/messages.hpp"
#include "wire/past_ask.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cortex::comms {

// What a mirror asks agents for of the past. Each answers a part at a time; a few are asked at
// once. Used under the mutex of the mirror.
class MirrorPast {
public:
    explicit MirrorPast(std::string self) : self_{std::move(self)} {}

    std::uint64_t ask(const std::string& agent, std::int64_t from, std::int64_t until);
    bool poll(std::uint64_t number, PastEvents& past);  // once
    // What has come so far, which nobody will fetch any more.
    PastEvents giveUp(std::uint64_t number);

    void take(const PastMessage& message, Moment now);
    void tick(const MirrorAgents& agents, Moment now);  // begins what is due, finds who is silent
    std::vector<std::string> words() const;             // of the asks that are on their way
    bool waiting() const;
    std::uint64_t refused() const { return refused_; }

private:
    struct Asked {
        PastAsk ask;
        PastEvents past;
        std::int64_t epoch = 0;       // of the start that answers; 0: nothing has come
        std::optional<Moment> moved;  // since then it waits; none: it has not begun
        Moment begun{};
        std::size_t octets = 0;  // of texts that came
        bool over = false;
    };
    Asked* asked(const PastMessage& message);
    void begin(Moment now);
    static void finish(Asked& asked, std::string trouble);

    std::string self_;
    std::map<std::uint64_t, Asked> asked_;  // by number
    std::uint64_t number_ = 0, refused_ = 0;
};

}  // namespace cortex::comms
