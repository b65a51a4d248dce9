// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "commands/lane.hpp"
#include "commands/outside_command.hpp"
#include "commands/port_access.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

namespace cortex {

// Where a command came from and when, so that its last answer finds the way back.
struct Origin {
    Lane* lane = nullptr;
    std::uint64_t number = 0;
    std::uint16_t handle = 0;
    OutsideEntry* outside = nullptr;
    std::int64_t sentCycle = 0, sentTime = 0;
};

// The one long command that a simplex can run at a time, preallocated. Its handler is called once a
// cycle until it returns something other than Running. Used by the task of its simplex.
class Activity {
public:
    Activity(const PortAccess& agent, std::uint32_t simplex, const CommandTable& table);

    bool running() const { return entry_ != nullptr; }
    std::string_view command() const { return entry_->name; }
    const Origin& origin() const { return origin_; }
    const std::byte* response() const {
        return reinterpret_cast<const std::byte*>(response_.get());
    }

    // Calls the handler for the first time; the verdict is Running, or already the last. Like
    // step(), passes on what the handler throws, after answering Failed.
    void start(const CommandTable::Entry& entry, const Handler& handler, const std::byte* request,
               const Origin& origin, Verdict& verdict);
    // Calls it again, or for the last time when the command's time is over.
    void step(const ChunkClock& clock);
    // The last call and the answer Cancelled; without `callHandler` only the answer.
    void cancel(const ChunkClock& clock, bool callHandler, std::string_view why);

    // While an input is lost without which its simplex is safe, only those run whose type says so.
    void loseInput(const ChunkClock& clock, const EventText& why);  // the last call, and Failed
    void regainInput() CORTEX_REALTIME { inputLost_ = {}; }
    bool mayRun(const CommandTable::Entry& entry) const CORTEX_REALTIME {
        return inputLost_.view().empty() || entry.command->onInputLost == OnInputLost::Continue;
    }
    const EventText& inputLost() const { return inputLost_; }

private:
    Verdict call(const CommandTable::Entry& entry, bool first, bool cancelling);
    void finish(const Verdict& verdict, const ChunkClock& clock) CORTEX_REALTIME;
    void stop(const ChunkClock& clock, bool callHandler, const Verdict& verdict);
    std::string_view requesterName() const CORTEX_REALTIME;

    PortAccess agent_;
    const CommandTable::Entry* entry_ = nullptr;
    Handler handler_;
    Origin origin_;
    std::int64_t startedTime_ = 0;  // nominal
    EventText inputLost_;           // empty: none that counts
    std::unique_ptr<std::uint64_t[]> request_, response_;
    Data<std::int64_t> outcome_;  // items of the type Activity, where the simplex has them
    Data<std::string_view> name_, requester_;
    Data<double> progress_;
};

}  // namespace cortex
