// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/loop_thread.hpp"
#include "cortex/core/proposed_settings.hpp"

#include "commands/activity.hpp"
#include "commands/lane.hpp"
#include "commands/outside_command.hpp"
#include "commands/port_access.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace cortex {

// "zero needs Standby or Active, is Fault"
EventText stateRefusal(std::string_view what, StateSet needs, State state) CORTEX_REALTIME;

// Both ends of the commands of one simplex: lanes that it receives from in canonical order of
// senders, the queue from outside, handlers, its long command, and the lanes that it sends on.
// Set up in populate() and start(); afterwards its task's, and between cycles the loop thread's.
class alignas(64) CommandPort {
public:
    CommandPort(const PortAccess& agent, std::uint32_t simplex, const CommandTable& table);

    void setHandler(std::uint32_t command, Handler handler) {
        handlers_[command] = handler;
        recentCommand_ = CommandTable::none;
    }
    bool handles(std::uint32_t command) const { return handlers_[command].function != nullptr; }
    // Setup: who judges values that are right one by one.
    void setHooks(const SettingsHooks& hooks) { settingsHooks_ = hooks; }
    std::span<const SettableItem> settables() const { return settables_; }
    // Setup: the lanes on which this simplex receives and sends, in canonical order.
    void addReceiving(Lane& lane);
    void addSending(Lane& lane);

    const CommandTable& table() const { return table_; }
    bool hasLanes() const { return receiving_ != nullptr; }
    // Executes what has arrived; the task calls it before its hooks. What a handler throws passes
    // through, after its command was answered Failed. `dead`: commands are refused.
    void process(State state, LoopThread& thread, bool dead) CORTEX_REALTIME;
    // Ends the long command, if there is one. False: the handler threw on its last call.
    bool cancelActivity(LoopThread& thread, bool callHandler, std::string_view why);
    // An input is lost without which demands are safe, or all of them are back: long commands fail
    // and are refused meanwhile, unless their type says otherwise. It throws what a handler throws.
    void loseInput(LoopThread& thread, const EventText& why) CORTEX_REALTIME;
    void regainInput() CORTEX_REALTIME;
    // Between cycles: a command from outside is executed in the next process().
    void enqueue(OutsideEntry& entry) CORTEX_REALTIME;
    // Between cycles: the long command is cancelled in the next process().
    void requestCancel(const char* why) CORTEX_REALTIME { cancelWhy_ = why; }
    // Null: no long command is running, or it came along a lane.
    const OutsideEntry* activityOrigin() const CORTEX_REALTIME;

    LoopThread& thread() { return *thread_; }
    // What send() returns where the lane has no room; it is counted and told once.
    Outcome notSent(CommandSender::State& state, Outcome outcome, std::string_view why)
        CORTEX_REALTIME;

private:
    void callFor(bool work) CORTEX_REALTIME;  // sets or clears the simplex's bit
    bool hasPassingWork() const CORTEX_REALTIME;
    void processAll();
    void beginLanes() CORTEX_REALTIME;
    const Handler& handlerOf(std::uint32_t command) CORTEX_REALTIME {
        if (command != recentCommand_) {
            recentCommand_ = command;
            recent_ = handlers_[command];
        }
        return recent_;
    }
    void drain(Lane& lane);
    bool takeOnFastPath(Lane& lane);
    void take(Lane& lane);
    void drainOutside();
    void stepActivity();
    // `outside`: where it came from; null: along a lane.
    void execute(std::uint32_t command, const std::byte* request, std::byte* response, Lane* lane,
                 OutsideEntry* outside, Verdict& verdict);
    bool accepted(const CommandTable::Entry& entry, const std::byte* request, Verdict& verdict);
    void startActivity(std::uint32_t command, const std::byte* request, std::byte* response,
                       const Origin& origin, Verdict& verdict);
    void cancel(Verdict& verdict);
    void set(const std::byte* request, Verdict& verdict);
    bool agreed(const std::byte* request, Verdict& verdict) const;
    void answer(Lane& lane, LaneSlot& head, const Verdict& verdict);
    void count(const Verdict& verdict, std::int64_t latency) CORTEX_REALTIME;
    void countExecuted(std::int64_t latency) CORTEX_REALTIME {
        ++thread_->commands;
        thread_->lastLatency = latency;
        ++thread_->latencyCounts[latencyBucket(latency)];
    }
    bool settable(const SettableItem& target, const std::byte* request, Verdict& verdict) const;

    // What every command touches: one cache line. Where there is no more than the first lanes,
    // nothing is written to it that has not changed.
    LoopThread* thread_ = nullptr;
    const CommandTable& table_;
    Lane* receiving_ = nullptr;  // the first, usually the only one
    Lane* sending_ = nullptr;
    Handler recent_;  // of the command that came last
    std::uint32_t recentCommand_ = CommandTable::none;
    State state_ = State::Standby;
    bool stateless_;           // a descriptive simplex: always settable
    bool dead_ = false;        // a hook threw: no handler may run
    bool more_ = false;        // than the first lanes: others, from outside, a long command
    bool startedNow_ = false;  // the activity had its call of this step

    OutsideEntry* outside_ = nullptr;
    std::unique_ptr<Activity> activity_;
    std::unique_ptr<Handler[]> handlers_;  // by command
    std::vector<Lane*> moreReceiving_, moreSending_;
    const char* cancelWhy_ = nullptr;
    std::vector<SettableItem> settables_;
    SettingsHooks settingsHooks_;
    PortAccess agent_;
    std::uint32_t simplex_;
};

}  // namespace cortex
