// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/newest.hpp"
#include "cortex/cs/simplex_cs.hpp"
#include "cortex/cs/slow_work.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

namespace cortex::cs {

// When the hooks run next, for a thread that wakes shortly after them: nobody wakes it.
struct Pace {
    using Clock = std::chrono::steady_clock;

    std::int64_t cycle = 0;    // of the loop, in which the demand was given; 0: none was
    Clock::time_point next{};  // when the next run is due; {}: not known, as in a stepped loop
    std::chrono::nanoseconds period{};  // nominal, from one run to the next

    bool isKnown() const { return next != Clock::time_point{}; }
    // The first run that is due after `time`, if the loop keeps its pace. Where isKnown().
    Clock::time_point after(Clock::time_point time) const {
        if (time < next) return next;
        return next + ((time - next) / period + 1) * period;
    }
};

// An active simplex with a thread of its own beside the tick, for what may block: the part that
// does not depend on what is exchanged. Derive from IoSimplex.
class ThreadedSimplex : public SimplexCS {
public:
    explicit ThreadedSimplex(Identity identity);
    ~ThreadedSimplex() override;

protected:
    // What the thread says of the device.
    struct Told {
        bool isThere = false;
        EventText why{};
        Pace::Clock::time_point since{};  // of the value
    };

    // In populate(): without a newer value for so long (nominal time) the device is lost.
    void loseAfter(std::chrono::nanoseconds time);
    // In populate(): before that, from so long on, its quality is stale. Without it: never.
    void staleAfter(std::chrono::nanoseconds time);
    // In populate(): work that a hook may begin and that the thread does, in line.doWork(). It is
    // never lost: it is done, or ends with a failure() that says why the device is away.
    SlowWork atDevice(std::function<void()> work);
    // From populate() on: nominal time from one run to the next.
    std::chrono::nanoseconds period() const;

    // In loopStart(): received(), age() and isLost() are those of this cycle; `isNew`: there is a
    // value that no cycle has seen before.
    virtual void valuesTaken(const Tick&, bool /*isNew*/) CORTEX_REALTIME {}
    // In hooks: nominal time, ns, since the run of this task that first saw the newest value. By
    // the clock, since it was put, if the loop stood still after that or the thread was held up.
    std::int64_t age() const CORTEX_REALTIME { return age_; }
    // In hooks: there is no value yet, or it is too old, or the thread says so or has ended.
    bool isLost() const CORTEX_REALTIME { return !isThere_; }
    Pace pace() const CORTEX_REALTIME { return pace_; }  // in hooks

    // The thread's side, in communicate().
    bool isEnding() const;                         // return soon: the loop has stopped
    int endDescriptor() const;                     // readable from then on; to poll() beside others
    bool waitFor(std::chrono::nanoseconds) const;  // false: it is ending
    bool isRealTime() const;                       // false: the loop is stepped
    // `away`: why the device is, which ends all work that is asked for; null: it is there.
    void doWork(const EventText* away);

private:
    friend class IoThreads;
    struct Thread;

    void loopStart(const Tick& tick) CORTEX_REALTIME final;
    virtual const Told* takeNewest() CORTEX_REALTIME = 0;  // null: nothing new
    virtual void runThread() = 0;

    void lookAtThread() CORTEX_REALTIME;
    bool takeTold() CORTEX_REALTIME;
    void setAge(const Tick& tick, bool isNew) CORTEX_REALTIME;
    void setPace(const Tick& tick) CORTEX_REALTIME;
    void tellLoss() CORTEX_REALTIME;

    std::unique_ptr<Thread> beside_;
    std::vector<std::shared_ptr<SlowWork::Job>> works_;
    Told told_;  // last
    Pace pace_;
    std::int64_t lostAfter_ = 1'000'000'000, since_ = -1, age_ = 0;
    std::int64_t putAt_ = 0;  // the newest value, ns of the monotonic clock
    std::int64_t staleAfter_ = std::numeric_limits<std::int64_t>::max();
    bool isThere_ = false, isFirstAwaited_ = true, lossTold_ = false, deathTold_ = false;
    bool isByClock_ = false;  // the age of the newest value
};

// An active simplex whose device blocks. A thread of its own hands values to the hooks and takes
// demands from them; both are plain structs, and the newest counts. It begins when the cluster has
// started and ends after the last cycle. What it throws is a Fault; clearFaults begins it anew.
template <class In, class Out>
class IoSimplex : public ThreadedSimplex {
    struct Message {
        In value{};
        Told told{};
    };
    struct Demand {
        Out value{};
        Pace pace{};
    };

public:
    using ThreadedSimplex::ThreadedSimplex;

    // What the thread has of its simplex.
    class Line {
    public:
        explicit Line(IoSimplex& simplex) : simplex_{simplex} {}

        // `since`: it is at least as young; for what may have waited before the thread had it.
        void put(const In& value, Pace::Clock::time_point since = Pace::Clock::now()) {
            say({value, {true, {}, since}});
        }
        // The device is away: quality `lost` at once, with the reason as an event.
        void lose(std::string_view why) { say({last_.value, {false, EventText{why}, {}}}); }
        // The newest demand; null before the first.
        const Out* demand() {
            if (simplex_.out_.take()) {
                hasDemand_ = true;
                demandSince_ = Pace::Clock::now();
            }
            return hasDemand_ ? &simplex_.out_.value().value : nullptr;
        }
        // How long the loop has given no demand, as far as demand() was asked.
        std::chrono::nanoseconds demandAge() const { return Pace::Clock::now() - demandSince_; }
        // The same for longer than `time`, in a loop that is not stepped.
        bool loopHangs(std::chrono::nanoseconds time) const {
            return simplex_.isRealTime() && demandAge() > time;
        }
        // Of the newest demand, as far as demand() was asked.
        Pace pace() const {
            return hasDemand_ ? simplex_.out_.value().pace : Pace{0, {}, simplex_.period()};
        }
        // Does what hooks have begun by atDevice(); call it between two exchanges, and now and
        // then while the device is away.
        void doWork() { simplex_.doWork(last_.told.isThere ? nullptr : &last_.told.why); }
        bool isEnding() const { return simplex_.isEnding(); }
        int endDescriptor() const { return simplex_.endDescriptor(); }
        bool waitFor(std::chrono::nanoseconds time) const { return simplex_.waitFor(time); }
        bool waitUntil(Pace::Clock::time_point time) const {
            return simplex_.waitFor(time - Pace::Clock::now());
        }

    private:
        friend class IoSimplex;
        void say(const Message& message) {
            last_ = message;
            simplex_.in_.put(message);
        }
        IoSimplex& simplex_;
        Message last_{{}, {false, "it has not answered yet", {}}};  // its value stays received()
        bool hasDemand_ = false;
        Pace::Clock::time_point demandSince_{};
    };

protected:
    // On the thread: may block and allocate. Returns when the line is ending, and before that it
    // waits neither for long nor without an end. After the last cycle demand() is that cycle's.
    virtual void communicate(Line& line) = 0;

    // In hooks, from loopStart on; where isLost() says so it is no present value.
    const In& received() const CORTEX_REALTIME { return in_.value().value; }
    void give(const Out& demand) CORTEX_REALTIME { out_.put({demand, pace()}); }

private:
    const Told* takeNewest() CORTEX_REALTIME final {
        return in_.take() ? &in_.value().told : nullptr;
    }
    void runThread() final {
        line_.last_.told = {false, "it has not answered yet", {}};
        communicate(line_);
    }

    Newest<Message> in_;
    Newest<Demand> out_;
    Line line_{*this};
};

}  // namespace cortex::cs
