// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "agent/agent_self.hpp"
#include "wire/messages.hpp"

#include <cstdint>
#include <string>

namespace cortex::comms {

// Whether this start of the agent's name was there first. Of two that meet within 2 s of a start
// the longer one goes on, and the other is silent until that one ends. Later nobody silences this
// one, unless it stood still meanwhile and another took over in good faith.
class FirstOfName {
public:
    explicit FirstOfName(AgentSelf& self) : self_{self} {}

    void hear(const Presence& ours, std::int64_t now);  // of our name
    void expire(std::int64_t now);
    // This process stood still between the two.
    void stood(std::int64_t from, std::int64_t now);
    bool isSecond() const { return isSecond_; }
    // How many starts of the name are heard, this one included.
    std::uint32_t heard() const { return (ownHeard_ ? 1U : 0U) + (rivalHeard_ != 0 ? 1U : 0U); }
    // Who else spoke in this name of late, in words; empty: nobody.
    std::string otherSelf(std::int64_t now) const;
    // Whether what is heard now was there before this start.
    bool isNew(std::int64_t now) const;

private:
    bool mayBeSucceeded(std::int64_t now) const;  // it stood still of late
    bool tookOver(const Presence& rival, std::int64_t now) const;
    void yield(const std::string& why, std::int64_t now);
    bool comesBefore(const Presence& rival, std::int64_t now) const;
    void note(const std::string& text, std::int64_t now);
    std::string systemOf(const Presence& rival) const;
    void tell(Severity severity, const std::string& text, std::int64_t now);

    AgentSelf& self_;
    std::int64_t began_ = 0, rivalHeard_ = 0, rivalPatience_ = 0, told_ = 0;  // monotonic, ns
    std::int64_t noted_ = 0;
    std::int64_t stoodFrom_ = 0, wentOn_ = 0;  // 0: it did not stand still
    std::int64_t ownPatience_ = 0;             // of others with this start
    Id ownTypes_{}, ownStructure_{};           // once this start has heard itself
    std::string other_;                        // who speaks in this name
    bool isSecond_ = false, ownHeard_ = false;
};

}  // namespace cortex::comms
