// SPDX-License-Identifier: Apache-2.0
#include "drive/axis_reasons.hpp"

#include "cortex/drives/ds402_words.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

namespace cortex::explorer {

namespace {

using enum drives::Ds402State;

constexpr double runningOutcome = 2;  // label of the item `outcome`
constexpr int homingMode = static_cast<int>(drives::Ds402Mode::Homing);

QString reason(const char* text) { return QCoreApplication::translate("Drive", text); }

QString whyNotEnabled(const DriveAxis& axis, bool homes) {
    if (homes) return reason("homing runs");
    switch (axis.state) {
        case OperationEnabled:
            return reason("is enabled");
        case Fault:
            return reason("is in Fault");
        case FaultReactionActive:
            return reason("it brakes");
        case NotReadyToSwitchOn:
            return reason("is not ready");
        case Unknown:
            return reason("unknown");
        default:
            return axis.wanted == OperationEnabled ? reason("is under way") : QString{};
    }
}

// What stops an axis is off only where it is certain that it has no power.
QString whyNotStopped(const DriveAxis& axis) {
    if (!axis.live()) return {};
    if (axis.state == Fault) return reason("is in Fault");
    const bool off = axis.state == SwitchOnDisabled || axis.state == NotReadyToSwitchOn;
    return off ? reason("no power") : QString{};
}

QString whyNotReset(const DriveAxis& axis) {
    if (axis.state == Fault) return {};
    return axis.state == FaultReactionActive ? reason("it brakes") : reason("no fault");
}

QString whyNotHomed(const DriveAxis& axis, const Homing& homing) {
    if (homing.runs) return reason("homing runs");
    if (!axis.homingNeeded) return reason("its encoder needs no homing");
    return axis.state == OperationEnabled ? QString{} : reason("needs Operation enabled");
}

}  // namespace

bool Homing::isOf(const DriveAxis& axis, const std::vector<DriveAxis>& all) const {
    const auto inMode = [](const DriveAxis& each) { return each.mode == homingMode; };
    return runs && (inMode(axis) || std::ranges::none_of(all, inMode));
}

Homing homingOf(const SimplexNow& processor) {
    Homing homing;
    if (!processor.text("activity").contains(QLatin1String{"home"})) return homing;
    homing.runs = processor.state().has_value() && processor.number("outcome") == runningOutcome;
    const double progress = processor.number("progress").value_or(0);
    homing.progress = std::isfinite(progress) ? std::clamp(progress, 0.0, 1.0) : 0;
    homing.requester = processor.text("requester");
    const auto outcome = processor.number("outcome");
    const bool wrong = outcome && *outcome > runningOutcome;
    if (wrong) homing.outcome = processor.text("outcome");
    return homing;
}

AxisReasons reasonsOf(const DriveAxis& axis, const Homing& homing, bool homes,
                      const std::function<QString(const char*)>& ask) {
    const auto because = [&](const char* command, const QString& ofState) {
        QString why = ask(command);
        if (!why.isEmpty()) return why;
        return axis.live() ? ofState : axis.trouble;
    };
    const QString runs = homes ? reason("homing runs") : QString{};
    AxisReasons reasons;
    reasons.all = ask("resetFault");  // which is always available
    reasons.enable = because("enable", whyNotEnabled(axis, homes));
    reasons.disable =
        because("disable", axis.state == OperationEnabled ? runs : reason("not enabled"));
    reasons.quickStop = ask("quickStop");
    if (reasons.quickStop.isEmpty()) reasons.quickStop = whyNotStopped(axis);
    reasons.resetFault = because("resetFault", whyNotReset(axis));
    reasons.step = because("step", runs);
    reasons.stepToEnabled = reasons.step.isEmpty() ? ask("enable") : reasons.step;
    reasons.setMode = because("setMode", runs);
    reasons.home = because("home", whyNotHomed(axis, homing));
    return reasons;
}

}  // namespace cortex::explorer
