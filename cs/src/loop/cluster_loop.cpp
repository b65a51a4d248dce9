// SPDX-License-Identifier: Apache-2.0
#include "loop/cluster_loop.hpp"

#include "cortex/core/clock.hpp"
#include "cortex/core/service_threads.hpp"

#include "loop/running_time.hpp"
#include "tasks/crash_report.hpp"
#include "threads/realtime_thread.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace cortex::cs {

namespace {

using namespace std::chrono_literals;

std::int64_t wallClockNow() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

}  // namespace

ClusterLoop::ClusterLoop(AgentRuntime& agent, TriggerSource& trigger, const ClusterOptions& options,
                         Schedule schedule, StartOrder startOrder,
                         std::vector<std::function<void(const Heartbeat&)>> heartbeats,
                         std::vector<std::string> realtimeReport)
    : agent_{agent},
      trigger_{trigger},
      options_{options},
      heartbeats_{std::move(heartbeats)},
      realtimeReport_{std::move(realtimeReport)},
      plan_{std::make_unique<Plan>(Plan{std::move(schedule), nullptr})},
      runner_{agent, plan_->schedule, trigger.period()},
      group_{agent, runner_.states(), std::move(startOrder)},
      metrics_{agent, trigger.period(), plan_->schedule.threads},
      pace_{trigger.period()},
      late_{trigger.period(), options.warnLateness, "warnLateness"},
      tooLate_{trigger.period(), options.haltLateness, "haltLateness"} {
    agent_.registerHandler(agent_.agentSimplex(), "reschedule",
                           {this, [](void* self, Call& call) {
                                return static_cast<ClusterLoop*>(self)->reschedule(call);
                            }});
}

ClusterLoop::~ClusterLoop() { stop(); }

void ClusterLoop::start() {
    const auto limit = std::max<std::chrono::nanoseconds>(
        100ms, std::chrono::nanoseconds{static_cast<std::int64_t>(
                   options_.watchdogPeriods * static_cast<double>(trigger_.period()))});
    {
        const ServiceThreads named{"cortex-watchdog"};
        const std::chrono::nanoseconds timeout{
            static_cast<std::int64_t>(options_.triggerTimeout * 1e9)};
        watchdog_ = std::make_unique<Watchdog>(
            WatchdogLimits{limit, trigger_.realTime() ? std::max(timeout, limit) : 0ns},
            [this](Watchdog::Finding finding, const Tick& tick, std::int64_t since) {
                tell(finding, tick, since);
            });
    }
    startRescheduler();
    ended_.store(Ended::Running, std::memory_order_release);
    thread_ = std::thread{[this] { run(); }};
    ready_.wait(false);
    if (failure_) {
        thread_.join();
        rescheduler_.reset();
        watchdog_.reset();
        ended_.store(Ended::NotStarted, std::memory_order_release);
        std::rethrow_exception(failure_);
    }
    for (const std::string& refusal : realtimeReport_) {
        Event event;
        event.severity = Severity::Warning;
        event.simplex = agent_.agentSimplex();
        event.text = EventText{refusal};
        agent_.events().postOutside(event);
    }
}

void ClusterLoop::run() {
    loopThread_.store(pthread_self());
    try {
        prepareThread();
        trigger_.skipMissed(options_.overflow != Overflow::CatchUp);
        trigger_.start();
        for (std::string& line : trigger_.report()) realtimeReport_.push_back(std::move(line));
    } catch (...) {
        failure_ = std::current_exception();
        plan_->pool.reset();
        awakeCpus_.reset();
    }
    const bool failed = failure_ != nullptr;
    ready_.store(true);
    ready_.notify_all();
    if (failed) return;
    try {
        loop();
    } catch (const std::exception& error) {
        reportFailure("the trigger", error.what());
    }
    shutDown();
    rescheduler_.reset();
    plan_->pool.reset();
    awakeCpus_.reset();
    if (ended() == Ended::Running) ended_.store(Ended::Stopped, std::memory_order_release);
    finished_.store(true, std::memory_order_release);
}

