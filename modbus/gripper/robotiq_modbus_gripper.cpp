// SPDX-License-Identifier: Apache-2.0
#include "gripper/robotiq_modbus_gripper.hpp"

#include "cortex/core/error.hpp"

#include "gripper/robotiq_faults.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>

namespace cortex::modbus {
namespace {

using toolkit::LinkError;
using toolkit::LinkRefused;

constexpr std::chrono::milliseconds timeToAsk{400};  // for what is no exchange
constexpr int mostLooks = 20;                        // at a reset that was asked for
constexpr double slowestMotion = 1e-4;               // m/s, of a demand that moves
constexpr int nearness = 1;                          // octets of POSITION
constexpr double near = 0.001;                       // m, between a demand and the fingers
constexpr double patience = 1;                       // s, until it tells that it waits
constexpr double fasterThanDemand = 1.25;            // so that it keeps up with one that moves
constexpr double ampere = 0.01;                      // of CURRENT
constexpr std::int64_t notActivated = 16;            // fault code; those below are gFLT

// Numbers of labels of the item `status` in ontology/robotics.xml.
constexpr std::int64_t ready = 1, moving = 2, faulty = 4, disabled = 6;

bool isActivated(const RobotiqStatus& status) {
    return status.active && status.activation == RobotiqActivation::Activated;
}

}  // namespace

void RobotiqModbusGripper::populate() {
    populateModbus();
    scale_.stroke = data<const double>("stroke");
    scale_.open = static_cast<double>(data<const std::int64_t>("octetOpen").get());
    scale_.closed = static_cast<double>(data<const std::int64_t>("octetClosed").get());
    if (scale_.open >= scale_.closed)
        throw Error(path() + ": octetOpen is " + toText(scale_.open) + " and octetClosed " +
                    toText(scale_.closed) +
                    ", but the gripper counts upwards as it closes; write less and more");
    populateItems();
    activating_ = atDevice([this] { activate(); });
}

void RobotiqModbusGripper::populateItems() {
    const InputSimplex demand = input("demands");
    demandSlot_ = &demand.state();
    wishedWidth_ = demand.data<double>("position");
    wishedSpeed_ = demand.data<double>("velocity");
    wishedForce_ = demand.data<double>("effort");
    const OutputSimplex opening = output("opening"), status = output("status");
    position_ = opening.data<double>("position");
    velocity_ = opening.data<double>("velocity");
    status_ = opening.data<std::int64_t>("status");
    object_ = status.data<std::int64_t>("object");
    current_ = status.data<double>("current");
    activation_ = data<std::int64_t>("activation");
    gripperFault_ = data<std::int64_t>("gripperFault");
}

// --- on the thread ----------------------------------------------------------------------------

RobotiqStatus RobotiqModbusGripper::read(ModbusClient& client) {
    RobotiqImage image{};
    client.readInputRegisters(RobotiqMap::status, image);
    const RobotiqStatus status = decodeStatus(image);
    if (static_cast<int>(status.activation) != 2) return status;
    throw LinkRefused(client.settings().server.text() +
                      ": it is no 2F-85, as it says gSTA 2 in register 2000; look at its address "
                      "and at the item unit");
}

void RobotiqModbusGripper::identify(ModbusClient& client) {
    client.allow(timeToAsk);
    read(client);
}

// One that is not activated is told nothing: rACT would activate it, and move its fingers. So the
// register that holds it is written only until the gripper goes where it is told: one that lost its
// power since it was read stays without.
void RobotiqModbusGripper::talk(ModbusClient& client, const RobotiqDemand& demand,
                                RobotiqAnswer& answer) {
    answer.time = std::chrono::nanoseconds{cs::Pace::Clock::now().time_since_epoch()}.count();
    answer.activations = activations_;
    answer.status = read(client);
    if (!demand.isWished || !isActivated(answer.status)) return;
    const RobotiqImage image = encode(demand.request);
    const std::uint16_t first = answer.status.goesTo == demand.request.goTo ? 1 : 0;
    client.writeRegisters(RobotiqMap::request + first, std::span{image}.subspan(first));
}

// Only a rising edge of rACT activates.
void RobotiqModbusGripper::activate() {
    client().allow(timeToAsk);
    const RobotiqStatus before = read(client());
    const bool hasFailed = before.fault != 0 && robotiqFault(before.fault).needsReset;
    if (!isActivated(before) || hasFailed) {
        client().writeRegisters(RobotiqMap::request, encode(RobotiqRequest{}));
        int looks = 0;
        while (read(client()).activation != RobotiqActivation::Reset)
            if (++looks == mostLooks)
                throw LinkError(client().settings().server.text() +
                                ": it does not reset when it is told so (rACT 0); look whether "
                                "another program commands it");
        client().writeRegisters(RobotiqMap::request, encode(RobotiqRequest{.activate = true}));
    }
    ++activations_;
}

// --- in the tick ------------------------------------------------------------------------------

bool RobotiqModbusGripper::stateStartingUp(const Tick& tick) {
    if (isLost() || activating_.isRunning()) return false;
    if (!isAsked_ || !activating_.failure().empty()) {
        activationsSeen_ = received().activations;
        isAsked_ = activating_.begin();
        return false;
    }
    const RobotiqStatus& status = received().status;
    if (received().activations == activationsSeen_) return false;  // an answer of before
    if (failsBy(status)) return false;
    if (!isActivated(status) || waitsForDemand(tick.elapsedSeconds())) return false;
    return status_ != disabled;  // that it follows has been told
}

double RobotiqModbusGripper::demandAway() const {
    if (std::abs(wishedSpeed_) > slowestMotion) return std::numeric_limits<double>::infinity();
    return std::abs(wishedWidth_ - position_);
}

// As drives do: it does not begin while the demand is elsewhere.
bool RobotiqModbusGripper::waitsForDemand(double seconds) {
    const double away = demandAway();
    const bool waits = away > near, tells = waits && waited_ < patience;
    waited_ = waits ? waited_ + seconds : 0;
    if (!tells || waited_ < patience) return waits;
    EventText text{"it waits for its demand, which "};
    if (std::isfinite(away))
        text << "is " << away << " m away";
    else
        text << "moves";
    event(Severity::Warning, text << "; start the controller that leads it to the fingers");
    return waits;
}

void RobotiqModbusGripper::stateActive(const Tick&) {
    isAsked_ = false;
    if (isLost() || failsBy(received().status) || isActivated(received().status)) return;
    fault(notActivated,
          "the gripper is not activated any more: it had no power, or another program reset it; a "
          "startup moves its fingers");
}

bool RobotiqModbusGripper::failsBy(const RobotiqStatus& status) {
    const RobotiqFault complaint = robotiqFault(status.fault);
    if (status.fault == 0 || !complaint.stops) return false;
    fault(status.fault, (EventText{"the gripper says: "} << complaint.words).view());
    return true;
}

// It keeps what it holds. It comes before pack(): a demand that was lost, or began anew, may be
// anywhere when it is back.
void RobotiqModbusGripper::quiet(RobotiqDemand&) { hasJoined_ = hasJoined_ && !inputLost(); }

void RobotiqModbusGripper::pack(RobotiqDemand& demand) {
    isWished_ = false;
    const bool isActive = state() == State::Active;
    hasJoined_ = !isLost() && isActivated(received().status) &&
                 (demandAway() <= near || (hasJoined_ && isActive));
    isLed_ = isLed_ && isActive;
    if (!isActive) return;
    const double speed = std::abs(wishedSpeed_);
    const bool wasMoving = std::exchange(isMoving_, speed > slowestMotion);
    const std::uint8_t position = scale_.position(wishedWidth_);
    const bool isGood = demandSlot_->quality == Quality::Good;
    isLed_ = isLed_ || isGood;
    if (!hasJoined_ || !isLed_ || letsStand(position)) return;
    last_.activate = last_.goTo = true;
    last_.position = position;
    // As fast as this motion has been, so that its end is not the slowest part of the way.
    if (isMoving_) {
        const std::uint8_t enough = RobotiqScale::speed(fasterThanDemand * speed);
        last_.speed = wasMoving ? std::max(enough, last_.speed) : enough;
    }
    // A controller that is not Active asks for no force, and lets go of nothing by that.
    if (isGood) last_.force = RobotiqScale::force(wishedForce_);
    demand = {last_, isWished_ = true};
    object_ = objectOf(received().status);  // also before the next answer
}

// Fingers that press on something stand where it is and not where they were told. So a demand that
// was led to them, as after a loss or a start, is no wish to press no more.
bool RobotiqModbusGripper::letsStand(std::uint8_t position) const {
    const RobotiqStatus& status = received().status;
    const int ahead = status.positionEcho - status.position, wished = position - status.position;
    if (isLost() || std::abs(wished) > nearness) return false;
    return (status.object == RobotiqObject::StoppedClosing && ahead > nearness) ||
           (status.object == RobotiqObject::StoppedOpening && ahead < -nearness);
}

void RobotiqModbusGripper::unpack(const RobotiqAnswer& answer) {
    const RobotiqStatus& status = answer.status;
    activation_ = static_cast<std::int64_t>(status.activation);
    gripperFault_ = status.fault;
    if (status.fault != 0 && status.fault != toldFault_)
        event(Severity::Warning,
              EventText{"the gripper says: "} << robotiqFault(status.fault).words);
    toldFault_ = status.fault;
    const double width = std::clamp(scale_.width(status.position), 0.0, scale_.stroke);
    position_ = width;
    velocity_ = speedTo({width, answer.time});
    status_ = axisStatus(status);
    object_ = objectOf(status);
    current_ = status.current * ampere;
}

// Over the last answers, as one octet is much in the time of one exchange.
double RobotiqModbusGripper::speedTo(const Place& place) {
    const Place before = places_.front();
    std::shift_left(places_.begin(), places_.end(), 1);
    places_.back() = place;
    if (before.time == 0 || place.time <= before.time) return 0;
    return (place.width - before.width) / (static_cast<double>(place.time - before.time) * 1e-9);
}

// Controllers lead their demands to an axis that obeys nobody.
std::int64_t RobotiqModbusGripper::axisStatus(const RobotiqStatus& status) const {
    if (status.fault != 0 && robotiqFault(status.fault).stops) return faulty;
    const bool isOn = state() == State::Active || state() == State::StartingUp;
    if (!isOn || !hasJoined_ || !isActivated(status)) return disabled;
    return status.object == RobotiqObject::Moving && status.goesTo ? moving : ready;
}

// The gripper speaks of the position that it was told; of another one that is under way it cannot
// say more than that what is in the way still is.
std::int64_t RobotiqModbusGripper::objectOf(const RobotiqStatus& status) const {
    const auto object = static_cast<std::int64_t>(status.object);
    if (!isWished_ || last_.position == status.positionEcho) return object;
    const bool closesOn = last_.position > status.positionEcho;
    const bool stays =
        status.object == (closesOn ? RobotiqObject::StoppedClosing : RobotiqObject::StoppedOpening);
    return stays ? object : static_cast<std::int64_t>(RobotiqObject::Moving);
}

void RobotiqModbusGripper::keep(Archive& archive) {
    archive.version("RobotiqModbusGripper", 2);
    for (Place& place : places_) archive & place;
    archive & last_.activate & last_.goTo & last_.position & last_.speed & last_.force;
    archive & activationsSeen_ & toldFault_ & isAsked_ & hasJoined_ & isLed_ & waited_ & isMoving_ &
        isWished_;
}

}  // namespace cortex::modbus
