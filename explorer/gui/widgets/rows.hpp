// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "style/look.hpp"
#include "style/shapes.hpp"

#include <QPainter>
#include <QStyleOptionViewItem>
#include <QTreeView>
#include <QTreeWidget>
#include <initializer_list>
#include <span>
#include <vector>

namespace cortex::gui {

// What all rows of tables and trees share.

// The background of a row: chosen, under the pointer, or `plain` (an invalid one: none).
void paintRow(QPainter& painter, const QStyleOptionViewItem& option, const QColor& plain = {});
// The colour of text on that background.
QColor rowInk(const QStyleOptionViewItem& option, const QColor& wanted);
// Text in one line, with … where it does not fit.
void paintText(QPainter& painter, const QRect& box, const QString& text, const QColor& colour,
               Qt::Alignment align = Qt::AlignLeft, bool strong = false,
               Qt::TextElideMode cut = Qt::ElideRight);
int textWidth(const QString& text, bool strong = false);

// Rows of one height, no frame, no grid; the header above, if there is one, is not moved.
void setUpRows(QTreeView& view);

// The widths of the first columns, in units; the last takes what is left.
void setWidths(QTreeView& view, std::span<const double> units);
inline void setWidths(QTreeView& view, std::initializer_list<double> units) {
    setWidths(view, std::span{units.begin(), units.size()});
}
// The same, and again whenever the size of texts changes.
void keepWidths(QTreeView& view, std::vector<double> units);
// Makes a column wider where one of its texts would be cut; it becomes narrower no more.
void growToFit(QTreeWidget& tree, int column);
// A strong row under which others stand.
QTreeWidgetItem* addGroup(QTreeWidget& tree, const QString& title);

// Sets the text of a cell, and its tooltip to the whole of it, where it has changed.
void setCell(QTreeWidgetItem& row, int column, const QString& text);
// Gives each cell that has no tooltip the whole of its text.
void tellWhole(QTreeWidget& tree);

// Pointer or keyboard is in it: its rows keep their places.
inline bool isUsed(const QAbstractItemView& view) { return view.underMouse() || view.hasFocus(); }

inline int rowHeight() { return Look::units(6); }
// Where a mark stands in a row.
inline QRectF markBox(int left, const QRect& row, int size) {
    return {static_cast<double>(left), row.top() + (row.height() - size) / 2.0,
            static_cast<double>(size), static_cast<double>(size)};
}
inline int markSize() { return Look::units(3.5); }

}  // namespace cortex::gui
