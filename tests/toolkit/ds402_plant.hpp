// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"
#include "cortex/drives/ds402_drive.hpp"

#include "rig.hpp"

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace cortex::toolkit::test {

// The model of one or two CiA 402 drives inside of the test, which may silence and disturb them.
class ScriptedDrive final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

    struct Axis {
        drives::Ds402Drive model;
        std::int64_t fakeWord = -1;   // status word instead of the model's; -1: none
        std::int64_t fixedMode = -1;  // the drive shows this mode whatever is wished; -1: none
        bool deaf = false;            // new control words do not arrive
        std::uint16_t heard = 0;

        void keep(Archive& archive) {
            model.keep(archive);
            archive & fakeWord & fixedMode & deaf & heard;
        }
    };
    Axis& axis(int number) { return axes_[static_cast<std::size_t>(number - 1)]; }
    void setSilent(bool silent) { silent_ = silent; }
    // Words and answers pass only once in so many cycles.
    void setEvery(std::int64_t cycles) { every_ = cycles; }

private:
    struct Wires {
        Data<const std::int64_t> controlWord, mode, method, quickStopOption, faultReactionOption;
        Data<const double> position, velocity, effort, speed, creep, offset;
        Data<const bool> waits;
        Data<std::int64_t> statusWord, driveState, modeDisplay, errorCode, status;
        Data<double> observed, observedVelocity, observedEffort, followingError;
        Data<bool> homed;
        bool homingNeeded;
    };
    void populate() override;
    void loopEnd(const Tick& tick) override;
    void keep(Archive& archive) override;
    Outcome reconnect(Call&) { return Outcome::Done; }
    void command(std::size_t place, const Tick& tick);
    void tell(std::size_t place);
    drives::Ds402Inputs inputsOf(std::size_t place) const;
    void parametersOf(std::size_t place);

    std::vector<Axis> axes_;
    std::vector<Wires> wires_;
    bool silent_ = false;
    std::int64_t every_ = 1;
};

struct PlantOptions {
    int axes = 2;
    bool homingNeeded = false;
    bool jogs = false;  // a JogController writes the demands; otherwise the test
    std::string quickStopOption = "2 2";
    std::string startPosition = "0 0";
};

// Two axes with a processor, at 1 kHz. The demands are written by the test, or by `/jog`.
class DrivePlant : public Rig {
public:
    explicit DrivePlant(const PlantOptions& options = {});

    ScriptedDrive& drive();
    ScriptedDrive::Axis& axis(int number) { return drive().axis(number); }
    double place(int number) { return axis(number).model.place(); }
    void boot();   // the self test of the drives is over
    void begin();  // and all is started
    CallResult ask(const std::string& command, const Arguments& arguments = {}) {
        return call("/it", command, arguments);
    }
    CallResult ask(const std::string& command, std::int64_t axis) {
        return ask(command, {{"axis", axis}});
    }
    void demand(int number, double position, double velocity = 0);
    // Moves a demand at 1 rad/s, in as many cycles as it takes.
    void moveDemand(int number, double to);
    std::int64_t item(const std::string& name, int number);
    std::string faultText();
    std::int64_t faultCode() { return get<std::int64_t>("/it", "faultCode"); }
    drives::Ds402State driveState(int number) { return axis(number).model.state(); }
    bool enabled(int number) { return driveState(number) == drives::Ds402State::OperationEnabled; }
    // Numbers of the transitions that the processor has seen of an axis while this runs.
    std::vector<std::int64_t> transitionsWhile(int number, std::int64_t cycles);
    std::int64_t status(int number) {  // of an axis, as its controllers see it
        return get<std::int64_t>(number == 1 ? "/drive/a" : "/drive/b", "status");
    }
    // Texts of all events so far, a line each.
    std::string told();
    bool hasTold(const std::string& words) { return told().find(words) != std::string::npos; }

private:
    struct Told {
        std::mutex mutex;
        std::string text;
    };
    std::shared_ptr<Told> told_ = std::make_shared<Told>();
};

void buildDrives(Rig& rig, const PlantOptions& options);

}  // namespace cortex::toolkit::test
