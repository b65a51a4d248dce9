// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/archive.hpp"
#include "cortex/core/command.hpp"
#include "cortex/core/event.hpp"
#include "cortex/core/proposed_settings.hpp"
#include "cortex/core/simplex.hpp"
#include "cortex/core/state.hpp"
#include "cortex/core/tick.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace cortex::cs {

class TaskRunner;
class TaskStates;
class TaskInputs;
class TaskDemands;
class TaskValues;
struct TaskBuilder;
class ThreadedSimplex;
class GroupCommands;
struct TaskThread;
class ClusterCS;

// A simplex with a task and a state machine. Derive, get handles in populate(), override the hooks
// you need. Hooks run in the tick, on the loop thread or a worker, one at a time per simplex:
// commands, loopStart, the function of the current state, loopEnd. A hook that throws puts this
// simplex into Fault; until clearFaults none of its hooks runs.
class alignas(64) SimplexCS : public Simplex {
public:
    using Simplex::Simplex;

    // In hooks of this simplex; all other code reads its item `state`.
    State state() const { return state_; }

    // What keep() keeps, between the cycles of a loop that a manual trigger runs. restoreState()
    // throws Error and changes nothing where keep() keeps something else by now.
    std::vector<std::byte> savedState();
    void restoreState(std::span<const std::byte> saved);

protected:
    // In hooks: an input is bad, lost or older than its rule allows, in this cycle.
    bool inputLost() const { return inputLost_; }

    // Once, in start(), after validation: may allocate and throw. Relationships are complete.
    virtual void populate() {}

    virtual void loopStart(const Tick&) CORTEX_REALTIME {}
    virtual void stateStandby(const Tick&) CORTEX_REALTIME {}
    // Done (true) or not yet (false). Not done within the type's transitionTimeout is a fault.
    virtual bool stateStartingUp(const Tick&) CORTEX_REALTIME { return true; }
    virtual void stateActive(const Tick&) CORTEX_REALTIME {}
    virtual bool stateShuttingDown(const Tick&) CORTEX_REALTIME { return true; }
    // Done (true): clearFaults may be accepted from now on.
    virtual bool stateFault(const Tick&) CORTEX_REALTIME { return true; }
    virtual void loopEnd(const Tick&) CORTEX_REALTIME {}

    // A `set` whose values are right one by one: may they stand together? Asked before anything is
    // written, and by start() for the values to begin with; `proposed.refuse("why")` says no.
    virtual void settingsProposed(ProposedSettings&) CORTEX_REALTIME {}
    // The items have the new values, before the other hooks of this cycle.
    virtual void settingsChanged() CORTEX_REALTIME {}

    // Hands over each member that one cycle leaves to the next and that is no item, in a fixed
    // order; one function to save and to restore: `archive & integral_ & last_`.
    virtual void keep(Archive&) CORTEX_REALTIME {}

    // In a hook: enter Fault when this task ends. The first fault of a cycle is kept. `code` is
    // above 0. Throws Error before the first tick, and for other codes, which are the framework's.
    void fault(std::int64_t code, std::string_view text) CORTEX_REALTIME;
    // In a hook: own quality and that of the outputs in this cycle, instead of what follows from
    // the inputs; `measuredAt`: nominal time of the measurement, below 0 before the start.
    void setQuality(Quality quality, std::int64_t measuredAt = thisCycle) CORTEX_REALTIME;
    static constexpr std::int64_t thisCycle = std::numeric_limits<std::int64_t>::min();
    // In a hook: an event of this simplex.
    void event(Severity severity, const EventText& text) CORTEX_REALTIME;
    // In a hook: the life-cycle commands of a related simplex. Along an output relationship they
    // are taken in the same cycle, along an input or a delayed one in the next. To a simplex of
    // another agent each goes as a command does, once: again only when the last was answered.
    class LifeCycleSender {
    public:
        LifeCycleSender() = default;
        ~LifeCycleSender() = default;
        LifeCycleSender(const LifeCycleSender&) = default;
        LifeCycleSender(LifeCycleSender&&) noexcept = default;
        LifeCycleSender& operator=(LifeCycleSender&&) noexcept = default;
        LifeCycleSender& operator=(const LifeCycleSender& other) {  // commands the same simplex
            return *this = LifeCycleSender{other};
        }
        void startup() CORTEX_REALTIME { post(LifeCycle::Startup); }
        void shutdown() CORTEX_REALTIME { post(LifeCycle::Shutdown); }
        void clearFaults() CORTEX_REALTIME { post(LifeCycle::ClearFaults); }
        State state() const CORTEX_REALTIME;  // as last seen: its data item `state`
        // Of a simplex of another agent: how the last one ended. None: none was, or of this agent.
        const AnswerHead& answer() const;

    private:
        friend class SimplexCS;
        void post(LifeCycle command) CORTEX_REALTIME;
        AgentRuntime& bound() const CORTEX_REALTIME;  // throws UnboundHandle
        AgentRuntime* runtime_ = nullptr;
        std::uint32_t target_ = noSimplex;
        bool isDelayed_ = false;
        Data<const std::int64_t> state_;
        struct Remote;
        std::shared_ptr<Remote> remote_;  // null: of this agent
    };
    // In populate(). `manage`: this simplex starts and stops the target from now on; group commands
    // leave it to it. The target must then be one of this agent.
    LifeCycleSender lifeCycle(const RelatedSimplex& target, bool manage = false);

    // In populate(): on<&Jog::zero>("zero"), with `Outcome zero(Call& call)`.
    template <auto Method>
    void on(std::string_view command) {
        handle(command, {static_cast<SimplexCS*>(this),
                         [](void* self, Call& call) { return invoke(Method, self, call); }});
    }

private:
    friend class TaskRunner;
    friend class TaskStates;
    friend class TaskInputs;
    friend class TaskDemands;
    friend class ThreadedSimplex;
    friend class TaskValues;
    friend struct TaskBuilder;
    friend class GroupCommands;
    friend class ClusterCS;

    template <class Self>
    static Outcome invoke(Outcome (Self::*method)(Call&), void* self, Call& call) {
        return (static_cast<Self*>(static_cast<SimplexCS*>(self))->*method)(call);
    }

    // `brief`: for the item faultText, where the text may be too long for it.
    void enterFault(std::int64_t code, std::string_view text, std::string_view brief = {})
        CORTEX_REALTIME;

    // With the head of the object this is most of a cache line; what derives from it goes on there.
    std::uint32_t manager_ = noSimplex;  // starts and stops it instead of group commands
    State state_ = State::Standby;
    bool dead_ = false;  // a hook threw: no hooks until clearFaults
    bool inputLost_ = false;
    bool safeByLoss_ = false;  // an onLoss="safe" input is lost: safe demands stand
    // What a task has to look at before its next hooks or at its end. In most cycles it is nothing.
    struct Pending {
        bool fault = false;
        bool done = false;           // the transitional state's function has returned true
        bool demandRefused = false;  // by an arbiter, in the cycle before
        bool quality = false;        // was set by a hook, in this cycle
        bool any() const { return std::bit_cast<std::uint32_t>(*this) != 0; }
    };
    Pending pending_;
    Quality quality_ = Quality::Good;
    TaskThread* thread_ = nullptr;
};

}  // namespace cortex::cs
