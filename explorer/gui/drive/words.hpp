// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QString>
#include <vector>

// The bits of status word and control word by name; some have another meaning in each mode.
namespace cortex::explorer {

enum class BitKind { Plain, Warning, Error };

struct NamedBit {
    int mask;
    QString name;
    BitKind kind = BitKind::Plain;  // what it means while it is set

    bool operator==(const NamedBit&) const = default;
};

std::vector<NamedBit> statusBits(int mode);
std::vector<NamedBit> controlBits(int mode);

QString wordText(int word);  // "0x0637"
// The mode of operation: "cyclic synchronous position (8)", "none", "mode −3".
QString modeText(int mode);
QString modeLetters(int mode);  // "CSP"; of an unknown one its number

}  // namespace cortex::explorer
