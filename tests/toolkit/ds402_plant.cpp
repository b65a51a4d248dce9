// SPDX-License-Identifier: Apache-2.0
#include "ds402_plant.hpp"

#include "cortex/core/agent.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::toolkit::test {

using drives::Ds402Drive;
using drives::Ds402State;

namespace {

using Names = std::vector<std::string>;

constexpr double periodOfDrives = 1e-3;  // s

drives::Ds402Axis mechanismOf(bool homingNeeded, double start) {
    drives::Ds402Axis axis;
    axis.startPosition = start;
    axis.selfTestTime = 0.02;
    axis.negativeSwitch = -0.05;
    axis.absoluteEncoder = !homingNeeded;
    return axis;
}

// What it says of itself as an axis.
std::int64_t statusOf(Ds402State state, bool homing, bool homed, bool waits, bool moves) {
    if (state == Ds402State::Fault || state == Ds402State::FaultReactionActive) return 4;
    if (state != Ds402State::OperationEnabled) return 6;
    if (homing || !homed) return 5;
    if (waits) return 6;
    return moves ? 2 : 1;
}

}  // namespace

void ScriptedDrive::populate() {
    on<&ScriptedDrive::reconnect>("reconnect");
    const auto demands = inputs("demands");
    const auto observations = outputs("observations");
    const auto start = array<const double>("startPosition");
    for (std::size_t i = 0; i < demands.size(); ++i) {
        const InputSimplex& in = demands[i];
        const OutputSimplex& out = observations[i];
        const bool needed = out.data<const bool>("homingNeeded");
        wires_.push_back({in.data<std::int64_t>("controlWord"),
                          in.data<std::int64_t>("mode"),
                          in.data<std::int64_t>("homingMethod"),
                          in.data<std::int64_t>("quickStopOption"),
                          in.data<std::int64_t>("faultReactionOption"),
                          in.data<double>("position"),
                          in.data<double>("velocity"),
                          in.data<double>("effort"),
                          in.data<double>("homingSpeed"),
                          in.data<double>("homingCreep"),
                          in.data<double>("homeOffset"),
                          in.data<bool>("waits"),
                          out.data<std::int64_t>("statusWord"),
                          out.data<std::int64_t>("driveState"),
                          out.data<std::int64_t>("modeDisplay"),
                          out.data<std::int64_t>("errorCode"),
                          out.data<std::int64_t>("status"),
                          out.data<double>("position"),
                          out.data<double>("velocity"),
                          out.data<double>("effort"),
                          out.data<double>("followingError"),
                          out.data<bool>("homed"),
                          needed});
        axes_.push_back({Ds402Drive{mechanismOf(needed, start[i]), {}}});
    }
}

drives::Ds402Inputs ScriptedDrive::inputsOf(std::size_t place) const {
    const Wires& wires = wires_[place];
    drives::Ds402Inputs inputs;
    inputs.controlWord = static_cast<std::uint16_t>(wires.controlWord.get());
    inputs.mode = static_cast<std::int8_t>(wires.mode.get());
    const bool byPosition = inputs.mode == 8 || inputs.mode == 1;
    const bool byEffort = inputs.mode == 10;
    inputs.position = wires.position;
    inputs.velocity = byPosition ? 0 : wires.velocity.get();
    inputs.velocityOffset = byPosition ? wires.velocity.get() : 0;
    inputs.effort = byEffort ? wires.effort.get() : 0;
    inputs.effortOffset = byEffort ? 0 : wires.effort.get();
    return inputs;
}

void ScriptedDrive::parametersOf(std::size_t place) {
    const Wires& wires = wires_[place];
    drives::Ds402Parameters parameters = axes_[place].model.parameters();
    parameters.homingMethod = static_cast<std::int32_t>(wires.method);
    parameters.homingSpeed = wires.speed;
    parameters.homingCreep = wires.creep;
    parameters.homeOffset = wires.offset;
    parameters.quickStopOption = static_cast<std::int32_t>(wires.quickStopOption);
    parameters.faultReactionOption = static_cast<std::int32_t>(wires.faultReactionOption);
    axes_[place].model.set(parameters);
}

void ScriptedDrive::command(std::size_t place, const Tick& tick) {
    Axis& axis = axes_[place];
    drives::Ds402Inputs inputs = inputsOf(place);
    if (inputLost() || state() == State::Fault) inputs.controlWord = 2;
    if (axis.deaf) inputs.controlWord = axis.heard;
    axis.heard = inputs.controlWord;
    parametersOf(place);
    axis.model.step(inputs, tick.elapsedSeconds() * static_cast<double>(every_));
}

