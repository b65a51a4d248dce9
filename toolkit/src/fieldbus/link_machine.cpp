// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/fieldbus_link.hpp"

#include "fieldbus/exchange_times.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace cortex::toolkit {

using namespace std::chrono_literals;
using Clock = cs::Pace::Clock;

// What only the thread touches, and what is settled before it begins.
struct LinkMachine::Thread {
    LinkSettings settings;
    cs::Newest<LinkReport>* reports = nullptr;
    std::atomic<bool>* reconnect = nullptr;

    LinkReport report;
    ExchangeTimes times;
    std::chrono::nanoseconds pause{};   // before it connects next
    std::optional<std::string> broken;  // why work that was asked for found the link closed
    bool wasOpen = false;

    void tell(Link link) {
        report.link = link;
        reports->put(report);
    }
    void connect(LinkSteps& device);
    void exchange(LinkSteps& device);
    void talk(LinkSteps& device);
    void end(LinkSteps& device);
    void fail(LinkSteps& device, std::string_view why, Link link);
    void connectAnew(LinkSteps& device);
    bool wait(LinkSteps& device);
    Clock::time_point due(const cs::Pace& pace, Clock::time_point begin) const;
    Clock::time_point wakeUp(const cs::Pace& pace, Clock::time_point begin) const;
};

namespace {

constexpr std::chrono::nanoseconds longestPause = 5s;
// From the loop's deadline to the exchange: by then most tasks have run, and its demand is this
// cycle's. The answer is there before the next deadline.
constexpr int shareOfPeriod = 5;

}  // namespace

void LinkMachine::Thread::connect(LinkSteps& device) {
    reconnect->store(false, std::memory_order_relaxed);
    tell(Link::Connecting);
    device.connect();
    if (std::exchange(wasOpen, true)) ++report.reconnects;
    tell(Link::Open);
}

// When the next exchange is due, so that an answer which comes later is late.
Clock::time_point LinkMachine::Thread::due(const cs::Pace& pace, Clock::time_point begin) const {
    const std::chrono::nanoseconds between = settings.between(pace.period);
    return pace.isKnown() && between == pace.period ? pace.after(begin) : begin + between;
}

// Shortly after the first deadline that is not before the next exchange; a jitter of half a period
// counts for nothing. By its own period where no deadline is known, or where that is shorter.
Clock::time_point LinkMachine::Thread::wakeUp(const cs::Pace& pace, Clock::time_point begin) const {
    const std::chrono::nanoseconds between = settings.between(pace.period);
    if (!pace.isKnown() || between < pace.period) return begin + between;
    const std::chrono::nanoseconds offset = pace.period / shareOfPeriod;
    const auto wanted = begin + between - pace.period / 2;
    return pace.after(std::max(Clock::now(), wanted) - offset) + offset;
}

// The report comes first: whoever sees the answer sees what was counted with it.
void LinkMachine::Thread::exchange(LinkSteps& device) {
    const auto begin = Clock::now();
    const auto next = due(device.pace(), begin);
    device.exchangeNewest();
    const auto end = Clock::now();
    ++report.exchanges;
    if (end > next) ++report.late;
    times.add(end - begin);
    times.write(report);
    pause = settings.reconnectTime;
    tell(Link::Open);
    device.putAnswer();
}

// Until the loop has ended.
void LinkMachine::Thread::talk(LinkSteps& device) {
    auto begin = Clock::now();
    do {
        begin = Clock::now();
        if (device.hasDemand()) exchange(device);
        device.doWork();
        if (broken) throw LinkError(*std::exchange(broken, std::nullopt));
        if (reconnect->load(std::memory_order_relaxed)) connectAnew(device);
    } while (device.waitUntil(wakeUp(device.pace(), begin)));
}

void LinkMachine::Thread::connectAnew(LinkSteps& device) {
    device.close();
    device.lose("it connects anew, as it was commanded to");
    connect(device);
}

// The loop has waited until the demand is safe.
void LinkMachine::Thread::end(LinkSteps& device) {
    try {
        if (device.hasDemand()) device.exchangeNewest();
    } catch (const LinkError&) {
        return;  // nobody is left to hear of it
    }
}

void LinkMachine::Thread::fail(LinkSteps& device, std::string_view why, Link link) {
    device.close();
    ++report.errors;
    broken.reset();
    tell(link);
    device.lose(why);
}

// Before it tries again. False: the loop has ended.
bool LinkMachine::Thread::wait(LinkSteps& device) {
    const auto until = Clock::now() + pause;
    pause = std::min(2 * pause, std::max(longestPause, settings.reconnectTime));
    for (auto now = Clock::now(); now < until; now = Clock::now()) {
        device.doWork();  // it ends as failed
        if (reconnect->load(std::memory_order_relaxed)) return true;
        if (!device.waitUntil(std::min(until, now + 50ms))) return false;
    }
    return true;
}

LinkMachine::LinkMachine() : thread_{std::make_unique<Thread>()} {
    thread_->reports = &reports_;
    thread_->reconnect = &reconnect_;
}
LinkMachine::~LinkMachine() = default;

void LinkMachine::populate(LinkSettings settings) { thread_->settings = std::move(settings); }
const LinkSettings& LinkMachine::settings() const { return thread_->settings; }

void LinkMachine::run(LinkSteps& device) {
    const auto close = [this](LinkSteps* open) {
        open->close();
        thread_->tell(Link::Closed);
    };
    const std::unique_ptr<LinkSteps, decltype(close)> closing{&device, close};
    thread_->pause = thread_->settings.reconnectTime;
    do {
        try {
            thread_->connect(device);
            thread_->talk(device);
            return thread_->end(device);
        } catch (const LinkRefused& error) {
            thread_->fail(device, error.what(), Link::Refused);
        } catch (const LinkError& error) {
            thread_->fail(device, error.what(), Link::Closed);
        }
    } while (thread_->wait(device));
}

std::function<void()> LinkMachine::guarded(std::function<void()> work) {
    return [this, asked = std::move(work)] {
        try {
            asked();
        } catch (const LinkError& error) {
            thread_->broken = error.what();
            throw;
        }
    };
}

}  // namespace cortex::toolkit
