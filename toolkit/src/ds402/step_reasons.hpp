// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"
#include "cortex/drives/ds402_state.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace cortex::toolkit {

// The words of the command `step`. The numbers are those of its labels.
enum class StepWord : std::uint8_t {
    Shutdown = 1,
    SwitchOn,
    DisableVoltage,
    QuickStop,
    DisableOperation,
    EnableOperation,
    FaultReset
};

// What each word leads to in each state, and the library's reasons why one leads nowhere, made
// beforehand: a tick makes no strings.
class StepReasons {
public:
    StepReasons();
    // Null: the word leads nowhere in this state.
    static const drives::Ds402Transition* transition(StepWord word, drives::Ds402State state,
                                                     int quickStopOption) CORTEX_REALTIME;
    std::string_view why(StepWord word, drives::Ds402State state, int quickStopOption) const
        CORTEX_REALTIME;

private:
    static constexpr std::size_t states = 9, options = 9, words = 7;
    static std::size_t place(StepWord word, drives::Ds402State state, int option);

    std::array<std::string, words * states * options> texts_;
};

}  // namespace cortex::toolkit