void ScriptedDrive::tell(std::size_t place) {
    const Axis& axis = axes_[place];
    const drives::Ds402Outputs& outputs = axis.model.outputs();
    const Wires& wires = wires_[place];
    const auto word =
        static_cast<std::uint16_t>(axis.fakeWord >= 0 ? axis.fakeWord : outputs.statusWord);
    const Ds402State told = drives::stateOf(word);
    Wires& out = wires_[place];
    out.statusWord = word;
    if (told != Ds402State::Unknown) out.driveState = static_cast<std::int64_t>(told);
    out.modeDisplay = axis.fixedMode >= 0 ? axis.fixedMode : outputs.modeDisplay;
    out.errorCode = outputs.errorCode;
    const bool homed = outputs.homed || !wires.homingNeeded;
    const bool moves = std::abs(outputs.velocity) > 1e-3;
    out.status = statusOf(told, outputs.modeDisplay == 6, homed, wires.waits, moves);
    out.observed = outputs.position;
    out.observedVelocity = outputs.velocity;
    out.observedEffort = outputs.effort;
    out.followingError = outputs.followingError;
    out.homed = outputs.homed;
}

void ScriptedDrive::loopEnd(const Tick& tick) {
    if (silent_) {
        setQuality(Quality::Lost);
        return;
    }
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        if (tick.cycle % every_ == 0) {
            command(i, tick);
            tell(i);
        }
    }
}

void ScriptedDrive::keep(Archive& archive) {
    archive.version("ScriptedDrive", 1);
    archive & axes_ & silent_ & every_;
}

void buildDrives(Rig& rig, const PlantOptions& options) {
    rig.classes().add<ScriptedDrive>("ScriptedDrive");
    Rig::Pairs processor{{"safety", "/safety"}}, drive;
    for (const std::string& name : options.axes == 1 ? Names{"a"} : Names{"a", "b"}) {
        rig.add("/drive/" + name, "Ds402RotaryObservation", {},
                {{"homingNeeded", options.homingNeeded ? "true" : "false"}});
        rig.add("/set/" + name, "Ds402RotaryModification");
        rig.add("/demand/" + name, "LimitedAxis");
        processor.emplace_back("drives", "/drive/" + name);
        processor.emplace_back("demands", "/demand/" + name);
        processor.emplace_back("setpoints", "/set/" + name);
        drive.emplace_back("demands", "/set/" + name);
        drive.emplace_back("observations", "/drive/" + name);
    }
    rig.add("/safety", "SafetyStatus");
    rig.add("/panel", "SimulatedSafetyPanel", {{"status", "/safety"}});
    rig.add("/it", "Ds402AxisProcessor", processor, {{"quickStopOption", options.quickStopOption}});
    rig.add("/bus", "ScriptedDrive", drive, {{"startPosition", options.startPosition}});
    if (!options.jogs) return;
    rig.add("/jog", "JogController",
            {{"axes", "/drive/a"},
             {"axes", "/drive/b"},
             {"demands", "/demand/a"},
             {"demands", "/demand/b"}});
}

DrivePlant::DrivePlant(const PlantOptions& options) { buildDrives(*this, options); }

void DrivePlant::boot() {
    cluster().addEventSink([told = told_](const Event& event, const Structure&) {
        const std::lock_guard lock{told->mutex};
        told->text += std::string{event.text.view()} + "\n";
    });
    start();
    step(50);  // self test
}

void DrivePlant::begin() {
    boot();
    startUp();
}

ScriptedDrive& DrivePlant::drive() { return dynamic_cast<ScriptedDrive&>(tree().at("/bus")); }

void DrivePlant::demand(int number, double position, double velocity) {
    Simplex& demand = tree().at(number == 1 ? "/demand/a" : "/demand/b");
    demand.data<double>("position") = position;
    demand.data<double>("velocity") = velocity;
}

void DrivePlant::moveDemand(int number, double to) {
    const std::string path = number == 1 ? "/demand/a" : "/demand/b";
    double now = get<double>(path, "position");
    const double way = to > now ? 1 : -1;
    while (now != to) {
        now = std::abs(to - now) <= periodOfDrives ? to : now + way * periodOfDrives;
        demand(number, now, now == to ? 0 : way);
        step();
    }
}

std::int64_t DrivePlant::item(const std::string& name, int number) {
    return std::get<std::vector<std::int64_t>>(
        cluster().image().value("/it", name))[static_cast<std::size_t>(number - 1)];
}

std::string DrivePlant::faultText() {
    return std::get<std::vector<std::string>>(cluster().image().value("/it", "faultText")).front();
}

std::vector<std::int64_t> DrivePlant::transitionsWhile(int number, std::int64_t cycles) {
    std::vector<std::int64_t> numbers;
    std::int64_t count = item("transitionCount", number);
    for (std::int64_t i = 0; i < cycles; ++i) {
        step();
        if (item("transitionCount", number) == count) continue;
        count = item("transitionCount", number);
        numbers.push_back(item("lastTransition", number));
    }
    return numbers;
}

std::string DrivePlant::told() {
    cluster().agent().events().flush();
    const std::lock_guard lock{told_->mutex};
    return told_->text;
}

}  // namespace cortex::toolkit::test
