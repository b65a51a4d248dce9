// SPDX-License-Identifier: Apache-2.0
#include "widgets/item_table.hpp"

#include "model/item_model.hpp"
#include "model/plain_text.hpp"
#include "model/plotted_items.hpp"
#include "model/value_text.hpp"
#include "style/explorer_style.hpp"
#include "widgets/entry_hint.hpp"
#include "widgets/item_delegate.hpp"
#include "widgets/item_drag.hpp"
#include "widgets/item_widths.hpp"
#include "widgets/range_bar.hpp"
#include "widgets/rows.hpp"
#include "widgets/text_label.hpp"

#include <QApplication>
#include <QDrag>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLineEdit>
#include <QStyledItemDelegate>
#include <algorithm>
#include <array>
#include <utility>

namespace cortex::gui {

namespace {

constexpr double rounding = 0.01;  // units
constexpr int mostOpenRows = 20;   // of a related simplex; one with more is closed at first

// A character, not one of the keys that do something.
bool isTyped(const QEvent* event) {
    const bool key = event != nullptr && (event->type() == QEvent::KeyPress ||
                                          event->type() == QEvent::ShortcutOverride);
    if (!key) return false;
    const QString text = static_cast<const QKeyEvent*>(event)->text();
    return !text.isEmpty() && text[0].isPrint() && !text[0].isSpace();
}

}  // namespace

ItemTable::ItemTable(ItemModel& model, QWidget* parent) : QTreeView{parent}, items_{model} {
    setModel(&model);
    setItemDelegate(new ItemDelegate{model, this});
    setUpRows(*this);
    setAccessibleName(tr("Data"));
    setSelectionBehavior(SelectRows);
    setDragEnabled(true);
    setDragDropMode(DragOnly);
    setEditTriggers(DoubleClicked | EditKeyPressed | AnyKeyPressed);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    connect(&model, &QAbstractItemModel::modelAboutToBeReset, this, &ItemTable::keepField);
    connect(&model, &QAbstractItemModel::modelReset, this, &ItemTable::openGroups);
    connect(&model, &QAbstractItemModel::modelReset, this, &ItemTable::openKept);
    connect(&model, &QAbstractItemModel::dataChanged, this, [this] {
        if (items_.units() != units_ || longestValue(items_) > longest_) fitColumns();
    });
    openGroups();
}

void ItemTable::setLow(bool low) {
    if (low == low_) return;
    low_ = low;
    header()->setVisible(!low);
    fitColumns();
    scheduleDelayedItemsLayout();
}

int ItemTable::rowHeight() const { return low_ ? fontMetrics().height() : gui::rowHeight(); }

// To a plot, or as text to another program.
void ItemTable::startDrag(Qt::DropActions /*actions*/) {
    const auto dragged = plottedItems(items_, currentIndex());
    if (dragged.empty()) return;
    auto* drag = new QDrag{this};
    drag->setMimeData(mimeOf(dragged));
    drag->exec(Qt::CopyAction);
}

// A text, or a label that begins with it.
bool ItemTable::beginsValue(const QKeyEvent& event) const {
    constexpr Qt::KeyboardModifiers none = Qt::ShiftModifier | Qt::KeypadModifier;
    const bool plain = (event.modifiers() & ~none) == 0 && isTyped(&event);
    if (!plain || !items_.settable(currentIndex())) return false;
    const DataItem& item = *items_.row(currentIndex()).item;
    const auto choices = choicesOf(item);
    return choices.empty() ? item.kind == Kind::String
                           : std::ranges::any_of(choices, [&](const auto& each) {
                                 return each.second.startsWith(event.text(), Qt::CaseInsensitive);
                             });
}

bool ItemTable::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride && state() != EditingState &&
        beginsValue(*static_cast<QKeyEvent*>(event))) {
        event->accept();
        return true;
    }
    return QTreeView::event(event);
}

