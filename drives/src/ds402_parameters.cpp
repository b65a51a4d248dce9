// SPDX-License-Identifier: Apache-2.0
#include "cortex/drives/ds402_parameters.hpp"

#include <cmath>
#include <cstdio>
#include <iterator>
#include <utility>

namespace cortex::drives {
namespace {

constexpr double greatestNumber =
    1e12;  // of any number here, so that sums and products stay finite

struct NumberRow {
    double Ds402Parameters::* member;
    double min;
    const char* name;
};

constexpr double above0 = 1e-12;
constexpr NumberRow numbers[] = {
    {&Ds402Parameters::followingErrorWindow, 0, "following error window (6065)"},
    {&Ds402Parameters::followingErrorTime, 0, "following error time (6066)"},
    {&Ds402Parameters::ratedEffort, above0, "rated effort (6076)"},
    {&Ds402Parameters::homeOffset, -greatestNumber, "home offset (607C)"},
    {&Ds402Parameters::softMin, -greatestNumber, "least position (607D:1)"},
    {&Ds402Parameters::softMax, -greatestNumber, "greatest position (607D:2)"},
    {&Ds402Parameters::maxVelocity, above0, "greatest velocity (607F)"},
    {&Ds402Parameters::profileVelocity, above0, "profile velocity (6081)"},
    {&Ds402Parameters::profileAcceleration, above0, "profile acceleration (6083)"},
    {&Ds402Parameters::quickStopDeceleration, above0, "quick stop deceleration (6085)"},
    {&Ds402Parameters::countsPerUnit, above0, "counts per unit (608F)"},
    {&Ds402Parameters::homingSpeed, above0, "homing speed (6099:1)"},
    {&Ds402Parameters::homingCreep, above0, "homing creep speed (6099:2)"},
    {&Ds402Parameters::homingAcceleration, above0, "homing acceleration (609A)"},
};

constexpr std::pair<std::uint16_t, std::int32_t Ds402Parameters::*> options[] = {
    {0x605A, &Ds402Parameters::quickStopOption},     {0x605B, &Ds402Parameters::shutdownOption},
    {0x605C, &Ds402Parameters::disableOption},       {0x605D, &Ds402Parameters::haltOption},
    {0x605E, &Ds402Parameters::faultReactionOption}, {0x6007, &Ds402Parameters::abortOption},
};

bool isWithin(double value, double min) { return value >= min && value <= greatestNumber; }

const NumberRow* wrongNumber(const Ds402Parameters& parameters) {
    for (const NumberRow& row : numbers)
        if (!isWithin(parameters.*row.member, row.min)) return &row;
    return nullptr;
}

// Its index in `options`; -1 where all are known values.
int wrongOption(const Ds402Parameters& parameters) {
    for (std::size_t i = 0; i < std::size(options); ++i)
        if (!isOption(options[i].first, parameters.*options[i].second)) return static_cast<int>(i);
    return -1;
}

std::string sentence(const NumberRow& row, double value) {
    char text[160];
    if (row.min == above0)
        std::snprintf(text, sizeof text, "The %s is %g; give a number above 0.", row.name, value);
    else
        std::snprintf(text, sizeof text, "The %s is %g; give a number from %g to %g.", row.name,
                      value, row.min, greatestNumber);
    return text;
}

std::string sentence(const Ds402OptionRow& row, std::int32_t value) {
    return "The " + std::string(row.name) + " is " + std::to_string(value) +
           "; it can be: " + std::string(row.values) + ".";
}

}  // namespace

bool isValid(const Ds402Parameters& parameters) noexcept {
    return !wrongNumber(parameters) && wrongOption(parameters) < 0 &&
           parameters.softMin <= parameters.softMax &&
           (parameters.supportedModes & ~ds402BuiltModes) == 0;
}

std::string whyNot(const Ds402Parameters& parameters) {
    if (const NumberRow* row = wrongNumber(parameters))
        return sentence(*row, parameters.*row->member);
    if (const int index = wrongOption(parameters); index >= 0) {
        const auto& [object, member] = options[index];
        for (const Ds402OptionRow& row : ds402Options)
            if (row.object == object) return sentence(row, parameters.*member);
    }
    if (parameters.softMin > parameters.softMax)
        return "The least position (607D:1) is above the greatest (607D:2); exchange them, or set "
               "both to 0 for no limits.";
    if ((parameters.supportedModes & ~ds402BuiltModes) != 0)
        return "The supported modes (6502) name one that is not built; " +
               whyNotMode(static_cast<int>(Ds402Mode::Velocity));
    return {};
}

bool isValid(const Ds402Axis& axis) noexcept {
    const bool switchesInOrder = axis.negativeSwitch < axis.positiveSwitch;  // not with NaN
    return isWithin(axis.inertia, above0) && isWithin(axis.damping, 0) &&
           isWithin(axis.effortShare, above0) && isWithin(axis.brakeTime, 0) &&
           isWithin(axis.selfTestTime, 0) && isWithin(axis.startPosition, -greatestNumber) &&
           isWithin(axis.overtravel, 0) && isWithin(axis.indexDistance, 0) && switchesInOrder &&
           !std::isnan(axis.homeSwitch);
}

}  // namespace cortex::drives
