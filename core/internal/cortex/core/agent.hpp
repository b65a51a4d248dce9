// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/event.hpp"
#include "cortex/core/image_pool.hpp"
#include "cortex/core/loop_pace.hpp"
#include "cortex/core/loop_thread.hpp"
#include "cortex/core/mailbox.hpp"
#include "cortex/core/proposed_settings.hpp"
#include "cortex/core/simplex_tree.hpp"
#include "cortex/core/standstill.hpp"
#include "cortex/core/tables.hpp"
#include "cortex/core/tick.hpp"
#include "cortex/core/transport.hpp"
#include "cortex/core/validation.hpp"

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cortex {

class Router;
class LinkTable;
class CommandPort;
class Lane;
class LaneBlock;

struct AgentOptions {
    std::uint32_t imageReaders = 8;
    std::uint32_t imageKeepers = 0;       // interfaces that keep images of their own
    std::uint32_t loopThreads = 1;        // threads that post events: workers and the loop
    std::uint32_t eventCapacity = 4096;   // per loop thread
    std::uint32_t outsideCommands = 256;  // on their way at once, of all senders
    bool controlRequired = false;         // commands from outside need a lease
    std::int64_t period = 1'000'000;      // ns, nominal
    std::int64_t epoch = 0;               // of this start, UTC microseconds; 0: now
    bool realTime = false;                // false: stepped, so that only nominal time counts
    bool devices = true;                  // false: their threads do not run
    Extent extent = Extent::Whole;
    std::string files{};                    // folder of what simplexes read and write; "": none
    std::shared_ptr<EventMemory> memory{};  // of the past; null: one of the usual size
};

// One agent at run time: structure, tables, mailboxes, images, events and the two ends of a cycle.
// ClusterCS wraps its schedule in beginCycle() and endCycle(); a gateway of descriptive simplexes
// calls them itself. start() and stop() on the program's thread, cycles on the loop thread.
class AgentRuntime {
public:
    // Creates related simplexes, validates and fixes the layout. Throws ModelError with everything.
    // The tree must hold a simplex `/<name>` of type Agent or a child; it is added if missing.
    AgentRuntime(std::string name, SimplexTree& tree, AgentOptions options);
    ~AgentRuntime();
    AgentRuntime(const AgentRuntime&) = delete;
    AgentRuntime& operator=(const AgentRuntime&) = delete;

    void addInterface(CommunicationInterface& interface);  // before start(); order is precedence

    // Canonical order decides command merging and events; without it, path order. Before start().
    void setCanonicalOrder(std::span<const std::uint32_t> order);
    void start();  // after populate(): sizes lanes, announces to the interfaces, first image
    void stop();   // last write(), closes interfaces, hands out the last events

    // Latches, read, deliver; then the commands of simplexes without a task. The cycle is another
    // one each time: what is delayed is seen in the next.
    void beginCycle(const Tick& tick) CORTEX_REALTIME;
    // Image, write. `wallClock`: UTC ns of the tick's nominal time.
    void endCycle(const Tick& tick, std::int64_t wallClock) CORTEX_REALTIME;

    bool started() const { return started_; }  // from start() on, also after stop()
    const std::string& name() const { return name_; }
    const AgentOptions& options() const { return options_; }
    // Of the present or last cycle. For the loop's threads only; all others ask an image.
    std::int64_t cycle() const { return present_.cycle; }
    std::int64_t nominalTime() const { return present_.nominalTime; }
    std::int64_t wokenAt() const { return present_.nominalTime + lateness_; }
    SimplexTree& tree() { return tree_; }
    const Report& warnings() const { return report_; }  // what validation found; no errors
    const Structure& structure() const { return *structure_; }
    Tables& tables() { return *tables_; }
    ImagePool& images() { return *images_; }
    EventLog& events() { return *events_; }
    EventMemory& memory() { return *options_.memory; }
    StandstillNote& standstill() { return standstill_; }
    LoopPace& pace() { return pace_; }
    LoopThread& thread(std::uint32_t worker) { return threads_[worker]; }
    std::uint32_t threadCount() const { return static_cast<std::uint32_t>(threads_.size()); }
    Simplex& simplex(std::uint32_t index) { return *simplexes_[index]; }
    std::uint32_t rank(std::uint32_t simplex) const { return present_.ranks[simplex]; }
    std::uint32_t agentSimplex() const { return agentSimplex_; }  // index of `/<name>`
    // Of a simplex of another agent: ns between two writings by its owner, at least our period;
    // known when it is linked, from beginCycle() on.
    const std::int64_t& ownerPeriod(std::uint32_t simplex) const {
        return ownerPeriods_[simplex - firstRemote_];
    }
    // How often the link to it was lost. Another start of its agent is another link.
    const std::uint32_t& linkLosses(std::uint32_t simplex) const {
        return linkLosses_[simplex - firstRemote_];
    }
    // A simplex of another agent that has not been there since the start; one whose agent was
    // heard, whether or not a value of it has come.
    bool neverLinked(std::uint32_t simplex) const CORTEX_REALTIME {
        return isRemote(simplex) && !everLinked_[simplex - firstRemote_];
    }
    // One that is linked now and of which a value has come, of whatever quality. Any thread.
    bool isLinked(std::uint32_t simplex) const CORTEX_REALTIME {
        return isRemote(simplex) && linked_[simplex - firstRemote_].load(std::memory_order_relaxed);
    }
    bool everOffered(std::uint32_t simplex) const CORTEX_REALTIME {
        return isRemote(simplex) && everOffered_[simplex - firstRemote_];
    }

    // Step (1) of a task: answers to what it sent, commands of its lanes in canonical order, then
    // from outside, then its long command. What a handler throws passes through. `dead`: a hook of
    // it threw, so that no handler runs.
    void processCommands(std::uint32_t simplex, State state, LoopThread& thread, bool dead = false)
        CORTEX_REALTIME;
    // Whether step (1) has anything to do: a pending life-cycle word, and processCommands().
    std::uint8_t calls(std::uint32_t simplex) const CORTEX_REALTIME {
        return calls_[simplex].load(std::memory_order_relaxed);
    }
    static bool hasLifeCycle(std::uint8_t calls) CORTEX_REALTIME {
        return (calls & ~commandWork) != 0;
    }
    static bool hasCommandWork(std::uint8_t calls) CORTEX_REALTIME {
        return (calls & commandWork) != 0;
    }
    // On leaving Active and in Fault: the last call of a long command, then the answer Cancelled.
    // Without `callHandler` (a hook threw) only the answer. False: the handler threw; nothing
    // passes through.
    bool cancelActivity(std::uint32_t simplex, LoopThread& thread, bool callHandler = true,
                        std::string_view why = "its simplex left Active") CORTEX_REALTIME;
    // An input is lost without which its demands are safe, or all of them are back: long commands
    // fail meanwhile, unless their type says otherwise. It throws what a handler throws.
    void loseInput(std::uint32_t simplex, LoopThread& thread, const EventText& why) CORTEX_REALTIME;
    void regainInput(std::uint32_t simplex) CORTEX_REALTIME;

    // The pending life-cycle word: taken in step (1); `shutdown` outranks the others.
    LifeCycle takeLifeCycle(std::uint32_t simplex, LoopThread& thread) CORTEX_REALTIME;
    // `later`: from the next cycle on (delayed relationships, and anything on the loop thread after
    // the simplex ran).
    void postLifeCycle(std::uint32_t simplex, LifeCycle command, bool later) CORTEX_REALTIME;

    // What a task may say when it does not follow a life-cycle command; goes to who sent it from
    // outside.
    void refuseLifeCycle(std::uint32_t simplex, LifeCycle command, const EventText& why,
                         LoopThread& thread) CORTEX_REALTIME;

    void post(LoopThread& thread, Severity severity, EventKind kind, std::uint32_t simplex,
              const EventText& text) CORTEX_REALTIME {
        present_.post(thread, severity, kind, simplex, text);
    }

    // From now on data() gives nobody a handle to write: the loop runs by a clock of its own.
    void refuseWriters() { writersRefused_ = true; }
    bool writersRefused() const { return writersRefused_; }

    // Setup, for Simplex and its handles.
    void registerHandler(std::uint32_t simplex, std::string_view command, Handler handler);
    void registerSettingsHooks(std::uint32_t simplex, const SettingsHooks& hooks);
    // What `set` may change; none where the type has no such item.
    std::span<const SettableItem> settables(std::uint32_t simplex) const;
    CommandSender makeSender(std::uint32_t edge, std::string_view command, std::uint32_t capacity);
    const CommandTable& commands(std::uint32_t simplex) const { return *tableOf_[simplex]; }
    // After populate(): a handler for each command of its type, and what it sends is complete.
    void checkCommands(std::uint32_t simplex, Report& report) const;

private:
    friend class Router;
    friend class LinkTable;

    void keepEvents();
    void addAgentSimplex();
    void checkModel();
    void bindSimplexes();
    CommandPort& portOf(std::uint32_t simplex);
    bool isRemote(std::uint32_t simplex) const CORTEX_REALTIME {
        return simplex >= firstRemote_ && simplex - firstRemote_ < everLinked_.size();
    }
    void makeLanes();
    std::uint32_t callsToAgents() const;
    void findTaskless();
    void releaseLifeCycles() CORTEX_REALTIME;
    void processTaskless() CORTEX_REALTIME;

    std::string name_;
    SimplexTree& tree_;
    AgentOptions options_;
    Report report_;
    std::shared_ptr<Structure> structure_;
    std::unique_ptr<Tables> tables_;
    std::unique_ptr<ImagePool> images_;
    std::unique_ptr<EventLog> events_;
    StandstillNote standstill_;
    LoopPace pace_;
    std::unique_ptr<Router> router_;
    std::vector<Simplex*> simplexes_;
    std::vector<std::unique_ptr<CommandTable>> commandTables_;  // per type layout
    std::vector<const CommandTable*> tableOf_;                  // per simplex
    std::vector<std::unique_ptr<CommandPort>> ports_;           // per simplex that has commands
    std::unique_ptr<LaneBlock> lanes_;
    std::vector<Lane*> toAgents_;  // that lead to simplexes of other agents
    std::vector<std::shared_ptr<CommandSender::State>> senders_;
    std::vector<std::uint32_t> taskless_;  // that lanes lead to, and the agent's own simplex
    std::vector<CommunicationInterface*> interfaces_;
    std::vector<LoopThread> threads_;
    PresentCycle present_;
    std::vector<std::int64_t> ownerPeriods_;       // of remote simplexes, which are the last
    std::vector<std::uint32_t> linkLosses_;        // the same
    std::vector<bool> everOffered_, everLinked_;   // the same
    std::unique_ptr<std::atomic<bool>[]> linked_;  // the same
    std::uint32_t firstRemote_ = 0;
    // Per simplex, bits: pending life-cycle commands, and whether its port has work.
    std::unique_ptr<std::atomic<std::uint8_t>[]> calls_, callsLater_;
    std::atomic<bool> anyLater_{false};
    std::uint32_t agentSimplex_ = noSimplex;
    std::int64_t lateness_ = 0;
    bool started_ = false, stopped_ = false;
    bool writersRefused_ = false;
};

}  // namespace cortex
