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
    // In hooks: an input is bad, lost or older than its rule allows, in this cycle. For one run
    // also what was not followed for so long, or comes over another link than in the run before.
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
    // How far an exchange is: not all of those wanted are Active; they are, but others still run;
    // only they run; one of them is in Fault or refused to start, so those before it go on.
    enum class HandOver : std::uint8_t { Starting, Stopping, Done, Failed };
    // In a hook: the life-cycle commands of a related simplex. Along an output relationship they
    // are taken in the same cycle, along an input or a delayed one in the next. To a simplex of
    // another agent each goes as a command does, once: again only when the last one has ended.
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
        // Of a simplex of another agent: how the last one ended; Running until then. None: none
        // was sent, or the simplex is of this agent.
        const AnswerHead& answer() const;

        // In a hook, in every cycle: exchanges controllers without a gap. `to` starts, and this one
        // is shut down in the cycle after that in which `to` became Active. In one cycle both are,
        // and their shared demands follow the later one. A start that was refused is asked for
        // again after half a second. Throws Error where this simplex does not manage both.
        HandOver handOver(LifeCycleSender& to, const Tick& tick) CORTEX_REALTIME;
        // The same of groups: of `all`, those for which wanted(place) is true start, and the others
        // are shut down once all of those are Active. A group that fails is shut down again where
        // others run. Of a wanted one that another has replaced meanwhile, the start begins anew.
        template <class Wanted>
        static HandOver handOver(std::span<LifeCycleSender> all, const Wanted& wanted,
                                 const Tick& tick) CORTEX_REALTIME {
            for (std::size_t i = 0; i < all.size(); ++i) all[i].wanted_ = wanted(i);
            return exchange(all, tick);
        }
        // What an exchange leaves to the next cycle; for keep() of whoever has this handle.
        void keep(Archive& archive) { archive & askedAt_ & askedIn_ & activeSince_; }

    private:
        friend class SimplexCS;
        static HandOver exchange(std::span<LifeCycleSender> all, const Tick& tick) CORTEX_REALTIME;
        template <class Each>
        static HandOver exchangeEach(const Each& each, const Tick& tick) CORTEX_REALTIME;
        void look(const Tick& tick) CORTEX_REALTIME;
        bool refuses(const Tick& tick) CORTEX_REALTIME;
        bool replaces(const LifeCycleSender& other) const CORTEX_REALTIME;
        void post(LifeCycle command) CORTEX_REALTIME;
        AgentRuntime& bound() const CORTEX_REALTIME;  // throws UnboundHandle
        static constexpr std::int64_t never = -1;
        AgentRuntime* runtime_ = nullptr;
        std::uint32_t target_ = noSimplex;
        bool isDelayed_ = false, isManaged_ = false, wanted_ = false;
        std::int64_t askedAt_ = never;      // ns: for its start, while it is in Standby
        std::int64_t askedIn_ = never;      // cycle of that
        std::int64_t activeSince_ = never;  // cycle in which an exchange saw it Active first
        Data<const std::int64_t> state_;
        struct Remote;
        std::shared_ptr<Remote> remote_;  // null: of this agent
    };
    // In populate(). `manage`: this simplex starts and stops the target from now on; group commands
    // leave it to it. The target must then be one of this agent.
    LifeCycleSender lifeCycle(const RelatedSimplex& target, bool manage = false);

    // Below it files may be read and written (cortex/cs/slow_work.hpp); "": none. From start() on.
    const std::string& filesFolder() const;
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
