// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string_view>
#include <type_traits>

namespace cortex::cs {

// The newest value from one thread to another one. Neither waits for the other.
//
// **Invariants**
// 1. Of the three slots one belongs to the writer, one to the reader, one lies between them. Which
//    one lies there is in `between_`; each side keeps the number of its own to itself.
// 2. A side gets another slot only by exchanging its own for the one between, in one atomic step.
//    So no slot ever belongs to two, and each of the three always belongs to somebody.
// 3. put() writes only the writer's slot and then exchanges it; the bit `isNew` goes with it.
// 4. take() exchanges only where that bit is set, and what it leaves between has no such bit. So
//    the reader never gets a value that it had before.
// 5. The exchange releases what was written and acquires what the other side has done with the
//    slot: a value is seen whole, and a slot is written after its reader has let go of it.
// 6. Values that are not taken in time are replaced by newer ones; the newest one is never lost.
// 7. One thread at a time writes, and one reads; each step is bounded.
template <class T>
class Newest {
    static_assert(std::is_trivially_copyable_v<T>, "values are plain structs, copied whole");

public:
    void put(const T& value) CORTEX_REALTIME {
        slots_[written_].value = value;
        const unsigned offered = written_ | isNew;
        written_ = between_.exchange(offered, std::memory_order_acq_rel) & ~isNew;
    }
    // True: value() is another one now.
    bool take() CORTEX_REALTIME {
        if ((between_.load(std::memory_order_relaxed) & isNew) == 0) return false;
        read_ = between_.exchange(read_, std::memory_order_acq_rel) & ~isNew;
        return true;
    }
    const T& value() const CORTEX_REALTIME { return slots_[read_].value; }  // reader

private:
    static constexpr unsigned isNew = 4;
    struct alignas(64) Slot {
        T value{};
    };
    std::array<Slot, 3> slots_{};
    alignas(64) unsigned written_ = 0;
    alignas(64) std::atomic<unsigned> between_{1};
    alignas(64) unsigned read_ = 2;
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
    };

    // In populate(): without a newer value for so long (nominal time) the device is lost.
    void loseAfter(std::chrono::nanoseconds time);
    // In hooks: nominal time, ns, since the run of this task that first saw the newest value.
    std::int64_t age() const CORTEX_REALTIME { return age_; }
    // In hooks: there is no value yet, or it is too old, or the thread says so or has ended.
    bool isLost() const CORTEX_REALTIME { return !isGood_; }

    // The thread's side, in communicate().
    bool isEnding() const;                         // return soon: the loop has stopped
    int endDescriptor() const;                     // readable from then on; to poll() beside others
    bool waitFor(std::chrono::nanoseconds) const;  // false: it is ending

private:
    friend class IoThreads;
    struct Thread;

    void loopStart(const Tick& tick) CORTEX_REALTIME final;
    virtual const Told* takeNewest() CORTEX_REALTIME = 0;  // null: nothing new
    virtual void runThread() = 0;

    void lookAtThread() CORTEX_REALTIME;
    void takeTold(const Tick& tick) CORTEX_REALTIME;
    void tellLoss() CORTEX_REALTIME;

    std::unique_ptr<Thread> beside_;
    Told told_;  // last
    std::int64_t lostAfter_ = 1'000'000'000, since_ = -1, age_ = 0;
    bool isGood_ = false, isFirstAwaited_ = true, lossTold_ = false, deathTold_ = false;
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

public:
    using ThreadedSimplex::ThreadedSimplex;

    // What the thread has of its simplex.
    class Line {
    public:
        explicit Line(IoSimplex& simplex) : simplex_{simplex} {}

        void put(const In& value) { say({value, {true, {}}}); }
        // The device is away: quality `lost` at once, with the reason as an event.
        void lose(std::string_view why) { say({last_, {false, EventText{why}}}); }
        // The newest demand; null before the first.
        const Out* demand() {
            if (simplex_.out_.take()) {
                hasDemand_ = true;
                demandSince_ = std::chrono::steady_clock::now();
            }
            return hasDemand_ ? &simplex_.out_.value() : nullptr;
        }
        // How long the loop has given no demand, as far as demand() was asked.
        std::chrono::nanoseconds demandAge() const {
            return std::chrono::steady_clock::now() - demandSince_;
        }
        bool isEnding() const { return simplex_.isEnding(); }
        int endDescriptor() const { return simplex_.endDescriptor(); }
        bool waitFor(std::chrono::nanoseconds time) const { return simplex_.waitFor(time); }

    private:
        void say(const Message& message) {
            last_ = message.value;
            simplex_.in_.put(message);
        }
        IoSimplex& simplex_;
        In last_{};  // stays received() while the device is lost
        bool hasDemand_ = false;
        std::chrono::steady_clock::time_point demandSince_{};
    };

protected:
    // On the thread: may block and allocate. Returns when the line is ending, and before that it
    // waits neither for long nor without an end. After the last cycle demand() is that cycle's.
    virtual void communicate(Line& line) = 0;

    // In hooks, from loopStart on; where isLost() says so it is no present value.
    const In& received() const CORTEX_REALTIME { return in_.value().value; }
    void give(const Out& demand) CORTEX_REALTIME { out_.put(demand); }

private:
    const Told* takeNewest() CORTEX_REALTIME final {
        return in_.take() ? &in_.value().told : nullptr;
    }
    void runThread() final { communicate(line_); }

    Newest<Message> in_;
    Newest<Out> out_;
    Line line_{*this};
};

}  // namespace cortex::cs
