// SPDX-License-Identifier: Apache-2.0
#include "cortex/drives/ds402_drive.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::drives {
namespace {

constexpr std::uint16_t commandBits = 0x008F;
constexpr double standstill = 1e-3;      // of the axis' unit per s
constexpr double standstillTime = 0.01;  // s
constexpr double stopPatience = 1;       // s, with an axis that does not stand after its ramp
constexpr double warmAt = 70, hotAt = 90, coolAt = 80;  // Cel
constexpr double ambient = 25, heating = 40;            // Cel, at rated effort
constexpr double thermalTime = 60;                      // s

// Words that ask for what is there already.
bool isThere(Ds402State state, Ds402Command command) {
    using enum Ds402State;
    switch (command) {
        case Ds402Command::Shutdown:
            return state == ReadyToSwitchOn;
        case Ds402Command::SwitchOn:
            return state == SwitchedOn;
        case Ds402Command::EnableOperation:
            return state == OperationEnabled;
        case Ds402Command::QuickStop:
            return state == QuickStopActive || state == SwitchOnDisabled ||
                   state == FaultReactionActive || state == Fault;
        case Ds402Command::DisableVoltage:
            return state == SwitchOnDisabled || state == FaultReactionActive || state == Fault;
        default:
            return false;
    }
}

Ds402State endOf(int number) {
    for (const Ds402Transition& row : ds402Transitions)
        if (row.number == number) return row.to;
    return Ds402State::Unknown;
}

}  // namespace

Ds402Drive::Ds402Drive(const Ds402Axis& axis, const Ds402Parameters& parameters) noexcept
    : axis_{isValid(axis) ? axis : Ds402Axis{}},
      parameters_{isValid(parameters) ? parameters : Ds402Parameters{}} {
    motor_.position = axis_.startPosition;
    reference_.position = profile_.target = axis_.startPosition;
    out_.homed = axis_.absoluteEncoder;
    tell();
}

bool Ds402Drive::set(const Ds402Parameters& parameters) noexcept {
    if (!isValid(parameters)) return false;
    parameters_ = parameters;
    return true;
}

void Ds402Drive::step(const Ds402Inputs& inputs, double seconds) noexcept {
    if (!(seconds > 0)) return;
    rest_ += std::min(seconds, longestStep);
    while (rest_ >= timeStep * (1 - 1e-6)) {
        rest_ -= timeStep;
        tick(inputs);
    }
    rest_ = std::max(rest_, 0.0);
    tell();
}

void Ds402Drive::tick(const Ds402Inputs& in) noexcept {
    const bool newMode = in.mode != in_.mode;
    limited_ = false;
    obey(in.controlWord);
    chooseMode(in.mode, newMode);
    takeTargets(in);
    goOn();
    const double effort = wishedEffort();
    moveBrake();
    move(effort);
    supervise();
}

void Ds402Drive::obey(std::uint16_t word) noexcept {
    const bool isNew = ((word ^ in_.controlWord) & commandBits) != 0;
    const bool reset = isFaultReset(in_.controlWord, word);
    brake_.wanted = !torque_;
    if (isNew) spent_ = false;
    if (state_ == Ds402State::NotReadyToSwitchOn || spent_) return;
    const Ds402Command command = reset ? Ds402Command::FaultReset : commandOf(word);
    const Ds402Transition* next = transitionOf(state_, command, parameters_.quickStopOption);
    if (next && next->number == 15 && causeStands()) next = nullptr;
    if (!next && isNew && !isThere(state_, command)) ++out_.refused;
    if (!next) return;
    const bool onRamp = (next->number == 5 && parameters_.disableOption == 1) ||
                        (next->number == 8 && parameters_.shutdownOption == 1);
    if (!onRamp || stopped()) go(next->number);
}

// Whether the power may go off: the axis stands and its brake holds. Closes the brake.
bool Ds402Drive::stopped() noexcept {
    if (!torque_) return true;
    if (!reference_.stopping) return false;
    if (!stands() && reference_.settling < stopPatience) return false;
    brake_.wanted = true;
    return brake_.holds;
}

