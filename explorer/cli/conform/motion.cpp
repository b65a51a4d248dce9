// SPDX-License-Identifier: Apache-2.0
#include "conform/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cortex::cli::conform {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double legTime = 1;           // s, about, for the amplitude
constexpr double settleTime = 2;        // s
constexpr double restTime = 0.2;        // s without motion is rest
constexpr double brakedTime = 0.5;      // s that are looked at with the brake on
constexpr double leastShare = 0.01;     // of the greatest speed, as moveTo takes it
constexpr double lossShare = 0.3;       // of the amplitude, where its controller is shut down
constexpr std::int64_t running = 2;     // label of `outcome`
constexpr std::int64_t byPosition = 1;  // label of `mode` of a JogController
constexpr std::int64_t stoppedOpening = 1, stoppedClosing = 2;  // labels of `object`
constexpr std::int64_t disabled = 6, braked = 7;                // labels of `status`

double boundOf(const std::optional<Number>& bound, double otherwise) {
    if (!bound) return otherwise;
    return std::visit([](auto number) { return static_cast<double>(number); }, *bound);
}

class Motion {
public:
    Motion(Bench& bench, const AxisPair& axis)
        : bench_{bench}, plant_{bench.plant()}, axis_{axis}, bounds_{boundsOf(demandType())} {}

    ~Motion() { bench_.recording().follow({}); }
    Motion(const Motion&) = delete;
    Motion& operator=(const Motion&) = delete;

    Trial run() {
        try {
            prepare();
            begin();
            toAndFro();
            loseDemand();
            brake();
        } catch (const Ended& ended) {
            trial_.ended = ended.judgement;
        }
        bench_.recording().follow({});
        return std::move(trial_);
    }

private:
    const Type& demandType() const { return plant_.type(axis_.demand); }
    double observed() const { return bench_.now().at(axis_.observation, "position"); }
    const std::string& axisPath() const { return plant_.path(axis_.observation); }

    void prepare();
    Mover mover() const;
    void checkRange() const;
    void begin();
    void bringDevice(State state);
    comms::CommandAnswer send(double target, const std::function<bool()>& goesOn);
    bool isSafe() const;
    bool holdsSomething() const {
        const std::int64_t object = bench_.now().count(mover_.controller, "object");
        return object == stoppedOpening || object == stoppedClosing;
    }
    void move(double target);
    void toAndFro();
    void loseDemand();
    void brake();

    Bench& bench_;
    const Plant& plant_;
    const AxisPair axis_;
    const AxisBounds bounds_;
    Mover mover_;
    double start_ = 0, share_ = 0, patience_ = 0;
    Trial trial_;
};

Mover Motion::mover() const {
    const std::string& demand = plant_.path(axis_.demand);
    if (plant_.info(axis_.demand).remote)
        throw Ended{skipped(demand + " belongs to another agent, so nothing here moves it")};
    const std::vector<Mover> movers = plant_.movers(axis_);
    const auto isIt = [](std::uint32_t writer) {
        return [=](const Mover& each) { return each.controller == writer; };
    };
    for (const std::uint32_t writer : plant_.info(axis_.demand).writers) {
        if (bench_.now().stateOf(writer) == State::Standby) continue;
        const auto found = std::ranges::find_if(movers, isIt(writer));
        if (found != movers.end() && bench_.now().stateOf(writer) == State::Active) return *found;
        throw Ended{skipped(plant_.path(writer) + " writes " + demand + " and is in " +
                            stateText(bench_.now(), writer) + "; shut it down first")};
    }
    if (movers.empty()) {
        throw Ended{skipped("no AxisPoseController, JogController or GripperController of agent " +
                            plant_.agent + " writes " + demand +
                            "; relate one to it under its rule demands")};
    }
    return movers.front();
}

void Motion::checkRange() const {
    for (const double target : {start_ + trial_.amplitude, start_ - trial_.amplitude}) {
        if (target >= bounds_.least && target <= bounds_.most) continue;
        throw Ended{skipped(axisPath() + " is at " + numberText(start_) + ", and " +
                            numberText(target) + " is outside of the range " +
                            numberText(bounds_.least) + " to " + numberText(bounds_.most) +
                            " of its demand; give a smaller amplitude, or bring it elsewhere")};
    }
}

