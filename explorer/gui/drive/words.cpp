// SPDX-License-Identifier: Apache-2.0
#include "drive/words.hpp"

#include "cortex/drives/ds402_words.hpp"

#include <QCoreApplication>

namespace cortex::explorer {

namespace {

using drives::Ds402Control;
using drives::Ds402Mode;
using drives::Ds402Status;

QString wordOf(const char* text) { return QCoreApplication::translate("Drive", text); }

bool isIn(int mode, std::initializer_list<Ds402Mode> modes) {
    for (const Ds402Mode each : modes) {
        if (static_cast<int>(each) == mode) return true;
    }
    return false;
}

bool isCyclic(int mode) {
    return isIn(mode,
                {Ds402Mode::CyclicPosition, Ds402Mode::CyclicVelocity, Ds402Mode::CyclicTorque});
}

QString bit12(int mode) {
    if (isIn(mode, {Ds402Mode::Homing})) return wordOf("homing attained");
    if (isIn(mode, {Ds402Mode::ProfilePosition})) return wordOf("set-point taken");
    if (isIn(mode, {Ds402Mode::ProfileVelocity})) return wordOf("speed is 0");
    return isCyclic(mode) ? wordOf("follows target") : wordOf("bit 12");
}

QString bit13(int mode) {
    if (isIn(mode, {Ds402Mode::Homing})) return wordOf("homing error");
    return isIn(mode, {Ds402Mode::ProfilePosition, Ds402Mode::CyclicPosition})
               ? wordOf("following error")
               : wordOf("bit 13");
}

QString bit4(int mode) {
    if (isIn(mode, {Ds402Mode::Homing})) return wordOf("start homing");
    return isIn(mode, {Ds402Mode::ProfilePosition}) ? wordOf("new set-point") : wordOf("bit 4");
}

}  // namespace

std::vector<NamedBit> statusBits(int mode) {
    const bool errs =
        isIn(mode, {Ds402Mode::Homing, Ds402Mode::ProfilePosition, Ds402Mode::CyclicPosition});
    return {{Ds402Status::voltageEnabled, wordOf("voltage enabled")},
            {Ds402Status::warning, wordOf("warning"), BitKind::Warning},
            {Ds402Status::remote, wordOf("remote")},
            {Ds402Status::targetReached, wordOf("target reached")},
            {Ds402Status::internalLimit, wordOf("internal limit"), BitKind::Warning},
            {Ds402Status::homingAttained, bit12(mode)},
            {Ds402Status::homingError, bit13(mode), errs ? BitKind::Error : BitKind::Plain}};
}

std::vector<NamedBit> controlBits(int mode) {
    return {
        {0x0001, wordOf("switch on")},           {0x0002, wordOf("enable voltage")},
        {0x0004, wordOf("no quick stop")},       {0x0008, wordOf("enable operation")},
        {Ds402Control::startHoming, bit4(mode)}, {Ds402Control::faultReset, wordOf("fault reset")},
        {Ds402Control::halt, wordOf("halt")}};
}

QString wordText(int word) {
    return QStringLiteral("0x%1").arg(word, 4, 16, QLatin1Char{'0'}).toUpper().replace('X', 'x');
}

QString modeText(int mode) {
    if (mode == 0) return wordOf("none");
    const drives::Ds402ModeRow* row = drives::modeRow(mode);
    const QString number = QString::number(mode).replace('-', QChar{0x2212});
    if (row == nullptr) return wordOf("mode %1").arg(number);
    return QStringLiteral("%1 (%2)").arg(
        QLatin1String{row->name.data(), static_cast<int>(row->name.size())}, number);
}

QString modeLetters(int mode) {
    const drives::Ds402ModeRow* row = drives::modeRow(mode);
    return row != nullptr
               ? QString{QLatin1String{row->letters.data(), static_cast<int>(row->letters.size())}}
               : QString::number(mode);
}

}  // namespace cortex::explorer
