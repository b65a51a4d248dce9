// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"
#include "cortex/core/transport.hpp"

#include "agent/agent_calls.hpp"
#include "agent/answer_queue.hpp"
#include "agent/lease.hpp"
#include "agent/link_table.hpp"
#include "agent/long_ends.hpp"
#include "agent/sender_table.hpp"
#include "commands/outside_command.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace cortex {

// What interfaces read into: numbers, windows, expiry, control and repeats of commands from
// outside, and links. Everything is sized at start(). Loop thread, in beginCycle() and endCycle();
// only refuseLifeCycle() is called by tasks.
class Router final : public Inbox {
public:
    // The lanes that lead to other agents.
    Router(AgentRuntime& runtime, std::span<Lane* const> toAgents);

    void read(std::span<CommunicationInterface* const> interfaces) CORTEX_REALTIME;
    // Simplexes without a task that got a command in this cycle.
    std::span<const std::uint32_t> tasklessReceivers() const { return taskless_; }
    void collect() CORTEX_REALTIME;  // answers given in this cycle
    void write(std::span<CommunicationInterface* const> interfaces) CORTEX_REALTIME;
    void stop();  // answers what is still on its way
    void refuseLifeCycle(std::uint32_t simplex, LifeCycle command, const EventText& why,
                         LoopThread& thread) CORTEX_REALTIME;

    std::int64_t cycle() const override { return runtime_.cycle(); }
    void linkOffered(std::uint32_t simplex) override { links_.offered(simplex); }
    void link(std::uint32_t simplex, const LinkBinding& binding, const Slice& from,
              std::int64_t age) override {
        links_.link(simplex, binding, from, age, interface_);
    }
    void linkConstants(std::uint32_t simplex, const LinkBinding& binding,
                       const Slice& from) override {
        links_.constants(simplex, binding, from);
    }
    void linkLost(std::uint32_t simplex) override { links_.lost(simplex); }
    void command(const OutsideCommand& command) override;
    void answer(const AgentCallAnswer& answer) override { calls_.answer(answer); }
    void senderLost(const Sender& sender) override;
    void event(Severity severity, EventKind kind, std::uint32_t simplex,
               const EventText& text) override {
        runtime_.post(runtime_.thread(0), severity, kind, simplex, text);
    }

private:
    using Stage = KeptOutcome::Stage;

    // router.cpp: on their way in and out.
    bool findSender(const OutsideCommand& command, std::uint32_t& record);
    void repeatAcknowledged(const OutsideCommand& command, SenderRecord& sender);
    void tellEnd(const OutsideCommand& command);
    void judge(const OutsideCommand& command, const SenderRecord& sender, Verdict& verdict) const;
    OutsideEntry& admit(const OutsideCommand& command, std::uint32_t record);
    void repeat(const KeptOutcome& kept, const OutsideCommand& command);
    void refuse(const OutsideCommand& command, const Verdict& verdict);
    void deliver();
    void publish(OutsideEntry& entry);
    void release(OutsideEntry& entry);
    void answer(std::uint32_t interface, const OutsideAnswer& answer);

    // router_report.cpp: the event that says what became of one.
    OutsideCommand messageOf(const OutsideEntry& entry) const;
    EventKind kindOf(const OutsideCommand& command, bool executed) const;
    void report(const OutsideCommand& command, const AnswerHead& answer);

    // router_order.cpp: when they go on their way.
    bool isUrgent(std::uint32_t simplex, std::uint32_t command) const;
    bool hasRoom(const OutsideCommand& command) const;
    bool isTooMuch(const OutsideCommand& command, const SenderRecord& sender) const;
    void acknowledge(SenderRecord& sender, std::uint64_t below);
    void wait(const OutsideCommand& command, std::uint32_t record);
    std::int64_t patienceWith(const OutsideCommand& command) const;
    void deliverWaiting();
    void deliverWaitingOf(SenderRecord& sender);
    void refuseWaiting(SenderRecord& sender, Outcome outcome, std::string_view why);
    void judgeTurn(const OutsideEntry& entry, const SenderRecord& sender, Verdict& verdict) const;
    void begin(OutsideEntry& entry, SenderRecord& sender);
    bool isOvertaken(const OutsideEntry& entry, const SenderRecord& sender) const;
    bool actsFirst(const OutsideEntry& entry) const;
    bool wouldOvertake(const OutsideEntry& entry, const OutsideEntry& earlier) const;
    bool mustLetGo(const OutsideEntry& entry) const;
    void withdrawEarlier(const OutsideEntry& entry);
    bool concernEachOther(std::uint32_t simplex, std::uint32_t other) const;

    // router_control.cpp: who may, and life-cycle commands.
    void authorise(const OutsideEntry& entry, Verdict& verdict) const;
    void setControlHandlers();
    bool isRenewal(std::uint32_t simplex, std::uint32_t command) const;
    bool isControl(std::uint32_t simplex, std::uint32_t command) const;
    template <Outcome (Router::*Method)(Call&)>
    void setControlHandler(std::string_view command);
    std::string_view argument(Call& call, std::string_view command, std::string_view name) const;
    Outcome takeControl(Call& call);
    Outcome renewControl(Call& call);
    Outcome handOverControl(Call& call);
    Outcome releaseControl(Call& call);
    void controlLost(const Lease& lease, std::string_view how);
    void findStates();
    State stateOf(std::uint32_t simplex) const { return static_cast<State>(*states_[simplex]); }
    bool isLifeCycle(const OutsideEntry& entry) const {
        return isLifeCycle(entry.simplex, entry.command);
    }
    bool isLifeCycle(std::uint32_t simplex, std::uint32_t command) const;
    void deliverLifeCycle(OutsideEntry& entry);
    void watch(OutsideEntry& entry);

    AgentRuntime& runtime_;
    const Structure& structure_;
    std::uint32_t interface_ = 0;  // that is being read
    std::int64_t longestBudget_;   // cycles
    std::int64_t longestWait_;     // cycles for what is missing
    std::size_t waiting_ = 0;      // for what is missing, about
    bool takesControl_ = false;    // a command about control goes to its queue in this cycle
    ChunkClock began_;             // the loop thread's clock when the cycle began
    std::size_t keptForUrgent_;    // of the pool: what stops something finds a place
    std::vector<OutsideEntry> pool_;
    std::vector<std::byte> records_;
    std::vector<OutsideEntry*> free_, arrivals_, active_;
    std::vector<std::uint32_t> taskless_, waits_;  // simplexes; records of senders
    std::vector<const std::int64_t*> states_;      // the item `state` of each simplex, or null
    std::uint32_t renewal_ = CommandTable::none;   // the agent's command renewControl
    std::vector<std::uint32_t> leaseMinded_;       // simplexes whose type minds losing control
    std::vector<AnswerQueue> answers_;             // by interface
    LongEnds ends_;
    SenderTable senders_;
    LeaseTable leases_;
    LinkTable links_;
    AgentCalls calls_;
};

}  // namespace cortex
