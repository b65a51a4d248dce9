// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/event.hpp"
#include "cortex/core/event_memory.hpp"
#include "cortex/core/image.hpp"
#include "cortex/core/program_interface.hpp"
#include "cortex/core/registry.hpp"
#include "cortex/core/simplex_tree.hpp"
#include "cortex/cs/simplex_cs.hpp"
#include "cortex/cs/trigger_source.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cortex::cs {

// Late: what happens to the ticks that a cycle ran over. Each missed one is counted and an event.
enum class Overflow : std::uint8_t {
    Skip,     // next tick on the original grid
    CatchUp,  // at once, at most `catchUpCycles` cycles, then skip
    Halt      // all Active simplexes go to Fault, the loop runs on with safe demands
};

// How the loop of a cluster runs; the defaults fit a loop without real-time rights.
struct ClusterOptions {
    std::uint32_t threads = 1;  // loop thread included
    int priority = 0;           // SCHED_FIFO 1 to 99; 0: none
    // Asked for where priority is; a refusal is reported.
    bool lockMemory = true;
    bool keepCpusAwake = true;  // all of the machine, while the loop runs: costs power
    std::vector<int> cpus{};    // to pin threads to; empty: all that the process may use
    bool acrossCaches = false;  // several threads even where their CPUs have no common cache
    Overflow overflow = Overflow::Skip;
    std::uint32_t catchUpCycles = 10;
    double warnDuty = 0;  // duty cycle in % above which each cycle is an event; 0: none
    // In % of the period: how late a cycle may begin after its deadline. Above, the first of an
    // episode is an event; or all Active simplexes go to Fault, as with Overflow::Halt. 0: none.
    double warnLateness = 50, haltLateness = 0;
    double watchdogPeriods = 10;   // at least 100 ms
    double triggerTimeout = 1;     // s without a tick after which all that is Active faults
    double stopTimeout = 2;        // s after which the shutdown of stop() goes on by force
    bool controlRequired = false;  // commands from outside need a control lease
    bool devices = true;  // false: no thread of a device begins, so what they measure is lost
    std::uint32_t imageReaders = 8;
    // Tells this start from others of its name, UTC microseconds; 0: now. A replay gives that of
    // the start that it repeats.
    std::int64_t epoch = 0;
    // The folder below which simplexes may read and write files, such as taught points; "": they
    // may not.
    std::string files{};
    // What it keeps of the past for tools that ask. Null: 20,000 entries, of this start.
    std::shared_ptr<EventMemory> memory{};
};

// What heartbeat functions get, after each cycle on the loop thread, and from the watchdog.
struct Heartbeat {
    std::int64_t cycle = 0;
    bool alive = true;                    // false: the cycle counter stands still (watchdog thread)
    std::string_view hungPath, hungHook;  // the cluster itself and "the trigger": no tick comes
};

enum class Ended : std::uint8_t { NotStarted, Running, Stopped, Halted, Hung };

// A cluster of simplexes that runs one loop cycle (the paper's ClusterCS): construct, add trees,
// set the trigger, start(). Program's thread throughout; the loop has a thread of its own.
class ClusterCS {
public:
    explicit ClusterCS(std::string name, ClusterOptions options = {});
    ~ClusterCS();  // stop(), then orderly destruction
    ClusterCS(const ClusterCS&) = delete;
    ClusterCS& operator=(const ClusterCS&) = delete;

    void addSimplexTree(SimplexTree& tree);
    void useClasses(const ClassRegistry& registry);  // for related simplexes that rules create

    template <class T, class... Arguments>
    T& setTriggerSource(Arguments&&... arguments) {
        auto source = std::make_unique<T>(std::forward<Arguments>(arguments)...);
        T& reference = *source;
        setTrigger(std::move(source));
        return reference;
    }
    template <class T, class... Arguments>
    T& addInterface(Arguments&&... arguments) {
        auto owned = std::make_unique<T>(std::forward<Arguments>(arguments)...);
        T& reference = *owned;
        adoptInterface(std::move(owned));
        return reference;
    }
    void adoptInterface(std::unique_ptr<CommunicationInterface> interface);
    void addHeartbeat(std::function<void(const Heartbeat&)> function);
    void addEventSink(EventLog::Sink sink, EventLog::Repeats repeats = EventLog::Repeats::Each);
    // Called once in start(), when all simplexes are populated, the interfaces have joined, and
    // nothing runs yet. What it throws ends the start.
    void beforeFirstCycle(std::function<void()> function);

    // Creates related simplexes, validates (throws ModelError with everything), fixes the layout,
    // populates, builds the schedule, announces, starts the loop.
    void start();
    // Shuts all simplexes down level by level (at most `stopTimeout`), safe demands, last write,
    // ends the loop. False: not all got through, notShutDown() names them. If a hook does not
    // return it is named, and the process ends with exit code 3.
    bool stop();
    const std::vector<std::string>& notShutDown() const;  // path and reason; from stop() on

    bool running() const;
    Ended ended() const;
    AgentRuntime& agent();  // from start() on
    Image image();          // the newest; throws Error when too many are held
    // Commands from the program, as from outside.
    std::uint64_t send(std::string_view path, std::string_view command,
                       const ProgramInterface::Arguments& arguments = {});
    CallResult call(std::string_view path, std::string_view command,
                    const ProgramInterface::Arguments& arguments = {},
                    std::chrono::milliseconds timeout = std::chrono::seconds{5});
    ProgramInterface& program();

    // What the system refused of priority, pinning and memory locking, why fewer threads are used
    // than were asked for, and what speaks against how the trigger waits; one sentence each.
    const std::vector<std::string>& realtimeReport() const;
    std::uint32_t threadsInUse() const;

private:
    friend struct ClusterTesting;
    void setTrigger(std::unique_ptr<TriggerSource> source);
    void startAll();

    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

// Blocks until a signal asks for the end, or `seconds` have passed (0: no limit), or `done` returns
// true. The signals are SIGINT, SIGTERM, SIGPIPE and SIGHUP, the last two unless the process
// ignores or handles them. Call blockStopSignals() before start() makes threads. From then on a
// file that may not grow (SIGXFSZ) is an error of who writes it, and ends nobody.
void blockStopSignals();
bool waitForInterrupt(double seconds = 0, const std::function<bool()>& done = {});

// For a program that defines exit() itself, as cortex-agent does: where code of a plug-in calls it,
// standard error says where, all is shut down as after a signal for the end, and the program is to
// end with exit code 3. Before and after that the process ends at once with this code. It returns
// where no plug-in called.
void refuseExit(int code);
bool exitWasRefused();

// What a program does outside of its loop, while the object lives: clusters have such steps for
// what they do, and a program may add its own. Once blockStopSignals() was called, standard error
// names a step that takes longer than a second. After a signal for the end all steps together
// have 1.5 s; then the process ends with exit code 3 and says in which step. Any thread, not in a
// tick.
class BoundedStep {
public:
    enum class Kind : std::uint8_t { Work, Wait };  // a wait may last until the end is asked for
    explicit BoundedStep(std::string what, Kind kind = Kind::Work);
    ~BoundedStep();
    BoundedStep(const BoundedStep&) = delete;
    BoundedStep& operator=(const BoundedStep&) = delete;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace cortex::cs
