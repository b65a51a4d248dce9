// SPDX-License-Identifier: Apache-2.0
#include "cortex/drives/ds402_words.hpp"

#include "cortex/drives/ds402_state.hpp"

#include <cstdio>

namespace cortex::drives {

namespace {

std::string hex(int code) {
    char text[16];
    std::snprintf(text, sizeof text, "0x%04X", static_cast<unsigned>(code) & 0xFFFFu);
    return text;
}

std::string name(const Ds402ModeRow& row) {
    return std::string(row.name) + " (" + std::string(row.letters) + ")";
}

// "2 (from Switch on disabled, control word 0x0006)" of what can be asked for in a state.
std::string whatCanBeAsked(Ds402State state, int quickStopOption) {
    std::string text;
    for (const Ds402CommandRow& row : ds402Commands)
        if (const auto* transition = transitionOf(state, row.command, quickStopOption))
            text += (text.empty() ? "" : ", ") + std::to_string(transition->number) + " (" +
                    std::string(row.name) + ", " + hex(row.word) + ")";
    return text.empty() ? "nothing can be asked for here; wait"
                        : "what can be asked for here is " + text;
}

const Ds402Transition* firstRow(int number) {
    for (const Ds402Transition& row : ds402Transitions)
        if (row.number == number) return &row;
    return nullptr;
}

}  // namespace

std::string whyNot(Ds402State state, int number, int quickStopOption) {
    const Ds402Transition* row = firstRow(number);
    if (!row) return "There is no transition " + std::to_string(number) + "; they are 0 to 16.";
    const std::string subject = "Transition " + std::to_string(number);
    if (row->command == Ds402Command::None)
        return subject + " cannot be asked for: its cause is " + std::string(row->cause) + ".";
    if (state == Ds402State::Unknown)
        return "The state of the drive is not known; wait until its status word tells one.";
    if (row->from != state)
        return subject + " begins in " + std::string(nameOf(row->from)) + ", the drive is in " +
               std::string(nameOf(state)) + "; " + whatCanBeAsked(state, quickStopOption) + ".";
    if (!transitionOf(state, row->command, quickStopOption))
        return subject + " needs quick stop option 5 to 8, the option is " +
               std::to_string(quickStopOption) + "; change it, or enable again from the start.";
    return {};
}

std::string modeName(int mode) {
    if (mode == 0) return "none";
    const Ds402ModeRow* row = modeRow(mode);
    return row ? name(*row) : "mode " + std::to_string(mode);
}

std::string whyNotMode(int mode, std::uint32_t supported) {
    const bool there = isBuilt(mode) && (supported & supportedBit(mode)) != 0;
    if (there) return {};
    std::string known;
    for (const Ds402ModeRow& row : ds402Modes) {
        const int number = static_cast<int>(row.mode);
        if (row.built && (supported & supportedBit(number)) != 0)
            known += (known.empty() ? "" : ", ") + std::to_string(number) + " " + name(row);
    }
    const std::string_view why = isBuilt(mode) ? " is not known to this drive" : " is not built";
    return "Mode " + std::to_string(mode) +
           (modeRow(mode) ? ", " + modeName(mode) + "," : std::string()) + std::string(why) +
           "; there are " + (known.empty() ? "none" : known) + ".";
}

std::string errorName(int code) {
    if (code == 0) return "no error";
    for (const Ds402ErrorRow& row : ds402Errors)
        if (row.code == code) return std::string(row.name) + " (" + hex(code) + ")";
    if (code >= 0xFF00 && code <= 0xFFFF) return "error of the maker (" + hex(code) + ")";
    return "error " + hex(code);
}

}  // namespace cortex::drives
