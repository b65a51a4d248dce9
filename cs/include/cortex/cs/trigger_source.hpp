// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace cortex::cs {

// What waitForTick() returns: the deadline that was waited for.
struct Trigger {
    std::int64_t nominalTime = 0;  // ns since the source's first tick; the first tick is at 0
    std::int64_t lateness = 0;     // ns from the deadline to the wake-up
    std::int64_t periods = 1;      // periods since the last tick; above 1: ticks were missed
    bool stopped = false;          // no further tick: the loop ends
    bool timedOut = false;         // no tick came: timeOut() ended the wait
};

// Starts each cycle. One thread waits, any thread interrupts.
class TriggerSource {
public:
    virtual ~TriggerSource() = default;
    virtual void start() = 0;  // loop thread, before the first wait
    virtual Trigger waitForTick() = 0;
    virtual void interrupt() = 0;  // makes the present or next wait return `stopped`
    // Makes the present or next wait return `timedOut`. False: this source cannot. Any thread.
    virtual bool timeOut() { return false; }
    virtual std::int64_t period() const = 0;  // nominal, ns
    // How many deadlines have passed that no cycle has begun for; the loop asks after each cycle.
    virtual std::int64_t missed() { return 0; }
    // After a late cycle: give up the missed deadlines (true) or return them at once (false).
    virtual void skipMissed(bool) {}
    // When the next tick is due, ns of the monotonic clock, so that others can wake for it as well;
    // 0: not known. Loop thread, in a cycle.
    virtual std::int64_t nextDeadline() const { return 0; }
    // Whether a period takes its time; false: cycles may follow at once (stepping).
    virtual bool realTime() const { return true; }
    // What speaks against waiting as it does; one sentence each. Loop thread, after start().
    virtual std::vector<std::string> report() const { return {}; }
};

// Absolute deadlines on the monotonic clock: start + k × period, no drift. It sleeps, and for the
// last `spin` before each deadline polls the clock instead; from one period on it never sleeps.
// That saves the time of a wake-up and costs a CPU: give the loop an isolated one.
class InternalClock final : public TriggerSource {
public:
    explicit InternalClock(std::chrono::nanoseconds period, std::chrono::nanoseconds spin = {});

    void start() override;
    Trigger waitForTick() override;
    void interrupt() override;
    std::int64_t period() const override { return period_; }
    std::int64_t missed() override;
    std::int64_t nextDeadline() const override { return origin_ + next_ * period_; }
    void skipMissed(bool skip) override { skip_ = skip; }
    std::vector<std::string> report() const override;

private:
    std::int64_t period_, spin_;
    std::int64_t origin_ = 0;
    std::int64_t next_ = 0;  // index of the next deadline
    bool skip_ = true;
    std::atomic<bool> interrupted_{false};
};

// One cycle for each step(): tests, stepping, faster than real time. step() returns when the cycle
// has ended.
class ManualTrigger final : public TriggerSource {
public:
    explicit ManualTrigger(std::chrono::nanoseconds period);

    void step(std::int64_t cycles = 1);

    void start() override;
    Trigger waitForTick() override;
    void interrupt() override;
    std::int64_t period() const override { return period_; }
    std::int64_t missed() override;
    void skipMissed(bool skip) override { skip_ = skip; }
    bool realTime() const override { return false; }

private:
    friend struct ClusterTesting;
    std::int64_t period_;
    std::int64_t tick_ = -1;
    std::int64_t late_ = 0, requestedLate_ = 0;
    bool skip_ = true;
    std::int64_t requested_ = 0, started_ = 0, finished_ = 0;
    bool running_ = false, interrupted_ = false;
    std::mutex mutex_;
    std::condition_variable wake_;
};

// Ticks from elsewhere: another thread, a socket, a device. notify() is called once a tick; ticks
// that come while a cycle runs are missed, and skipped or caught up.
class ExternalTrigger final : public TriggerSource {
public:
    explicit ExternalTrigger(std::chrono::nanoseconds nominalPeriod);

    void notify();  // any thread, signal-safe
    bool timeOut() override;

    void start() override;
    Trigger waitForTick() override;
    void interrupt() override;
    std::int64_t period() const override { return period_; }
    std::int64_t missed() override;
    void skipMissed(bool skip) override { skip_ = skip; }

private:
    std::int64_t period_;
    std::int64_t seen_ = 0;
    bool skip_ = true;
    std::atomic<std::uint32_t> notified_{0};
    std::atomic<bool> interrupted_{false}, timedOut_{false};
};

// Ticks that come through a file descriptor, which it closes in the end: one for each datagram of a
// socket, each byte of a pipe or device, or as many as an eventfd or timerfd counts. The loop's
// thread waits for them itself. What came before the start does not count.
class DescriptorTrigger final : public TriggerSource {
public:
    // Throws Error for what has no such ticks: a closed descriptor, a file, a stream.
    DescriptorTrigger(int descriptor, std::chrono::nanoseconds nominalPeriod);
    ~DescriptorTrigger() override;
    DescriptorTrigger(const DescriptorTrigger&) = delete;
    DescriptorTrigger& operator=(const DescriptorTrigger&) = delete;

    // A socket for datagrams to this IPv4 address and port; throws Error. Port 0: a free one.
    static int openUdp(const std::string& address, std::uint16_t port);

    void start() override;
    Trigger waitForTick() override;  // throws Error when there is nobody left who could send ticks
    void interrupt() override;
    bool timeOut() override;
    std::int64_t period() const override { return period_; }
    std::int64_t missed() override { return pending_; }
    void skipMissed(bool skip) override { skip_ = skip; }

private:
    using Take = std::int64_t (*)(int descriptor);  // how many ticks have come

    bool isReadable(int milliseconds) const;
    void takePending();
    void endWait() const;

    int descriptor_;
    int interrupt_ = -1;
    Take take_;
    std::int64_t period_;
    std::int64_t seen_ = 0;     // ticks that were returned or passed over
    std::int64_t pending_ = 0;  // that were taken, but not returned
    bool skip_ = true;
    std::atomic<bool> interrupted_{false}, timedOut_{false};
};

}  // namespace cortex::cs
