// SPDX-License-Identifier: Apache-2.0
// What the band of an axis shows.
#include "drive/action_row.hpp"
#include "drive/axis_band.hpp"
#include "drive/homing_row.hpp"
#include "drive/state_diagram.hpp"
#include "drive/transitions.hpp"
#include "drive/word_table.hpp"
#include "motion/choices.hpp"
#include "motion/labels.hpp"

#include <QLabel>
#include <QPushButton>

namespace cortex::explorer {

namespace {

bool isAFault(Ds402State state) {
    return state == Ds402State::Fault || state == Ds402State::FaultReactionActive;
}

// "Fault 0x8611, following error"; who names the error may name its code, too.
QString faultText(const DriveAxis& axis) {
    QString name = nameOfState(axis.state), code = wordText(axis.errorCode);
    if (axis.errorCode == 0) return name;
    if (axis.error.isEmpty()) return name + ' ' + code;
    return axis.error.contains(code, Qt::CaseInsensitive)
               ? AxisBand::tr("%1: %2").arg(name, axis.error)
               : AxisBand::tr("%1 %2, %3").arg(name, code, axis.error);
}

// "Switched on, led to Operation enabled".
QString stateText(const DriveAxis& axis) {
    QString text =
        axis.state == Ds402State::Unknown ? AxisBand::tr("State unknown") : nameOfState(axis.state);
    if (isAFault(axis.state)) text = faultText(axis);
    if (!axis.live()) return '[' + text + ']';
    const bool led = axis.wanted != Ds402State::Unknown && axis.wanted != axis.state;
    return led ? AxisBand::tr("%1, led to %2").arg(text, nameOfState(axis.wanted)) : text;
}

QString torqueText(const DriveAxis& axis) {
    const drives::Ds402StateRow* row = drives::rowOf(axis.state);
    if (row == nullptr || !axis.live()) return {};
    return row->torque  ? AxisBand::tr("torque on")
           : row->power ? AxisBand::tr("power on, no torque")
                        : AxisBand::tr("power off");
}

QString countsText(const DriveAxis& axis) {
    QStringList parts{
        torqueText(axis),
        AxisBand::tr("last transition %1 of %2").arg(axis.lastTransition, axis.transitions),
        AxisBand::tr("%1 refused").arg(axis.refused)};
    parts.removeAll({});
    return parts.join(QStringLiteral(", "));
}

}  // namespace

void AxisBand::show(const DriveAxis& axis, const BandLook& look) {
    axis_ = axis;
    showState(axis, look);
    actions_->show(look.reasons);
    showModes(axis, look);
    homing_->show(axis, look.homing, look.homes, look.reasons, look.whyNoCancel);
    showWords(axis, look);
    QStringList why;
    if (!axis.live()) why << axis.trouble + '.';
    why << actions_->longReasons();
    why.removeAll({});
    why_->say(why.join(' '), axis.live() ? Tone::Quiet : Tone::NotLive);
}

void AxisBand::showState(const DriveAxis& axis, const BandLook& look) {
    diagram_->show({axis.state, axis.live(), axis.quickStopOption, look.reasons.step,
                    look.reasons.stepToEnabled});
    const QString possible = transitionsFrom(axis.state, axis.quickStopOption);
    next_->say(!axis.live()         ? QString{}
               : possible.isEmpty() ? tr("Nothing can be asked for in this state.")
                                    : tr("From here: %1.").arg(possible));
    state_->say(stateText(axis), !axis.live()           ? std::optional{Tone::NotLive}
                                 : isAFault(axis.state) ? std::optional{Tone::Fault}
                                                        : std::nullopt);
    const int wide = state_->fontMetrics().horizontalAdvance(state_->text());
    const bool isLong = wide > middle_->width();
    state_->keepLines(isLong ? 2 : 1);
    counts_->say(countsText(axis));
    counts_->setVisible(!isLong);
}

void AxisBand::showModes(const DriveAxis& axis, const BandLook& look) {
    modes_->show(axis.live() && axis.mode ? QString::number(*axis.mode) : QString{});
    modes_->setWhyNot(look.reasons.setMode);
    if (!axis.mode) {
        mode_->say(tr("The mode of its drive is not known."));
        return;
    }
    const bool asked =
        axis.live() && axis.told && axis.wishedMode && *axis.wishedMode != *axis.mode;
    if (asked) {
        mode_->say(tr("The drive shows %1; asked for %2.")
                       .arg(modeLetters(*axis.mode), modeLetters(*axis.wishedMode)));
        return;
    }
    const QString mode = axis.live() ? modeText(*axis.mode) : '[' + modeText(*axis.mode) + ']';
    mode_->say(tr("The drive shows %1.").arg(mode));
}

void AxisBand::showWords(const DriveAxis& axis, const BandLook& look) {
    const int mode = axis.mode.value_or(0);
    words_->show(
        {tr("status"), axis.statusWord, axis.live(), statusBits(mode)},
        {tr("control"), axis.controlWord, axis.told, controlBits(axis.wishedMode.value_or(mode))});
    std::array<ShownDriveNumber, 3> numbers;
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = {axis.numbers[i], look.shown[i]};
    numbers_->show(numbers, axis.live(), axis.told);
}

}  // namespace cortex::explorer
