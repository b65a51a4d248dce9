// SPDX-License-Identifier: Apache-2.0
#include "drive/transitions.hpp"

#include <QCoreApplication>
#include <QStringList>

namespace cortex::explorer {

namespace {

using drives::Ds402Command;
using drives::Ds402State;
using drives::Ds402Transition;

constexpr int quickStopAgain = 16;  // from Quick stop active back to Operation enabled

// Labels of the parameter `word` of the command `step`.
struct StepWord {
    Ds402Command command;
    std::int64_t word;
};
constexpr std::array stepWords{
    StepWord{Ds402Command::Shutdown, 1},        StepWord{Ds402Command::SwitchOn, 2},
    StepWord{Ds402Command::DisableVoltage, 3},  StepWord{Ds402Command::QuickStop, 4},
    StepWord{Ds402Command::EnableOperation, 6}, StepWord{Ds402Command::FaultReset, 7}};
constexpr std::int64_t disableOperation = 5;  // the word "switch on", in Operation enabled

QString stepText(const char* text) { return QCoreApplication::translate("Drive", text); }

QString latin(std::string_view text) {
    return QLatin1String{text.data(), static_cast<int>(text.size())};
}

// The first row of a number that somebody can ask for; with `from`: in this state.
const Ds402Transition* askedRow(int number, std::optional<Ds402State> from = {}) {
    for (const Ds402Transition& row : drives::ds402Transitions) {
        if (row.number == number && row.command != Ds402Command::None &&
            (!from || row.from == from))
            return &row;
    }
    return nullptr;
}

bool optionAllows(int number, int quickStopOption) {
    return number != quickStopAgain || (quickStopOption >= 5 && quickStopOption <= 8);
}

}  // namespace

QString nameOfState(Ds402State state) { return latin(drives::nameOf(state)); }

std::optional<std::int64_t> stepWord(int number, Ds402State from, int quickStopOption) {
    const Ds402Transition* row = askedRow(number, from);
    if (row == nullptr || !optionAllows(number, quickStopOption)) return std::nullopt;
    if (row->command == Ds402Command::SwitchOn && from == Ds402State::OperationEnabled)
        return disableOperation;
    for (const StepWord& each : stepWords) {
        if (each.command == row->command) return each.word;
    }
    return std::nullopt;
}

QString nameOfTransition(int number) {
    const Ds402Transition* row = askedRow(number);
    if (row == nullptr) return stepText("Transition %1").arg(number);
    return stepText("Transition %1, %2, to %3")
        .arg(number)
        .arg(latin(row->cause), nameOfState(row->to));
}

QString whyNoTransition(int number, Ds402State from, int quickStopOption) {
    const Ds402Transition* row = askedRow(number);
    if (row == nullptr) return stepText("nobody can ask for it");
    if (row->from != from) return stepText("needs %1").arg(nameOfState(row->from));
    if (!optionAllows(number, quickStopOption))
        return stepText("needs a quick stop option from 5 to 8; it is %1").arg(quickStopOption);
    return {};
}

bool leadsToEnabled(int number) {
    const Ds402Transition* row = askedRow(number);
    return row != nullptr && row->to == Ds402State::OperationEnabled;
}

QString transitionsFrom(Ds402State from, int quickStopOption) {
    QStringList all;
    for (const int number : askableTransitions) {
        if (!stepWord(number, from, quickStopOption)) continue;
        all << stepText("%1 %2").arg(number).arg(latin(askedRow(number, from)->cause));
    }
    return all.join(QStringLiteral(", "));
}

}  // namespace cortex::explorer