// Transitions that nobody asks for.
void Ds402Drive::goOn() noexcept {
    using enum Ds402State;
    if (state_ == NotReadyToSwitchOn) selfTest_ += timeStep;
    if (state_ == NotReadyToSwitchOn && selfTest_ >= axis_.selfTestTime) go(1);
    if (state_ == QuickStopActive && parameters_.quickStopOption <= 4 && stopped()) go(12);
    if (state_ == FaultReactionActive && stopped()) go(14);
    const bool faulty = state_ == FaultReactionActive || state_ == Fault;
    if (!faulty && pending_ == 0) pending_ = cause_;
    if (!faulty && pending_ != 0) {
        out_.errorCode = pending_;
        go(13);
    }
    pending_ = 0;
}

void Ds402Drive::go(int number) noexcept {
    state_ = endOf(number);
    out_.lastTransition = number;
    ++out_.transitions;
    const bool wasOn = torque_;
    const bool keeps = (number == 11 && parameters_.quickStopOption != 0) ||
                       (number == 13 && parameters_.faultReactionOption != 0) || number == 16;
    torque_ = number == 4 || (keeps && wasOn);
    brake_.wanted = !torque_;
    reference_.stopping = false;
    if (number == 15) out_.errorCode = 0;
    if (number != 4 && number != 16) return;
    reference_ = {motor_.position, 0, 0, false};
    profile_ = {motor_.position, motor_.position, false, false};
    homing_.phase = Homing::Phase::Idle;
    if (number == 4) motor_.integral = 0;
    strayed_ = 0;
}

double Ds402Drive::deceleration() const noexcept {
    const Ds402Parameters& p = parameters_;
    bool quick = false;
    if (state_ == Ds402State::QuickStopActive)
        quick = p.quickStopOption != 1 && p.quickStopOption != 5;
    else if (state_ == Ds402State::FaultReactionActive)
        quick = p.faultReactionOption != 1;
    else if (halted())
        quick = p.haltOption == 2;
    return quick ? p.quickStopDeceleration : p.profileAcceleration;
}

bool Ds402Drive::halted() const noexcept { return (in_.controlWord & Ds402Control::halt) != 0; }

bool Ds402Drive::stands() const noexcept { return standing_ >= standstillTime; }

// Targets lead the servo: the brake is open, and nothing asks for a stop.
bool Ds402Drive::isObeying() const noexcept {
    return state_ == Ds402State::OperationEnabled && torque_ && !brake_.holds && !brake_.wanted &&
           (spent_ || commandOf(in_.controlWord) == Ds402Command::EnableOperation ||
            commandOf(in_.controlWord) == Ds402Command::None) &&
           !halted();
}

void Ds402Drive::chooseMode(int wished, bool isNew) noexcept {
    if (wished == 0 || wished == out_.modeDisplay) return;
    const bool known = isBuilt(wished) && (parameters_.supportedModes & supportedBit(wished)) != 0;
    const bool still = !torque_ || (state_ == Ds402State::OperationEnabled && stands());
    if (!known || !still) {
        if (isNew) ++out_.refused;
        return;
    }
    out_.modeDisplay = static_cast<std::int8_t>(wished);
    reference_ = {motor_.position, 0, 0, false};
    profile_ = {motor_.position, motor_.position, false, false};
    homing_.phase = Homing::Phase::Idle;
    strayed_ = 0;
}

bool Ds402Drive::causeStands() const noexcept {
    return cause_ != 0 || (out_.errorCode == 0x4310 && temperature_ > coolAt);
}

void Ds402Drive::supervise() noexcept {
    standing_ = std::abs(motor_.velocity) < standstill ? std::min(standing_ + timeStep, 1.0) : 0;
    const double share = motor_.effort / parameters_.ratedEffort;
    temperature_ += (ambient + heating * share * share - temperature_) * (timeStep / thermalTime);
    if (temperature_ > hotAt) pending_ = 0x4310;
    const bool positions = torque_ && (reference_.stopping || mode() == Ds402Mode::CyclicPosition ||
                                       mode() == Ds402Mode::ProfilePosition);
    out_.followingError = positions ? reference_.position - motor_.position : 0;
    const bool watched = state_ == Ds402State::OperationEnabled && !reference_.stopping &&
                         parameters_.followingErrorWindow > 0;
    const bool strays = watched && std::abs(out_.followingError) > parameters_.followingErrorWindow;
    strayed_ = strays ? strayed_ + timeStep : 0;
    if (strays && strayed_ > parameters_.followingErrorTime) pending_ = 0x8611;
}