void ClusterLoop::loop() {
    lastNominal_ = -trigger_.period();
    for (;;) {
        const Trigger trigger = trigger_.waitForTick();
        if (trigger.stopped) return;
        last_ = trigger;
        if (trigger.timedOut && timedOutAfter_.load(std::memory_order_acquire) == cycle_) {
            runner_.states().halt(TriggerStopped, "no tick came within the trigger's timeout");
        }
        cycle(trigger);
        checkOverflow();
    }
}

// What code of the user's threw outside of any simplex.
void ClusterLoop::reportFailure(const char* source, const char* what) {
    Event event;
    event.cycle = cycle_;
    event.time = lastNominal_;
    event.simplex = agent_.agentSimplex();
    event.severity = Severity::Error;
    event.text << source << " threw: " << what;
    agent_.events().postOutside(event);
}

void ClusterLoop::beat(const Heartbeat& heartbeat) {
    for (const auto& function : heartbeats_) {
        try {
            function(heartbeat);
        } catch (const std::exception& error) {
            reportFailure("a heartbeat function", error.what());
        }
    }
}

void ClusterLoop::cycle(const Trigger& trigger) {
    const std::int64_t begin = monotonicNow();
    setFloatingPointMode();
    if (trigger.periods - 1 > counted_) countMissed(trigger.periods - 1 - counted_);
    counted_ = trigger.periods > 1 ? 0 : std::max<std::int64_t>(counted_ - 1, 0);
    const std::int64_t passed = trigger.nominalTime - lastNominal_;
    const Tick tick{++cycle_, trigger.nominalTime, passed,
                    std::min(passed, Tick::mostPeriods * trigger_.period()), trigger.lateness};
    lastNominal_ = trigger.nominalTime;
    watchdog_->cycleBegins(tick);
    agent_.beginCycle(tick);
    reportMissed();
    warnDuty();
    judgePace(tick, begin);
    judgeLateness(tick);
    if (rescheduler_) adoptPlan();
    const std::int64_t next = trigger_.nextDeadline();
    runner_.beginCycle(tick, next);
    plan_->pool->cycle(next);
    const RunnerCounts counts = runner_.counts();
    if (watchdog_->reported() == tick.cycle - 1) metrics_.hung(true);
    metrics_.write(counts, tick);
    if (mayReschedule_) rescheduler_->follow(counts.startups, tick.nominalTime, runner_.timedAll());
    agent_.endCycle(tick, wallClockNow() - (monotonicNow() - begin) - trigger.lateness);
    metrics_.cycleEnded(lastWakeUp_ == 0 ? 0 : begin - lastWakeUp_, trigger.lateness,
                        monotonicNow() - begin);
    lastWakeUp_ = begin;
    metrics_.hung(watchdog_->reported() == tick.cycle);
    if (!heartbeats_.empty()) beat({tick.cycle, true, {}, {}});
    watchdog_->cycleEnds();
}

// On the program's thread, so that its own has neither the loop's priority nor its CPU.
void ClusterLoop::startRescheduler() {
    if (agent_.threadCount() < 2 || !makeSchedule_) return;
    mayReschedule_ = !test_.forceThreads;
    const ServiceThreads named{"cortex-schedule"};
    rescheduler_ = std::make_unique<Rescheduler>(
        agent_, plan_->schedule, Rescheduler::Maker{makeSchedule_, [this](Schedule schedule) {
                                                        return makePlan(std::move(schedule));
                                                    }});
}

// For a loop that runs.
std::unique_ptr<Plan> ClusterLoop::makePlan(Schedule schedule) {
    auto plan = std::make_unique<Plan>(Plan{std::move(schedule), nullptr});
    addThreads(*plan);
    plan->pool->placeLoopThread(loopThread_.load());
    return plan;
}

bool ClusterLoop::offerPlan(Schedule schedule) {
    if (rescheduler_ == nullptr || rescheduler_->isLooking()) return false;
    return rescheduler_->offer(makePlan(std::move(schedule)));
}

// A command of /<cluster>. A look takes half a second and would keep all others out, so that it is
// answered at once.
Outcome ClusterLoop::reschedule(Call& call) {
    if (!mayReschedule_) {
        return call.fail("it has one thread, or keeps those given: there is nothing to share anew");
    }
    rescheduler_->lookAndTell();
    return Outcome::Done;
}

