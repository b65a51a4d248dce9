// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "conform/bench.hpp"

#include <array>
#include <cstdint>
#include <string_view>

// States and words of CiA 402 (IEC 61800-7-201), as the items of drives.xml number them.
namespace cortex::cli::conform {

enum class Drive : std::int64_t {
    Unknown,
    NotReadyToSwitchOn,
    SwitchOnDisabled,
    ReadyToSwitchOn,
    SwitchedOn,
    OperationEnabled,
    QuickStopActive,
    FaultReactionActive,
    Fault
};
enum class Word : std::int64_t {
    Shutdown = 1,
    SwitchOn,
    DisableVoltage,
    QuickStop,
    DisableOperation,
    EnableOperation,
    FaultReset
};
inline constexpr std::array allWords{Word::Shutdown,  Word::SwitchOn,         Word::DisableVoltage,
                                     Word::QuickStop, Word::DisableOperation, Word::EnableOperation,
                                     Word::FaultReset};

// What a word leads to.
struct Transition {
    int number;
    Drive from, to;
    Word word;
};
// Without 15, which needs a fault. 12 is made by the word where the quick stop stays, else by
// itself.
inline constexpr std::array transitions{
    Transition{2, Drive::SwitchOnDisabled, Drive::ReadyToSwitchOn, Word::Shutdown},
    Transition{3, Drive::ReadyToSwitchOn, Drive::SwitchedOn, Word::SwitchOn},
    Transition{6, Drive::SwitchedOn, Drive::ReadyToSwitchOn, Word::Shutdown},
    Transition{7, Drive::ReadyToSwitchOn, Drive::SwitchOnDisabled, Word::DisableVoltage},
    Transition{10, Drive::SwitchedOn, Drive::SwitchOnDisabled, Word::DisableVoltage},
    Transition{4, Drive::SwitchedOn, Drive::OperationEnabled, Word::EnableOperation},
    Transition{5, Drive::OperationEnabled, Drive::SwitchedOn, Word::DisableOperation},
    Transition{8, Drive::OperationEnabled, Drive::ReadyToSwitchOn, Word::Shutdown},
    Transition{9, Drive::OperationEnabled, Drive::SwitchOnDisabled, Word::DisableVoltage},
    Transition{11, Drive::OperationEnabled, Drive::QuickStopActive, Word::QuickStop},
    Transition{12, Drive::QuickStopActive, Drive::SwitchOnDisabled, Word::DisableVoltage},
    Transition{16, Drive::QuickStopActive, Drive::OperationEnabled, Word::EnableOperation}};

// Whether the word means something in the state, also where no transition of the table is tried.
bool isPossible(Drive state, Word word);
bool hasTorque(Drive state);

// One axis of a processor on the bench, led from state to state.
class DriveAxis {
public:
    // Its processor is in Standby, or where torque is needed led to Active. Throws Ended where the
    // axis cannot be led now, as in a fault, or where the processor works for somebody.
    DriveAxis(Bench& bench, const AxisPair& axis, bool withTorque);

    // As the drive tells it, once its processor has seen it, too.
    Drive state() const;
    // Unknown while the two differ: the processor sees it a cycle later.
    Drive stateIn(const Sample& sample) const;
    std::string text(Drive state) const;  // the label of its item
    std::string text(Word word) const;
    comms::CommandAnswer step(Word word);
    // Steps on the shortest way to that state. Throws Ended.
    void lead(Drive to);
    bool becomes(Drive state);  // in the time for one transition, and as long again
    // Whether a quick stop stays in Quick stop active: options 5 to 8.
    bool quickStopStays() const;
    std::uint32_t processor() const { return processor_; }
    std::size_t place() const { return axis_.place; }  // in its arrays
    Bench& bench() { return bench_; }

private:
    double stepTime() const;  // s: for one transition, and as long again

    Bench& bench_;
    AxisPair axis_;
    std::uint32_t processor_;
};

}  // namespace cortex::cli::conform