// Whatever column the cursor is in: it is the value that is edited. What is typed begins it, too.
// Tab goes on to the next one.
bool ItemTable::edit(const QModelIndex& index, EditTrigger trigger, QEvent* event) {
    const QModelIndex value = index.siblingAtColumn(ItemModel::Value);
    if (trigger == AnyKeyPressed && !isTyped(event)) return false;
    const bool asked =
        trigger == DoubleClicked || trigger == EditKeyPressed || trigger == AnyKeyPressed;
    if (asked && state() == EditingState) {  // a wrong one comes first
        if (auto* open = openField()) open->setFocus();
        return trigger == AnyKeyPressed;
    }
    return QTreeView::edit(asked ? value : index, trigger, event);
}

void ItemTable::closeEditor(QWidget* editor, QAbstractItemDelegate::EndEditHint hint) {
    using Delegate = QAbstractItemDelegate;
    QTreeView::closeEditor(editor, Delegate::NoHint);
    if (hint == Delegate::SubmitModelCache) Q_EMIT submitted();
    if (hint == Delegate::RevertModelCache) Q_EMIT givenUp();
    if (hint != Delegate::EditNextItem && hint != Delegate::EditPreviousItem) return;
    QModelIndex next = currentIndex();
    do {
        next = hint == Delegate::EditNextItem ? indexBelow(next) : indexAbove(next);
    } while (next.isValid() && (!items_.settable(next) || isExpanded(next.siblingAtColumn(0))));
    if (!next.isValid()) return;
    setCurrentIndex(next.siblingAtColumn(ItemModel::Value));
    QTreeView::edit(currentIndex());
}

void ItemTable::openGroups() {
    for (int i = 0; i < items_.rowCount(); ++i) {
        const QModelIndex group = items_.index(i, 0);
        setFirstColumnSpanned(i, {}, true);
        setExpanded(group, items_.rowCount(group) <= mostOpenRows);
    }
    fitColumns();
}

void ItemTable::resizeEvent(QResizeEvent* event) {
    QTreeView::resizeEvent(event);
    fitColumns();
}

void ItemTable::changeEvent(QEvent* event) {
    QTreeView::changeEvent(event);
    if (event->type() == QEvent::FontChange || event->type() == QEvent::StyleChange) fitColumns();
}

// The description gives way first, then the range, which becomes a line under the value. A mark
// keeps its word.
void ItemTable::fitColumns() {
    units_ = items_.units();
    longest_ = longestValue(items_);
    const double indent = low_ ? 2 : 4;
    setIndentation(Look::units(indent));
    double left = viewport()->width() / Look::length(1);
    const ItemWidths widths = itemWidths(widestTexts(items_), left, 2 * indent);
    bool all = true;
    for (const int column : {ItemModel::Name, ItemModel::Value, ItemModel::Unit, ItemModel::Remark,
                             ItemModel::Range, ItemModel::Description}) {
        const double width = widths[static_cast<std::size_t>(column)];
        const bool fits = column <= ItemModel::Unit || (all && left >= width - rounding);
        all = all && fits;
        setColumnHidden(column, !fits);
        if (fits) {
            header()->resizeSection(column, Look::units(width));
            left -= width;
        }
    }
}

void ItemTable::drawRow(QPainter* painter, const QStyleOptionViewItem& option,
                        const QModelIndex& index) const {
    const Tokens& c = Look::colours();
    const ItemModel::Row& row = items_.row(index);
    QStyleOptionViewItem whole = option;
    if (selectionModel()->isRowSelected(index.row(), index.parent())) {
        whole.state |= QStyle::State_Selected;
    }
    const bool outside = isBeyondLimits(row.mark);
    paintRow(*painter, whole, row.item == nullptr ? c.hover : outside ? c.warnBg : QColor{});
    QTreeView::drawRow(painter, option, index);
    if (row.item != nullptr) return;
    QRect box = option.rect.adjusted(Look::units(8), 0, -Look::units(2), 0);
    paintText(*painter, box, row.name, rowInk(whole, c.ink), Qt::AlignLeft, true);
    box.setLeft(box.left() + textWidth(row.name, true) + Look::units(4));
    paintText(*painter, box, row.value, rowInk(whole, c.accent));
    box.setLeft(box.left() + textWidth(row.value) + Look::units(4));
    paintText(*painter, box, row.note, rowInk(whole, c.ink2));
}

}  // namespace cortex::gui
