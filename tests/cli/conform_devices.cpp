// SPDX-License-Identifier: Apache-2.0
#include "cli/conform_devices.hpp"

#include "cortex/cs/simplex_cs.hpp"
#include "cortex/toolkit/fieldbus_link.hpp"

#include <optional>

namespace cortex::test {
namespace {

using toolkit::Link;

constexpr std::int64_t ready = 1, braked = 7;  // labels of `status`
// As the drive tells that it is in Switch on disabled.
constexpr std::int64_t switchOnDisabled = 2, switchOnDisabledWord = 0x0250;

class ScriptedAxis final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    enum Mistake { None, WrongSign, BeyondRange, Degrees, RunsOn, NoBrake, NoVelocity };

    void populate() override {
        mistake_ = data<const std::int64_t>("mistake");
        demand_ = input("demands").data<double>("position");
        demandState_ = input("demands");
        observed_ = output("observations").data<double>("position");
        velocity_ = output("observations").data<double>("velocity");
        status_ = output("observations").data<std::int64_t>("status");
    }
    void loopEnd(const Tick& tick) override {
        const double before = place_;
        if (state() == State::Active) place_ = follow(before, tick.elapsedSeconds());
        velocity_ = mistake_ == NoVelocity ? 0 : (place_ - before) / tick.elapsedSeconds();
        observed_ = place_;
        // On its way, near the end of the range.
        if (mistake_ == BeyondRange && place_ > 0.33 && place_ < 0.38) observed_ = 0.51;
        const bool isOn = state() != State::Active && mistake_ != NoBrake;
        status_ = isOn ? braked : ready;
    }
    double follow(double before, double seconds) {
        constexpr double degrees = 57.29577951308232;
        switch (mistake_) {
            case WrongSign:
                return -demand_;
            case Degrees:
                return degrees * demand_;
            case RunsOn:  // while nobody speaks for the demand
                if (demandState_->state().quality != Quality::Good)
                    return before + (velocity_ > 0 ? 0.2 * seconds : 0);
                return demand_;
            default:
                return demand_;
        }
    }

    std::int64_t mistake_ = 0;
    double place_ = 0;
    Data<const double> demand_;
    std::optional<InputSimplex> demandState_;
    Data<double> observed_, velocity_;
    Data<std::int64_t> status_;
};

// It exchanges in each cycle. reconnect() closes its link for some cycles.
class ScriptedBus final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    enum Mistake {
        None,
        AgeFalls,
        CounterJumps,
        CounterFalls,
        FreshStamp,
        FutureStamp,
        MissesUncounted,
        CountsTwice,
        NeverAnswers,
        SaysClosed,
        IsCut
    };

    void populate() override {
        mistake_ = data<const std::int64_t>("mistake");
        items_.populate(*this);
        on<&ScriptedBus::reconnect>("reconnect");
    }
    void loopEnd(const Tick& tick) override {
        if (mistake_ == NeverAnswers || (mistake_ == IsCut && report_.exchanges > 0))
            closedFor_ = 2;
        const bool closed = closedFor_ > 0;
        report_.link = closed ? Link::Closed : Link::Open;
        if (closed && --closedFor_ == 0) report_.reconnects += mistake_ == CountsTwice ? 2 : 1;
        if (!closed) exchange(tick);
        std::int64_t age = tick.nominalTime - answered_;
        if (mistake_ == AgeFalls && closed) age = closedFor_ * 5'000'000;
        if (mistake_ == SaysClosed && isShut(tick)) report_.link = Link::Closed;
        items_.write(report_, age);
        std::int64_t stamp = answered_;
        if (mistake_ == FreshStamp) stamp = tick.nominalTime;
        if (mistake_ == FutureStamp) stamp += 1'000'000'000;
        setQuality(closed ? Quality::Lost : Quality::Good, stamp);
    }
    void exchange(const Tick& tick) {
        answered_ = tick.nominalTime;
        const bool misses = mistake_ == MissesUncounted && tick.cycle % 3 == 0;
        report_.exchanges += misses ? 0 : 1;
        if (tick.cycle % cyclesPerSecond != 0) return;
        if (mistake_ == CounterJumps) report_.exchanges += 1000;
        if (mistake_ == CounterFalls) report_.exchanges -= 5;
    }
    static bool isShut(const Tick& tick) { return tick.cycle % cyclesPerSecond >= 50; }
    cortex::Outcome reconnect(Call&) {
        closedFor_ = 20;
        return cortex::Outcome::Done;
    }

    static constexpr std::int64_t cyclesPerSecond = 100;
    std::int64_t mistake_ = 0, answered_ = 0, closedFor_ = 0;
    toolkit::LinkItems items_;
    toolkit::LinkReport report_;
};

class UnstatedDevice final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    bool stateStartingUp(const Tick&) override {
        fault(7, "no power");
        return false;
    }
    void loopEnd(const Tick&) override { setQuality(Quality::Lost); }
};

class MuteDrive final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override {
        state_ = output("observations").data<std::int64_t>("driveState");
        word_ = output("observations").data<std::int64_t>("statusWord");
        items_.populate(*this);
        on<&MuteDrive::reconnect>("reconnect");
        report_.link = Link::Open;
    }
    void loopEnd(const Tick&) override {
        state_ = switchOnDisabled;
        word_ = switchOnDisabledWord;
        ++report_.exchanges;
        items_.write(report_, 0);
    }

    cortex::Outcome reconnect(Call&) {
        ++report_.reconnects;
        return cortex::Outcome::Done;
    }

    Data<std::int64_t> state_, word_;
    toolkit::LinkItems items_;
    toolkit::LinkReport report_;
};

}  // namespace

void addConformDevices(ClassRegistry& registry) {
    registry.add<ScriptedAxis>("ScriptedAxis");
    registry.add<ScriptedBus>("ScriptedBus");
    registry.add<UnstatedDevice>("UnstatedDevice");
    registry.add<MuteDrive>("MuteDrive");
}

}  // namespace cortex::test