// Bits 10, 12 and 13.
std::uint16_t Ds402Drive::modeBits() const noexcept {
    using Bits = Ds402Status;
    const double window = std::max(2 / parameters_.countsPerUnit, 1e-3);
    const bool isHoming = mode() == Ds402Mode::Homing;
    const bool enabled = state_ == Ds402State::OperationEnabled;
    bool reached = torque_ && stands() && !homing_.runs(), bit12 = isObeying(),
         bit13 = strayed_ > 0;
    if (enabled && mode() == Ds402Mode::ProfilePosition) {
        bit12 = profile_.taken;
        if (isObeying()) reached = reached && std::abs(profile_.target - motor_.position) < window;
    } else if (enabled && mode() == Ds402Mode::ProfileVelocity) {
        bit12 = stands();
        if (isObeying()) reached = std::abs(in_.velocity - motor_.velocity) < 10 * standstill;
    } else if (enabled && isHoming) {
        bit12 = homing_.phase == Homing::Phase::Attained;
        bit13 = homing_.phase == Homing::Phase::Error;
        if (halted()) reached = stands();
    } else if (isObeying()) {
        reached = mode() == Ds402Mode::CyclicPosition && std::abs(out_.followingError) < window;
    }
    return static_cast<std::uint16_t>((reached ? Bits::targetReached : 0) |
                                      (bit12 ? Bits::follows : 0) |
                                      (bit13 ? Bits::followingError : 0));
}

void Ds402Drive::tell() noexcept {
    const Ds402StateRow* row = rowOf(state_);
    std::uint16_t word = row ? row->value : 0;
    if (state_ != Ds402State::NotReadyToSwitchOn)
        word |= Ds402Status::remote | (cause_ == 0x3220 ? 0 : Ds402Status::voltageEnabled);
    if (temperature_ > warmAt) word |= Ds402Status::warning;
    if (limited_) word |= Ds402Status::internalLimit;
    out_.statusWord = static_cast<std::uint16_t>(word | modeBits());
    const double counts = parameters_.countsPerUnit;
    out_.position = std::round((motor_.position + offset_) * counts) / counts + 0.0;  // no -0
    out_.velocity = motor_.velocity;
    out_.effort = motor_.effort;
    out_.demand = (torque_ ? reference_.position : motor_.position) + offset_;
    out_.temperature = temperature_;
    out_.digitalInputs = switches() | (in_.digitalOutputs & 0xFFFF) << 16;
}

void Ds402Drive::communicationLost() noexcept {
    if (state_ != Ds402State::OperationEnabled || parameters_.abortOption == 0) return;
    spent_ = true;
    if (parameters_.abortOption == 1) pending_ = 0x7500;
    if (parameters_.abortOption == 2) go(9);
    if (parameters_.abortOption == 3) go(11);
    tell();
}

void Ds402Drive::powerCycle() noexcept {
    torque_ = false;
    spent_ = false;
    offset_ = axis_.absoluteEncoder ? offset_ : -motor_.position;
    out_.homed = axis_.absoluteEncoder;
    out_.errorCode = pending_ = 0;
    out_.modeDisplay = 0;
    selfTest_ = 0;
    go(0);
    tell();
}

void Ds402Drive::fail(std::uint16_t code, bool causeStays) noexcept {
    pending_ = code == 0 ? std::uint16_t{0xFF00} : code;
    if (causeStays) cause_ = pending_;
}

void Ds402Drive::jumpEncoder(double by) noexcept {
    if (!std::isfinite(by)) return;
    offset_ = std::clamp(offset_ + by, -1e12, 1e12);
    out_.homed = false;
    tell();
}

}  // namespace cortex::drives
