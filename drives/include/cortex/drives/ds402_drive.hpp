// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/drives/ds402_parameters.hpp"
#include "cortex/drives/ds402_signals.hpp"
#include "cortex/drives/ds402_state.hpp"
#include "cortex/drives/ds402_words.hpp"

#include <cstdint>
#include <type_traits>

// A model of one axis with its CiA 402 drive: states, modes, homing, motor, brake, encoder,
// switches. Units are those of the axis: rad and N.m, or m and N; times are s.
namespace cortex::drives {

// The model. It reads no clock and no chance: equal calls give equal bits. All functions may be
// called in a tick: they allocate nothing and throw nothing. A copy is a whole saved state. One
// thread at a time.
//
// `refused` counts once for each change of bits 0 to 3 and 7 of the control word that asks for what
// the state does not allow, resets included whose cause still stands; a word that asks for what is
// there already is not refused. It counts once, too, for each change of the wished mode that is not
// taken at once. A word acts for as long as it stands, but not beyond communicationLost(): from
// then on only a new one acts. Before the end of the self test none is looked at.
class Ds402Drive {
public:
    static constexpr double timeStep = 1e-4;  // s, of the model
    static constexpr double longestStep = 1;  // s, more is cut

    Ds402Drive() noexcept : Ds402Drive{{}, {}} {}
    // What is not valid is replaced by its defaults as a whole.
    Ds402Drive(const Ds402Axis& axis, const Ds402Parameters& parameters) noexcept;

    // Goes on by so many seconds, in whole time steps; what is left over counts in the next call.
    void step(const Ds402Inputs& inputs, double seconds) noexcept;
    const Ds402Outputs& outputs() const noexcept { return out_; }
    Ds402State state() const noexcept { return state_; }
    // Where the mechanism is, without encoder and homing.
    double place() const noexcept { return motor_.position; }

    // False: they are not valid, and nothing has changed.
    bool set(const Ds402Parameters& parameters) noexcept;
    const Ds402Parameters& parameters() const noexcept { return parameters_; }

    // The watchdog of the connection: acts by abortOption, in Operation enabled alone.
    void communicationLost() noexcept;
    // As power off and on: self test, not homed, counters go on.
    void powerCycle() noexcept;
    // A fault; a cause that stays refuses resets until clearCause(). Code 0 is taken as 0xFF00.
    void fail(std::uint16_t code, bool causeStays) noexcept;
    void clearCause() noexcept { cause_ = 0; }
    // The encoder says something else from now on, by this much; the axis is not homed any more.
    void jumpEncoder(double by) noexcept;
    Ds402Disturbance disturbance;

    // All but what the constructor got as the axis.
    template <class Archive>
    void keep(Archive& archive) {
        archive & parameters_ & disturbance & in_ & out_ & motor_ & brake_ & reference_ & homing_;
        archive & profile_ & state_ & spent_ & torque_ & limited_ & pending_ & cause_;
        archive & offset_ & rest_ & selfTest_ & standing_ & strayed_ & temperature_;
    }

private:
    struct Motor {
        double position = 0, velocity = 0, effort = 0, integral = 0;
        template <class Archive>
        void keep(Archive& archive) {
            archive & position & velocity & effort & integral;
        }
    };
    struct Brake {
        double timer = 0;  // since it was told otherwise
        bool holds = true, wanted = true;
        template <class Archive>
        void keep(Archive& archive) {
            archive & timer & holds & wanted;
        }
    };
    struct Reference {  // of the servo, as place of the mechanism
        double position = 0, velocity = 0;
        double settling = 0;  // s since a ramp has ended
        bool stopping = false;
        template <class Archive>
        void keep(Archive& archive) {
            archive & position & velocity & settling & stopping;
        }
    };
    struct Homing {
        enum class Phase : std::uint8_t { Idle, Seek, Leave, Index, Attained, Error };
        Phase phase = Phase::Idle;
        std::int8_t side = 0;  // of the limit switch: -1, 1; 0: none
        std::int8_t way = 0;   // towards the edge or the index
        bool index = false;
        double last = 0;     // place one time step ago
        double stalled = 0;  // s
        bool runs() const noexcept {
            return phase == Phase::Seek || phase == Phase::Leave || phase == Phase::Index;
        }
        template <class Archive>
        void keep(Archive& archive) {
            archive & phase & side & way & index & last & stalled;
        }
    };
    struct Profile {  // of ProfilePosition, as places of the mechanism
        double target = 0, next = 0;
        bool waiting = false, taken = false;
        template <class Archive>
        void keep(Archive& archive) {
            archive & target & next & waiting & taken;
        }
    };

    // ds402_drive.cpp: states
    void tick(const Ds402Inputs& in) noexcept;
    void obey(std::uint16_t word) noexcept;
    void chooseMode(int mode, bool isNew) noexcept;
    void goOn() noexcept;
    void go(int number) noexcept;
    bool stopped() noexcept;
    double deceleration() const noexcept;
    bool isObeying() const noexcept;
    bool causeStands() const noexcept;
    void supervise() noexcept;
    void tell() noexcept;
    std::uint16_t modeBits() const noexcept;
    Ds402Mode mode() const noexcept { return static_cast<Ds402Mode>(out_.modeDisplay); }
    bool halted() const noexcept;
    bool stands() const noexcept;
    // ds402_servo.cpp: reference, servo, motor
    void takeTargets(const Ds402Inputs& in) noexcept;
    void newSetPoint(std::uint16_t word) noexcept;
    double wishedEffort() noexcept;
    double followPosition() noexcept;
    double followProfile() noexcept;
    double ramp(double velocity, double acceleration) noexcept;
    double brake(double deceleration) noexcept;
    double torque() noexcept;
    double holdPosition(double effortOffset) noexcept;
    double holdSpeed(double velocity, double effortOffset) noexcept;
    double withinLimits(double velocity) noexcept;
    double servo(double velocity, double effortOffset) noexcept;
    double withinReach(double place) noexcept;
    double greatestEffort() const noexcept;
    void moveBrake() noexcept;
    void move(double effort) noexcept;
    double betweenStops(double place) const noexcept;
    // ds402_homing.cpp
    void beginHoming() noexcept;
    double home() noexcept;
    void search() noexcept;
    void found(double place) noexcept;
    bool isOn(int side) const noexcept;
    std::uint32_t switches() const noexcept;

    Ds402Axis axis_;
    Ds402Parameters parameters_;
    Ds402Inputs in_;  // as of the last time step, targets finite
    Ds402Outputs out_;
    Motor motor_;
    Brake brake_;
    Reference reference_;
    Homing homing_;
    Profile profile_;
    Ds402State state_ = Ds402State::NotReadyToSwitchOn;
    bool spent_ = false;                                // the control word has had its effect
    bool torque_ = false;                               // the servo is on
    bool limited_ = false;                              // bit 11
    std::uint16_t pending_ = 0, cause_ = 0;             // of a fault; 0: none
    double offset_ = 0;                                 // position minus place
    double rest_ = 0;                                   // s, of the time step
    double selfTest_ = 0, standing_ = 1, strayed_ = 0;  // s for which it lasts
    double temperature_ = 25;
};

static_assert(std::is_trivially_copyable_v<Ds402Drive>);

}  // namespace cortex::drives