void ClusterLoop::adoptPlan() {
    if (!rescheduler_->exchange(plan_)) return;
    runner_.use(plan_->schedule);
    metrics_.threads(plan_->pool->threads());
    metrics_.cpus(plan_->cpus);
    threads_.store(plan_->pool->threads(), std::memory_order_relaxed);
}

// About the cycle before: its own events have been handed out.
void ClusterLoop::warnDuty() {
    if (options_.warnDuty <= 0 || metrics_.lastDuty() <= options_.warnDuty) return;
    EventText text{"duty cycle "};
    text << metrics_.lastDuty() << " % is above " << options_.warnDuty << " %";
    tell(Severity::Warning, text);
}

void ClusterLoop::judgeLateness(const Tick& tick) {
    const LatenessJudge::Change change = late_.add(tick);
    if (change == LatenessJudge::Change::Begins) tell(Severity::Warning, late_.beginning());
    if (change == LatenessJudge::Change::Ends) tell(Severity::Info, late_.ending());
    const bool begins = tooLate_.add(tick) == LatenessJudge::Change::Begins;
    if (begins) tell(Severity::Error, tooLate_.beginning());
    if (tooLate_.isAbove(tick)) halt("a cycle began later than haltLateness allows");
}

void ClusterLoop::halt(const char* why) {
    runner_.states().halt(ClusterHalted, why);
    ended_.store(Ended::Halted, std::memory_order_release);
}

void ClusterLoop::tell(Severity severity, const EventText& text) {
    agent_.post(agent_.thread(0), severity, EventKind::Overflow, agent_.agentSimplex(), text);
}

// A loop that is stepped by hand has only its nominal time.
void ClusterLoop::judgePace(const Tick& tick, std::int64_t begin) {
    if (!pace_.add(tick, trigger_.realTime() ? begin : tick.nominalTime)) return;
    agent_.pace().set(pace_.rate(), pace_.overloaded());
    if (!pace_.changed()) return;
    const double due = 1e9 / static_cast<double>(trigger_.period());
    EventText text{pace_.overloaded() ? "overloaded: " : "no longer overloaded: "};
    const double rate = std::round(pace_.rate() * 10) / 10, wanted = std::round(due * 10) / 10;
    text << rate << " cycles a second";
    if (rate != wanted) text << " instead of " << wanted;
    if (pace_.overloaded() && pace_.motion() < 0.995)
        text << "; all motion has " << std::round(pace_.motion() * 100) << " % of its speed";
    if (pace_.overloaded()) nameLongest(text);
    tell(pace_.overloaded() ? Severity::Warning : Severity::Info, text);
}

void ClusterLoop::countMissed(std::int64_t missed) {
    metrics_.overflow(missed);
    unreported_ += missed;
    if (options_.overflow == Overflow::Halt)
        halt("the loop overran its period and overflow is \"halt\"");
}

// By the clock of the machine: a loop that is stepped by hand writes the same at each run.
void ClusterLoop::nameLongest(EventText& text) {
    const LongestTask longest = runner_.longest();
    if (!trigger_.realTime() || longest.time <= trigger_.period() / 2) return;
    const std::int64_t hundredths = longest.time / 10'000;
    text << "; " << agent_.structure().simplexes[longest.simplex].path << " took "
         << static_cast<double>(hundredths) / 100 << " ms";
}

// Events of the cycle that follows: those of the one before have been handed out.
void ClusterLoop::reportMissed() {
    if (unreported_ == 0) return;
    EventText text{"missed "};
    text << unreported_ << (unreported_ == 1 ? " tick" : " ticks") << ", " << metrics_.overflows()
         << " since the start";
    unreported_ = 0;
    nameLongest(text);
    tell(Severity::Warning, text);
}

// A job is never cut: this comes after it, and decides what becomes of the ticks it ran over.
void ClusterLoop::checkOverflow() {
    const std::int64_t missed = trigger_.missed();
    if (missed == 0) {
        caughtUp_ = 0;
        trigger_.skipMissed(options_.overflow != Overflow::CatchUp);
        return;
    }
    if (missed > counted_) {
        countMissed(missed - counted_);
        counted_ = missed;
    }
    const bool catchUp = options_.overflow == Overflow::CatchUp &&
                         caughtUp_ < static_cast<std::int64_t>(options_.catchUpCycles);
    caughtUp_ = catchUp ? caughtUp_ + 1 : 0;
    trigger_.skipMissed(!catchUp);
}

