// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/clock.hpp"
#include "cortex/core/error.hpp"

#include "tasks/beside_tick.hpp"
#include "tasks/slow_job.hpp"
#include "tasks/task_set.hpp"
#include "threads/realtime_thread.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <string>

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

namespace cortex::cs {

namespace {

// "io-" and the last part of the path; the system shows 15 characters.
std::string threadName(const std::string& path) {
    return ("io-" + path.substr(path.rfind('/') + 1)).substr(0, 15);
}

}  // namespace

ThreadedSimplex::Thread::~Thread() {
    if (endDescriptor_ >= 0) ::close(endDescriptor_);
}

void ThreadedSimplex::Thread::begin(std::function<void()> function,
                                    std::function<void()> whileDead) {
    endDescriptor_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    if (endDescriptor_ < 0) {
        throw Error("thread " + name_ + " cannot begin: " + std::strerror(errno) +
                    "; let the process have more open files (ulimit -n)");
    }
    function_ = std::move(function);
    whileDead_ = std::move(whileDead);
    thread_ = std::thread{[this] { run(); }};
}

void ThreadedSimplex::Thread::askToEnd() {
    ending_.store(true, std::memory_order_release);
    const std::uint64_t one = 1;
    // Into an empty counter one always fits.
    [[maybe_unused]] const auto written = ::write(endDescriptor_, &one, sizeof one);
}

bool ThreadedSimplex::Thread::waitForEnd(std::int64_t until) {
    bool isTimeLeft = true;
    while (!hasEnded_.load(std::memory_order_acquire)) {
        if (!isTimeLeft) return false;
        const std::uint32_t seen = end_.value();
        if (!hasEnded_.load(std::memory_order_acquire)) isTimeLeft = end_.sleepWhile(seen, until);
    }
    thread_.join();
    return true;
}

bool ThreadedSimplex::Thread::waitFor(std::chrono::nanoseconds time) const {
    const std::int64_t until = monotonicNow() + time.count();
    while (!isEnding()) {
        const std::int64_t left = until - monotonicNow();
        if (left <= 0) return true;
        const timespec most{static_cast<time_t>(left / nsPerSecond),
                            static_cast<long>(left % nsPerSecond)};
        pollfd end{endDescriptor_, POLLIN, 0};
        ppoll(&end, 1, &most, nullptr);
    }
    return false;
}

void ThreadedSimplex::Thread::run() {
    using namespace std::chrono_literals;
    configureBlockingThread(name_);
    while (!isEnding()) {
        try {
            function_();
            if (!isEnding()) die("communicate() returned, although the line was not ending");
        } catch (const std::exception& error) {
            die(error.what());
        } catch (...) {
            die("communicate() threw something that is no std::exception");
        }
        while (death() != nullptr && waitFor(50ms)) whileDead_();
    }
    hasEnded_.store(true, std::memory_order_release);
    end_.advance();
}

void ThreadedSimplex::Thread::die(std::string_view why) {
    why_ = EventText{why};
    deaths_.fetch_add(1, std::memory_order_release);
}

ThreadedSimplex::ThreadedSimplex(Identity identity)
    : SimplexCS{std::move(identity)}, beside_{std::make_unique<Thread>(threadName(path()))} {}

ThreadedSimplex::~ThreadedSimplex() = default;

void ThreadedSimplex::loseAfter(std::chrono::nanoseconds time) {
    if (time.count() <= 0) throw Error(path() + ": loseAfter() needs a time above 0");
    lostAfter_ = time.count();
}

void ThreadedSimplex::staleAfter(std::chrono::nanoseconds time) {
    if (time.count() <= 0) throw Error(path() + ": staleAfter() needs a time above 0");
    staleAfter_ = time.count();
}

SlowWork ThreadedSimplex::atDevice(std::function<void()> work) {
    auto job = std::make_shared<SlowWork::Job>();
    job->work = std::move(work);
    job->isOfDevice = true;
    works_.push_back(job);
    return SlowWork{std::move(job)};
}

std::chrono::nanoseconds ThreadedSimplex::period() const {
    const AgentRuntime& agent = runtime();
    return std::chrono::nanoseconds{agent.options().period} *
           agent.structure().simplexes[index()].every;
}

bool ThreadedSimplex::isRealTime() const { return runtime().options().realTime; }

void ThreadedSimplex::doWork(const EventText* away) {
    for (const std::shared_ptr<SlowWork::Job>& work : works_) {
        if (!work->isAsked()) continue;
        if (away == nullptr)
            work->run();
        else
            work->refuse("the device is away: " + std::string{away->view()});
    }
}

bool ThreadedSimplex::isEnding() const { return beside_->isEnding(); }
int ThreadedSimplex::endDescriptor() const { return beside_->endDescriptor(); }
bool ThreadedSimplex::waitFor(std::chrono::nanoseconds time) const {
    return beside_->waitFor(time);
}

void ThreadedSimplex::loopStart(const Tick& tick) {
    if (since_ < 0) {
        since_ = tick.nominalTime;
        putAt_ = thread_->loop->clock.nanoseconds;
    }
    lookAtThread();
    const bool isNew = !deathTold_ && takeTold();
    setAge(tick, isNew);
    isThere_ = told_.isThere && age_ <= lostAfter_;
    if (isThere_ && lossTold_) event(Severity::Info, "the device is back");
    const bool isAwaited = isFirstAwaited_ && age_ <= lostAfter_;
    if (!isThere_ && !lossTold_ && !isAwaited) tellLoss();
    lossTold_ = !isThere_ && !isAwaited;
    const Quality present = age_ > staleAfter_ ? Quality::Stale : Quality::Good;
    setQuality(isThere_ ? present : Quality::Lost, since_);
    setPace(tick);
    valuesTaken(tick, isNew);
}

// The loop knows its own next deadline; a simplex that runs every n-th cycle skips n - 1 of them.
void ThreadedSimplex::setPace(const Tick& tick) {
    if (pace_.cycle == 0) pace_.period = period();
    pace_.cycle = tick.cycle;
    pace_.next = {};
    if (thread_->nextDeadline == 0) return;
    const std::chrono::nanoseconds skipped =
        pace_.period - std::chrono::nanoseconds{runtime().options().period};
    pace_.next += std::chrono::nanoseconds{thread_->nextDeadline} + skipped;
}

// What was put before a death is no present value, whatever becomes of the thread.
void ThreadedSimplex::lookAtThread() {
    const EventText* death = beside_->death();
    if (death == nullptr) return;
    if (!deathTold_) {
        deathTold_ = true;
        isFirstAwaited_ = false;
        told_ = {false, *death, {}};
        lossTold_ = state() != State::Fault;  // the event of the fault tells it
        enterFault(ThreadEnded, death->view());
    } else if (state() != State::Fault) {
        deathTold_ = false;
        takeNewest();
        beside_->goOn();
    }
}

// Whether there is a new value.
bool ThreadedSimplex::takeTold() {
    const Told* told = takeNewest();
    if (told == nullptr) return false;
    // Another reason is told, too; the same one is told once.
    if (!told->isThere && told->why.view() != told_.why.view()) lossTold_ = false;
    told_ = *told;
    isFirstAwaited_ = false;
    if (told_.isThere) putAt_ = std::chrono::nanoseconds{told_.since.time_since_epoch()}.count();
    return told_.isThere;
}

// Nominal time does not run while the process stands still, and what was put before that may be
// seen first after it. So from then on the clock alone says how old such a value is, as it does for
// one that was too old when it came. Its stamp goes on with nominal time, and never back.
void ThreadedSimplex::setAge(const Tick& tick, bool isNew) {
    const std::int64_t real = isRealTime() ? thread_->loop->clock.nanoseconds - putAt_ : 0;
    const bool isOld = isNew ? real > lostAfter_ : isByClock_;
    isByClock_ = isOld || putAt_ < thread_->stoodUntil;
    if (isByClock_) {
        age_ = std::max<std::int64_t>(real, 0);
        since_ = std::max(since_, tick.nominalTime - age_);
        return;
    }
    if (isNew) since_ = tick.nominalTime;
    age_ = tick.nominalTime - since_;
}

void ThreadedSimplex::tellLoss() {
    EventText text{"the device is lost: "};
    if (!runtime().options().devices) {
        text << "nobody talks to devices here";
    } else if (!told_.isThere && !isFirstAwaited_) {
        text << told_.why.view();
    } else if (isByClock_) {
        text << "its newest value is " << std::round(static_cast<double>(age_) * 1e-6) * 1e-3
             << " s old, as the loop or thread " << beside_->name() << " stood still";
    } else {
        text << "thread " << beside_->name() << " has given no value for "
             << static_cast<double>(age_) * 1e-9 << " s";
    }
    event(Severity::Warning, text);
}

}  // namespace cortex::cs
