// SPDX-License-Identifier: Apache-2.0
#include "widgets/rows.hpp"

#include <QFontMetrics>
#include <QHeaderView>

namespace cortex::explorer {

void paintRow(QPainter& painter, const QStyleOptionViewItem& option, const QColor& plain) {
    const Tokens& c = Look::colours();
    if (option.state.testFlag(QStyle::State_Selected))
        painter.fillRect(option.rect, c.select);
    else if (option.state.testFlag(QStyle::State_MouseOver))
        painter.fillRect(option.rect, c.hover);
    else if (plain.isValid())
        painter.fillRect(option.rect, plain);
}

QColor rowInk(const QStyleOptionViewItem& option, const QColor& wanted) {
    const bool selected = option.state.testFlag(QStyle::State_Selected);
    return selected && Look::theme() == Theme::HighContrast ? Look::colours().onAccent : wanted;
}

void paintText(QPainter& painter, const QRect& box, const QString& text, const QColor& colour,
               Qt::Alignment align, bool strong) {
    if (text.isEmpty() || box.width() <= 0) return;
    const QFont font = Look::font(TextSize::Text, strong);
    painter.setFont(font);
    painter.setPen(colour);
    const QString shown = QFontMetrics{font}.elidedText(text, Qt::ElideRight, box.width());
    painter.drawText(box, static_cast<int>(align | Qt::AlignVCenter) | Qt::TextSingleLine, shown);
}

int textWidth(const QString& text, bool strong) {
    return QFontMetrics{Look::font(TextSize::Text, strong)}.horizontalAdvance(text) + 1;
}

void setUpRows(QTreeView& view) {
    view.setUniformRowHeights(true);
    view.setFrameShape(QFrame::NoFrame);
    view.setAnimated(false);
    view.setMouseTracking(true);
    view.setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    view.setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
    view.setTextElideMode(Qt::ElideRight);
    view.header()->setHighlightSections(false);
    view.header()->setSectionsMovable(false);
    view.header()->setStretchLastSection(true);
    view.viewport()->setBackgroundRole(QPalette::Window);
}

void setWidths(QTreeView& view, std::initializer_list<double> units) {
    int column = 0;
    for (const double each : units) view.header()->resizeSection(column++, Look::units(each));
}

QTreeWidgetItem* addGroup(QTreeWidget& tree, const QString& title) {
    auto* item = new QTreeWidgetItem{&tree, {title}};
    item->setFirstColumnSpanned(true);
    item->setFont(0, Look::font(TextSize::Text, true));
    return item;
}

void setCell(QTreeWidgetItem& row, int column, const QString& text) {
    if (row.text(column) == text) return;
    row.setText(column, text);
    row.setToolTip(column, text.toHtmlEscaped());
}

void tellWhole(QTreeWidget& tree) {
    for (QTreeWidgetItemIterator each{&tree}; *each != nullptr; ++each) {
        for (int column = 0; column < tree.columnCount(); ++column) {
            if (!(*each)->toolTip(column).isEmpty()) continue;
            (*each)->setToolTip(column, (*each)->text(column).toHtmlEscaped());
        }
    }
}

}  // namespace cortex::explorer
