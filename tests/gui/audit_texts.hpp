// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QRect>
#include <QString>
#include <vector>

class QWidget;

namespace cortex::test {

// A piece of text as it was painted, after it was cut, wherever it comes from.
struct PaintedText {
    QString text;
    QRect box;  // in the window
};

// All pieces in the order in which the window paints them.
std::vector<PaintedText> paintedTexts(QWidget& window);

}  // namespace cortex::test
