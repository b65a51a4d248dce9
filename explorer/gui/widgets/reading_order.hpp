// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QPoint>
#include <vector>

class QWidget;

namespace cortex::gui {

// Where a widget begins within its window, for one who reads.
QPoint readingPlace(const QWidget& widget);

// What Tab reaches in a part of a window: line by line, and from left to right.
std::vector<QWidget*> readingOrder(QWidget& part);

// A table or list with rows that is large enough to be worked in.
bool isTable(const QWidget& widget);

// Where the keyboard goes when a part is opened: its first table with rows, otherwise the first
// that Tab reaches. Null: there is none.
QWidget* mainStop(QWidget& part);

}  // namespace cortex::gui
