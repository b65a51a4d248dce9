// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/error.hpp"
#include "cortex/core/simplex.hpp"
#include "cortex/cs/io_exchange.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace cortex::toolkit {

// What a FieldbusDevice throws on its thread: what, where, remedy, as in "10.0.0.7:502: no answer
// for 20 ms; is the drive switched on?". The link is closed and opened anew. It is no fault.
class LinkError : public Error {
public:
    using Error::Error;
};
// The same, where somebody answers, but not as this device should: another identity, a refusal.
class LinkRefused : public LinkError {
public:
    using LinkError::LinkError;
};

// As the item `link` says it.
enum class Link : std::int64_t { Closed, Connecting, Open, Refused };

// What is known of a link: it stands in the items of its device.
struct LinkReport {
    Link link = Link::Closed;
    std::int64_t exchanges = 0, late = 0, errors = 0, reconnects = 0;
    double timeLast = 0, timeP99 = 0, timeMax = 0;  // us, of an exchange
};

// The items of type FieldbusDevice that are written in each cycle. A device that is a model in this
// process has no thread: it derives from cs::SimplexCS, keeps a LinkReport of its own, steps its
// model in loopEnd(), counts there, and writes the report. Its quality it sets by setQuality().
//
//     populate():   items_.populate(*this);  on<&Model::reconnect>("reconnect");
//     loopEnd():    report_.link = Link::Open;  ++report_.exchanges;  items_.write(report_, 0);
class LinkItems {
public:
    void populate(Simplex& device);
    // `age`: nominal time since the last whole answer, ns.
    void write(const LinkReport& report, std::int64_t age) CORTEX_REALTIME;

private:
    Data<std::int64_t> link_, exchanges_, late_, errors_, reconnects_;
    Data<double> age_, timeLast_, timeP99_, timeMax_;
};

// The constant items of type FieldbusDevice.
struct LinkSettings {
    std::string address;
    std::chrono::nanoseconds exchangePeriod{}, responseTimeout{}, lossTime{}, reconnectTime{};

    // In populate(), of a simplex that runs once in `period`. Throws Error where lossTime is below
    // two periods: one late answer would lose the device.
    static LinkSettings of(Simplex& device, std::chrono::nanoseconds period);
    // From one exchange to the next.
    std::chrono::nanoseconds between(std::chrono::nanoseconds period) const {
        return exchangePeriod.count() > 0 ? exchangePeriod : period;
    }
};

// What the machine of a link asks its device to do; on the device's thread.
class LinkSteps {
public:
    virtual ~LinkSteps() = default;
    virtual void connect() = 0;
    virtual void close() noexcept = 0;
    virtual bool hasDemand() = 0;  // there was a cycle
    virtual void exchangeNewest() = 0;
    virtual void putAnswer() = 0;  // hands it to the hooks
    virtual void lose(std::string_view why) = 0;
    virtual void doWork() = 0;                                     // that hooks have asked for
    virtual bool waitUntil(cs::Pace::Clock::time_point time) = 0;  // false: the loop has ended
    virtual cs::Pace pace() = 0;
};

// The machine of a link: Closed, Connecting, Open or Refused. run() is the thread's.
class LinkMachine {
public:
    LinkMachine();
    ~LinkMachine();

    void populate(LinkSettings settings);
    const LinkSettings& settings() const;
    // Until the loop has ended. What is no LinkError it throws on, with the link closed.
    void run(LinkSteps& device);
    // Work that closes the link where it throws a LinkError. Setup phase.
    std::function<void()> guarded(std::function<void()> work);

    // In hooks: closes the link and opens it at once, also while it waits to try again.
    void reconnect() CORTEX_REALTIME { reconnect_.store(true, std::memory_order_relaxed); }
    // In hooks, once a cycle: the newest report.
    const LinkReport& report() CORTEX_REALTIME {
        reports_.take();
        return reports_.value();
    }

private:
    struct Thread;
    std::unique_ptr<Thread> thread_;
    std::atomic<bool> reconnect_{false};
    cs::Newest<LinkReport> reports_;
};

}  // namespace cortex::toolkit
