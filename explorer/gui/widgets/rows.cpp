// SPDX-License-Identifier: Apache-2.0
#include "widgets/rows.hpp"

#include "model/plain_text.hpp"

#include <QEvent>
#include <QFontMetrics>
#include <QHeaderView>
#include <algorithm>
#include <utility>

namespace cortex::gui {

namespace {

class WidthKeeper : public QObject {
public:
    WidthKeeper(QTreeView& view, std::vector<double> units)
        : QObject{&view}, view_{view}, units_{std::move(units)} {}

    bool eventFilter(QObject* /*object*/, QEvent* event) override {
        if (event->type() != QEvent::StyleChange && event->type() != QEvent::FontChange)
            return false;
        setWidths(view_, units_);
        auto* tree = qobject_cast<QTreeWidget*>(&view_);
        for (int column = 0; tree != nullptr && column < static_cast<int>(units_.size()); ++column)
            growToFit(*tree, column);
        return false;
    }

private:
    QTreeView& view_;
    const std::vector<double> units_;
};

}  // namespace

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
               Qt::Alignment align, bool strong, Qt::TextElideMode cut) {
    if (text.isEmpty() || box.width() <= 0) return;
    const QFont font = Look::font(TextSize::Text, strong);
    painter.setFont(font);
    painter.setPen(colour);
    const QString shown = QFontMetrics{font}.elidedText(text, cut, box.width());
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

void setWidths(QTreeView& view, std::span<const double> units) {
    int column = 0;
    const QAbstractItemModel& titles = *view.model();
    for (const double each : units) {
        const QString title = titles.headerData(column, Qt::Horizontal).toString();
        const int least = textWidth(title, false) + Look::units(5);
        view.header()->resizeSection(column++, std::max(Look::units(each), least));
    }
}

void keepWidths(QTreeView& view, std::vector<double> units) {
    setWidths(view, units);
    view.installEventFilter(new WidthKeeper{view, std::move(units)});
}

void growToFit(QTreeWidget& tree, int column) {
    const int width = tree.columnWidth(column);
    int needed = width;
    for (QTreeWidgetItemIterator each{&tree}; *each != nullptr; ++each) {
        if ((*each)->isFirstColumnSpanned()) continue;
        const int steps = column == 0 && (*each)->parent() != nullptr ? 2 : 1;
        const int indent = column == 0 && tree.rootIsDecorated() ? steps * tree.indentation() : 0;
        needed = std::max(needed, indent + textWidth((*each)->text(column)) + Look::units(5));
    }
    if (needed > width) tree.setColumnWidth(column, needed);
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
    row.setToolTip(column, tipText(text));
}

void tellWhole(QTreeWidget& tree) {
    for (QTreeWidgetItemIterator each{&tree}; *each != nullptr; ++each) {
        for (int column = 0; column < tree.columnCount(); ++column) {
            if (!(*each)->toolTip(column).isEmpty()) continue;
            (*each)->setToolTip(column, tipText((*each)->text(column)));
        }
    }
}

}  // namespace cortex::gui
