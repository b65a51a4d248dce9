// SPDX-License-Identifier: Apache-2.0
#include "ds402/step_reasons.hpp"

#include <algorithm>

namespace cortex::toolkit {

using drives::Ds402Command;
using drives::Ds402State;

namespace {

// Two words of CiA 402 are one: by `from` they are told apart.
struct StepRow {
    StepWord word;
    Ds402Command command;
    int number;       // of the transition that it is for in the first place
    Ds402State only;  // the one state from which it leads; Unknown: all that the table has
};

constexpr std::array<StepRow, 7> stepRows{{
    {StepWord::Shutdown, Ds402Command::Shutdown, 2, Ds402State::Unknown},
    {StepWord::SwitchOn, Ds402Command::SwitchOn, 3, Ds402State::ReadyToSwitchOn},
    {StepWord::DisableVoltage, Ds402Command::DisableVoltage, 9, Ds402State::Unknown},
    {StepWord::QuickStop, Ds402Command::QuickStop, 11, Ds402State::Unknown},
    {StepWord::DisableOperation, Ds402Command::SwitchOn, 5, Ds402State::OperationEnabled},
    {StepWord::EnableOperation, Ds402Command::EnableOperation, 4, Ds402State::Unknown},
    {StepWord::FaultReset, Ds402Command::FaultReset, 15, Ds402State::Unknown},
}};

const StepRow& rowOfStep(StepWord word) { return stepRows[static_cast<std::size_t>(word) - 1]; }

}  // namespace

std::size_t StepReasons::place(StepWord word, Ds402State state, int option) {
    const auto bounded = static_cast<std::size_t>(std::clamp(option, 0, 8));
    return ((static_cast<std::size_t>(word) - 1) * states + static_cast<std::size_t>(state)) *
               options +
           bounded;
}

StepReasons::StepReasons() {
    for (const StepRow& row : stepRows) {
        for (std::size_t i = 0; i < states; ++i) {
            const auto state = static_cast<Ds402State>(i);
            const bool again =
                row.word == StepWord::EnableOperation && state == Ds402State::QuickStopActive;
            for (int option = 0; option < static_cast<int>(options); ++option)
                texts_[place(row.word, state, option)] =
                    drives::whyNot(state, again ? 16 : row.number, option);
        }
    }
}

const drives::Ds402Transition* StepReasons::transition(StepWord word, Ds402State state,
                                                       int quickStopOption) {
    const StepRow& row = rowOfStep(word);
    if (row.only != Ds402State::Unknown && row.only != state) return nullptr;
    return transitionOf(state, row.command, quickStopOption);
}

std::string_view StepReasons::why(StepWord word, Ds402State state, int quickStopOption) const {
    return texts_[place(word, state, quickStopOption)];
}

}  // namespace cortex::toolkit
