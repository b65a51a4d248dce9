// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/clock.hpp"
#include "cortex/core/error.hpp"

#include "tasks/beside_tick.hpp"
#include "tasks/task_set.hpp"
#include "threads/realtime_thread.hpp"

#include <cerrno>
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

void ThreadedSimplex::Thread::begin(std::function<void()> function) {
    endDescriptor_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    if (endDescriptor_ < 0) {
        throw Error("thread " + name_ + " cannot begin: " + std::strerror(errno) +
                    "; let the process have more open files (ulimit -n)");
    }
    function_ = std::move(function);
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
        while (death() != nullptr && waitFor(50ms)) {
        }
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

bool ThreadedSimplex::isEnding() const { return beside_->isEnding(); }
int ThreadedSimplex::endDescriptor() const { return beside_->endDescriptor(); }
bool ThreadedSimplex::waitFor(std::chrono::nanoseconds time) const {
    return beside_->waitFor(time);
}

void ThreadedSimplex::loopStart(const Tick& tick) {
    if (since_ < 0) since_ = tick.nominalTime;
    lookAtThread();
    if (!deathTold_) takeTold(tick);
    age_ = tick.nominalTime - since_;
    isGood_ = told_.isThere && age_ <= lostAfter_;
    if (isGood_ && lossTold_) event(Severity::Info, "the device is back");
    const bool isAwaited = isFirstAwaited_ && age_ <= lostAfter_;
    if (!isGood_ && !lossTold_ && !isAwaited) tellLoss();
    lossTold_ = !isGood_ && !isAwaited;
    setQuality(isGood_ ? Quality::Good : Quality::Lost, since_);
}

// What was put before a death is no present value, whatever becomes of the thread.
void ThreadedSimplex::lookAtThread() {
    const EventText* death = beside_->death();
    if (death == nullptr) return;
    if (!deathTold_) {
        deathTold_ = true;
        isFirstAwaited_ = false;
        told_ = {false, *death};
        lossTold_ = state() != State::Fault;  // the event of the fault tells it
        enterFault(ThreadEnded, death->view());
    } else if (state() != State::Fault) {
        deathTold_ = false;
        takeNewest();
        beside_->goOn();
    }
}

void ThreadedSimplex::takeTold(const Tick& tick) {
    const Told* told = takeNewest();
    if (told == nullptr) return;
    // Another reason is told, too; the same one is told once.
    if (!told->isThere && told->why.view() != told_.why.view()) lossTold_ = false;
    told_ = *told;
    isFirstAwaited_ = false;
    if (told_.isThere) since_ = tick.nominalTime;
}

void ThreadedSimplex::tellLoss() {
    EventText text{"the device is lost: "};
    if (!told_.isThere && !isFirstAwaited_) {
        text << told_.why.view();
    } else {
        text << "thread " << beside_->name() << " has given no value for "
             << static_cast<double>(age_) * 1e-9 << " s";
    }
    event(Severity::Warning, text);
}

}  // namespace cortex::cs