void Motion::prepare() {
    trial_.amplitude = bench_.wishes().move.value_or(0);
    trial_.near = trial_.amplitude / 20;
    const DataItem* position = demandType().findData("position");
    trial_.unit = position != nullptr ? position->unit : "";
    bench_.needGood(axis_.observation);
    mover_ = mover();
    trial_.controller = plant_.path(mover_.controller);
    if (bench_.now().count(mover_.controller, "outcome") == running)
        throw Ended{skipped(trial_.controller + " runs a command of somebody else")};
    if (mover_.kind == Mover::Grips && holdsSomething()) {
        throw Ended{skipped(trial_.controller +
                            " holds something, which would fall; take it out, and run this again")};
    }
    if (!std::isfinite(bounds_.speed)) {
        throw Ended{skipped(demandType().name +
                            " states no greatest speed (max of velocity, or rate of position), so "
                            "nobody can say what is slow")};
    }
    const bool needsHome = bench_.constant(axis_.observation, "homingNeeded") != 0;
    if (needsHome && bench_.now().at(axis_.observation, "homed") == 0)
        throw Ended{skipped(axisPath() + " is not homed; --home lets it look for its zero before")};
    start_ = observed();
    checkRange();
    share_ = std::clamp(trial_.amplitude / legTime / bounds_.speed, leastShare,
                        std::max(leastShare, bench_.wishes().speed));
    patience_ = 3 * trial_.amplitude / (share_ * bounds_.speed);
}

void Motion::bringDevice(State state) {
    if (plant_.processor) bench_.bring(*plant_.processor, state);
    bench_.bring(plant_.device, state);
}

// How far the demand is from the axis in the cycle in which power comes on.
void Motion::begin() {
    const std::uint32_t last = plant_.processor ? *plant_.processor : plant_.device;
    const bool wasActive = bench_.now().stateOf(last) == State::Active;
    bench_.bring(mover_.controller, State::Active);
    std::optional<double> gap;
    bench_.recording().follow([&, last](const Sample& each) {
        if (gap || each.stateOf(last) != State::Active) return;
        gap = each.at(axis_.demand, "position") - each.at(axis_.observation, "position");
    });
    const auto stop = [&] { bench_.recording().follow({}); };
    try {
        bringDevice(State::Active);
    } catch (...) {
        stop();
        throw;
    }
    stop();
    if (!wasActive) trial_.startGap = gap;
}

// Of a controller of several axes the others stay where they are wished to be.
comms::CommandAnswer Motion::send(double target, const std::function<bool()>& goesOn) {
    const std::uint32_t controller = mover_.controller;
    if (mover_.kind == Mover::Grips) {
        return bench_.call(controller, "moveTo",
                           {{"width", target}, {"speed", share_ * bounds_.speed}}, patience_,
                           goesOn);
    }
    const bool jogs = mover_.kind == Mover::Jogs;
    const char* item = jogs ? "demandPosition" : "pose";
    auto places = std::get<std::vector<double>>(bench_.value(controller, item).value());
    const auto demands = plant_.related(controller, "demands");
    for (std::size_t i = 0; i < std::min(places.size(), demands.size()); ++i) {
        places[i] = bench_.now().at(demands[i], "position");
    }
    places.at(mover_.place) = target;
    bench_.set(controller, item, places);
    if (!jogs)
        return bench_.call(controller, "moveTo", {{"speedShare", share_}}, patience_, goesOn);
    bench_.set(controller, "speedShare", std::vector<double>{share_});
    const std::int64_t mode = bench_.now().count(controller, "mode");
    if (mode != byPosition) {
        bench_.call(controller, "setMode", {{"mode", byPosition}});
        bench_.undoLater(
            [=, &bench = bench_] { bench.quietly(controller, "setMode", {{"mode", mode}}); });
    }
    const auto axis = static_cast<std::int64_t>(mover_.place + 1);
    return bench_.call(controller, "go", {{"axis", axis}}, patience_, goesOn);
}