// After the last tick: everything to Standby level by level, then by force, until all demands are
// safe, too; the last write is the last cycle's. Where the time has fewer periods than all levels
// need, the loop runs faster then; who gives it less than one period wants none of that.
void ClusterLoop::shutDown() {
    const std::int64_t stopBudget = std::llround(options_.stopTimeout * 1e9);
    const std::int64_t most = std::max<std::int64_t>(stopBudget / (2 * group_.levels() + 2), 1);
    const std::int64_t period =
        stopBudget < trigger_.period() ? trigger_.period() : std::min(trigger_.period(), most);
    const std::int64_t budget = std::max<std::int64_t>(stopBudget / period, 2);
    Trigger trigger = last_;
    trigger.periods = 1;
    trigger.lateness = 0;
    const std::int64_t start = monotonicNow();
    RunningTime passed{std::chrono::nanoseconds{period} + 20ms};
    group_.beginStop();
    runner_.states().beginStop();
    const auto goesOn = [this] { return !group_.allResting() || runner_.demands().anyOnTheWay(); };
    for (std::int64_t i = 1; cycle_ > 0 && i <= budget && goesOn(); ++i) {
        trigger.nominalTime += period;
        if (trigger_.realTime()) {
            std::this_thread::sleep_until(std::chrono::steady_clock::time_point{
                std::chrono::nanoseconds{start + std::min(i * period, stopBudget)}});
        }
        group_.step();
        if (i == budget || passed.look().count() > stopBudget) {
            i = budget;
            group_.tellOverdue(options_.stopTimeout);
            runner_.states().forceStandby();
        }
        cycle(trigger);
    }
    tellUnsafe();
    reportMissed();
}

// On the watchdog's thread.
void ClusterLoop::tell(Watchdog::Finding finding, const Tick& tick, std::int64_t since) {
    if (finished_.load(std::memory_order_acquire)) return;
    if (finding == Watchdog::Finding::Hangs) {
        const HungHook hook = findHungHook(runner_, agent_);
        agent_.standstill().set({hook.standstill(), since});
        standsStill(tick, hook, hook.text());
    } else if (finding == Watchdog::Finding::NoTick) {
        agent_.standstill().set({"has had no tick", since});
        standsStill(tick, {"/" + agent_.name(), "the trigger", false},
                    "no tick has come for longer than the watchdog allows");
    } else if (finding == Watchdog::Finding::TimedOut) {
        timedOutAfter_.store(tick.cycle, std::memory_order_release);
        if (trigger_.timeOut()) return;
        post(tick, agent_.agentSimplex(),
             "no tick has come within triggerTimeout; nothing can be made safe without one");
    } else {
        agent_.standstill().clear();
    }
}

void ClusterLoop::standsStill(const Tick& tick, const HungHook& where, std::string_view text) {
    post(tick, agent_.structure().find(where.path), text);
    beat({tick.cycle, false, where.path, where.hook});
}

void ClusterLoop::post(const Tick& tick, std::uint32_t simplex, std::string_view text) {
    Event event;
    event.cycle = tick.cycle;
    event.time = tick.nominalTime;
    event.simplex = simplex;
    event.severity = Severity::Error;
    event.kind = EventKind::Watchdog;
    event.text = EventText{text};
    agent_.events().postOutside(event);
}

std::optional<HungHook> ClusterLoop::stop() {
    if (!thread_.joinable()) return std::nullopt;
    trigger_.interrupt();
    // The loop ends by itself within its budget, unless a cycle does not end or none begins.
    std::int64_t seen = -1;
    RunningTime stood{20ms};
    while (!finished_.load(std::memory_order_acquire)) {
        std::this_thread::sleep_for(1ms);
        const std::int64_t cycle = watchdog_->begun();
        if (cycle != seen) {
            seen = cycle;
            stood.restart();
        } else if (stood.look() >= test_.endBudget) {
            ended_.store(Ended::Hung, std::memory_order_release);
            return findHungHook(runner_, agent_);
        }
    }
    const BoundedStep step{"the end of the threads cortex-watchdog and " + agent_.name()};
    thread_.join();
    watchdog_.reset();
    return std::nullopt;
}

}  // namespace cortex::cs
