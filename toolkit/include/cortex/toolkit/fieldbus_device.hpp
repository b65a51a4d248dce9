// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/toolkit/fieldbus_link.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <string_view>
#include <utility>

namespace cortex::toolkit {

// What goes to the thread in each cycle.
template <class Out>
struct LinkDemand {
    Out wanted{};
    Out quiet{};  // for when the loop hangs
};

// A device behind a bus or a socket, of a type that extends FieldbusDevice (ontology/devices.xml).
// Its thread connects by itself in every state, exchanges one Out for one In in each period, and
// connects anew after an error. In and Out are plain structs, copied whole. What is seen when:
// docs/devices.md, "A device behind a bus or a socket".
//
//     class Pump final : public FieldbusDevice<Reading, Wish> {
//         using FieldbusDevice::FieldbusDevice;
//         void populate() override { …; populateLink(); }
//         … the six functions below
//     };
//
// A device that is a model in this process needs no thread: LinkItems in fieldbus_link.hpp.
template <class In, class Out>
class FieldbusDevice : public cs::IoSimplex<In, LinkDemand<Out>>, private LinkSteps {
    using Exchange = cs::IoSimplex<In, LinkDemand<Out>>;

public:
    using Exchange::Exchange;
    using typename Exchange::Line;

protected:
    // On the thread: may block and allocate, and throw LinkError or LinkRefused; anything else that
    // is thrown is fault -8. None takes longer than 0.7 s, also where nobody answers, or it holds
    // up the end of the program.
    void connect() override = 0;  // opens it and asks who is there; reads before it writes
    virtual void exchange(const Out& demand, In& answer) = 0;  // within responseTimeout
    void close() noexcept override = 0;  // also after a connect() that threw; may be called twice

    // In the tick: bounded and silent. The first two are called in loopEnd(), after the hooks of
    // the states, and begin with zeros. Not while an input is lost, and not in Fault:
    virtual void pack(Out& demand) CORTEX_REALTIME = 0;
    // In each cycle, before pack(): what to send in place of that, also when the loop hangs.
    // docs/devices.md says under `inputLost()` what is right.
    virtual void quiet(Out& demand) CORTEX_REALTIME = 0;
    // In loopStart(), in each cycle that has a new answer; received() is the same until the next.
    virtual void unpack(const In& answer) CORTEX_REALTIME = 0;

    // In populate(): items, times, command `reconnect`. Throws Error.
    void populateLink() {
        items_.populate(*this);
        machine_.populate(LinkSettings::of(*this, this->period()));
        this->loseAfter(machine_.settings().lossTime);
        this->staleAfter(3 * std::max(settings().between(this->period()), this->period()));
        this->template on<&FieldbusDevice::reconnect>("reconnect");
    }
    // In populate(): work that a hook may begin, done on the thread between two exchanges.
    cs::SlowWork atDevice(std::function<void()> work) {
        return Exchange::atDevice(machine_.guarded(std::move(work)));
    }
    const LinkSettings& settings() const { return machine_.settings(); }
    // In hooks: of this cycle. isLost() says whether there is a present answer.
    Link link() const CORTEX_REALTIME { return report_.link; }

private:
    Outcome reconnect(Call&) CORTEX_REALTIME {
        machine_.reconnect();
        return Outcome::Done;
    }
    void valuesTaken(const Tick&, bool isNew) CORTEX_REALTIME final {
        report_ = machine_.report();
        items_.write(report_, this->age());
        if (isNew) unpack(this->received());
    }
    void loopEnd(const Tick&) CORTEX_REALTIME final {
        LinkDemand<Out> demand;
        quiet(demand.quiet);
        if (this->inputLost() || this->state() == State::Fault)
            demand.wanted = demand.quiet;
        else
            pack(demand.wanted);
        this->give(demand);
    }

    void communicate(Line& line) final {
        line_ = &line;
        machine_.run(*this);
    }
    bool hasDemand() final { return line_->demand() != nullptr; }
    void exchangeNewest() final {
        const LinkDemand<Out>& newest = *line_->demand();
        const bool hangs = line_->loopHangs(2 * settings().lossTime);
        answer_ = In{};
        asked_ = cs::Pace::Clock::now();
        exchange(hangs ? newest.quiet : newest.wanted, answer_);
    }
    void putAnswer() final { line_->put(answer_, asked_); }
    void lose(std::string_view why) final { line_->lose(why); }
    void doWork() final { line_->doWork(); }
    bool waitUntil(cs::Pace::Clock::time_point time) final { return line_->waitUntil(time); }
    cs::Pace pace() final { return line_->pace(); }

    LinkMachine machine_;
    LinkItems items_;
    LinkReport report_;
    Line* line_ = nullptr;  // the thread's, as are the next two
    In answer_{};
    cs::Pace::Clock::time_point asked_{};  // no answer is older
};

}  // namespace cortex::toolkit