bool Motion::isSafe() const {
    return std::abs(observed() - start_) <= 2 * trial_.amplitude + trial_.near;
}

void Motion::move(double target) {
    Trial::Leg leg{.from = observed(), .to = target, .answer = {}};
    const comms::CommandAnswer answer = send(target, [this] { return isSafe(); });
    if (!isSafe()) {
        bench_.quietly(mover_.controller, "shutdown");
        bench_.quietly(plant_.device, "shutdown");
        throw Ended{failed(axisPath() + " was stopped at " + numberText(observed()) +
                           ": it went more than twice the amplitude away from " +
                           numberText(start_) + "; look at the unit and the direction")};
    }
    if (!answer.done()) leg.answer = answer.text() + bench_.faultText(plant_.device);
    leg.arrived = bench_.recording().becomes(
        [&](const Sample& each) {
            return std::abs(each.at(axis_.observation, "position") - target) <= trial_.near;
        },
        settleTime);
    leg.reached = observed();
    trial_.legs.push_back(leg);
}

void Motion::toAndFro() {
    bench_.undoLater(
        [&bench = bench_, controller = mover_.controller] { bench.quietly(controller, "cancel"); });
    bench_.recording().follow([this](const Sample& each) {
        trial_.points.push_back({each.seconds(), each.at(axis_.demand, "position"),
                                 each.at(axis_.observation, "position"),
                                 each.at(axis_.observation, "velocity"),
                                 each.at(axis_.observation, "acceleration")});
    });
    move(start_ + trial_.amplitude);
    if (!trial_.legs.back().arrived) {
        move(start_);
        throw Ended{
            failed("after the first motion the axis was not where it was wished to be, so "
                   "it was not moved any further")};
    }
    move(start_ - trial_.amplitude);
    move(start_);
    bench_.recording().follow({});
}

void Motion::loseDemand() {
    Trial::Loss loss{.begin = observed(), .target = start_ + trial_.amplitude};
    const comms::CommandAnswer answer = send(loss.target, [&] {
        return std::abs(observed() - loss.begin) < lossShare * trial_.amplitude;
    });
    if (answer.outcome == Outcome::Unknown) {
        loss.at = observed();
        const double then = bench_.now().seconds();
        bench_.bring(mover_.controller, State::Standby);
        double place = observed(), since = bench_.now().seconds();
        loss.came = bench_.recording().becomes(
            [&](const Sample& each) {
                const double now = each.at(axis_.observation, "position");
                if (std::abs(now - place) > trial_.near / 10) {
                    place = now;
                    since = each.seconds();
                }
                return each.seconds() - since >= restTime;
            },
            settleTime);
        loss.rest = observed();
        loss.seconds = since - then;
        trial_.loss = loss;
        bench_.bring(mover_.controller, State::Active);
    }
    move(start_);
}

void Motion::brake() {
    if (bench_.found(plant_.device) != State::Standby) return;
    bringDevice(State::Standby);
    const double before = observed();
    bench_.recording().pass(brakedTime);
    const std::int64_t status = bench_.now().count(axis_.observation, "status");
    trial_.brake =
        Trial::Brake{bench_.label(axis_.observation, "status", status),
                     status == braked || status == disabled, std::abs(observed() - before)};
}

}  // namespace

AxisBounds boundsOf(const Type& demand) {
    const DataItem* position = demand.findData("position");
    const DataItem* velocity = demand.findData("velocity");
    AxisBounds bounds{-infinity, infinity, infinity};
    if (position != nullptr) {
        bounds.least = boundOf(position->min, -infinity);
        bounds.most = boundOf(position->max, infinity);
        bounds.speed = position->rate.value_or(infinity);
    }
    if (velocity != nullptr)
        bounds.speed = std::min(bounds.speed, boundOf(velocity->max, infinity));
    return bounds;
}

const Trial& trialOf(Bench& bench, const AxisPair& axis) {
    auto& trial = bench.trials[axis.place];
    if (!trial) trial = std::make_shared<const Trial>(Motion{bench, axis}.run());
    return *trial;
}

}  // namespace cortex::cli::conform
