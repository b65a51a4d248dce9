// SPDX-License-Identifier: Apache-2.0
#include "widgets/item_table.hpp"

#include "model/item_model.hpp"
#include "model/plain_text.hpp"
#include "model/plotted_items.hpp"
#include "model/value_text.hpp"
#include "style/explorer_style.hpp"
#include "widgets/entry_hint.hpp"
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

class ItemDelegate : public QStyledItemDelegate {
public:
    ItemDelegate(const ItemModel& items, ItemTable* parent)
        : QStyledItemDelegate{parent}, items_{items} {}

    QSize sizeHint(const QStyleOptionViewItem& /*option*/,
                   const QModelIndex& /*index*/) const override {
        return {Look::units(10), static_cast<const ItemTable*>(parent())->rowHeight()};
    }

    void paint(QPainter* painter, const QStyleOptionViewItem& option,
               const QModelIndex& index) const override {
        const ItemModel::Row& row = items_.row(index);
        if (row.item == nullptr) return;  // a group is painted as a whole
        const Tokens& c = Look::colours();
        const QRect box = option.rect.adjusted(Look::units(2), 0, -Look::units(2), 0);
        const bool outside = isBeyondLimits(row.mark);
        const QColor ink = rowInk(option, row.mark ? textColour(*row.mark, c) : c.ink);
        switch (index.column()) {
            case ItemModel::Name:
                paintText(*painter, box, row.name, rowInk(option, c.ink));
                break;
            case ItemModel::Value:
                if (!row.edited.isEmpty()) {
                    paintEdited(*painter, option, row);
                    break;
                }
                paintText(*painter, option.rect.adjusted(0, 0, -Look::units(2), 0), row.value, ink,
                          Qt::AlignRight, outside);
                paintLineOf(*painter, option, row);
                break;
            case ItemModel::Unit:
                paintText(*painter, box, row.unit, rowInk(option, c.ink2));
                break;
            case ItemModel::Range:
                paintRangeOf(*painter, option, box, row);
                break;
            case ItemModel::Remark:
                paintRemark(*painter, option, box, row);
                break;
            default:
                paintText(*painter, box, row.note, rowInk(option, c.ink2));
        }
    }

    QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem& /*option*/,
                          const QModelIndex& index) const override {
        const ItemModel::Row row = items_.row(index);
        auto* field = new ItemField{row, parent};
        const QString name = QString::fromStdString(ItemModel::entryItem(row).name);
        field->setAccessibleName(row.unit.isEmpty() ? name
                                                    : name + QStringLiteral(", ") + row.unit);
        if (isWide(row) && !row.unit.isEmpty()) putUnitInside(*field, row.unit);
        auto* hint = new EntryHint{*field};
        connect(field, &QLineEdit::textChanged, hint, [this, field, hint, row] {
            QString why;
            field->setProperty(wrongInput, !items_.entered(row, field->text(), why));
            hint->say(why);
            field->update();
        });
        return field;
    }

    void setEditorData(QWidget* editor, const QModelIndex& index) const override {
        static_cast<ItemField*>(editor)->fill(index.data(Qt::EditRole).toString());
    }

    // A field that is left as it was opened enters nothing, whatever the value is by now.
    void setModelData(QWidget* editor, QAbstractItemModel* model,
                      const QModelIndex& index) const override {
        const auto* field = static_cast<ItemField*>(editor);
        model->setData(index, field->isAsFilled() ? index.data(Qt::EditRole) : field->text());
    }

    // A field whose text is wrong stays open with it; Esc gives it up.
    bool eventFilter(QObject* object, QEvent* event) override {
        auto* field = qobject_cast<QLineEdit*>(object);
        if (field == nullptr || !field->property(wrongInput).toBool() || !ends(*event)) {
            return QStyledItemDelegate::eventFilter(object, event);
        }
        Q_EMIT commitData(field);  // it is refused, with the reason
        return event->type() == QEvent::KeyPress;
    }

    void updateEditorGeometry(QWidget* editor, const QStyleOptionViewItem& option,
                              const QModelIndex& index) const override {
        const ItemModel::Row& row = items_.row(index);
        QRect box = option.rect;
        if (isWide(row))
            box.setWidth(Look::units(usualItemWidths[ItemModel::Value] +
                                     usualItemWidths[ItemModel::Unit] +
                                     usualItemWidths[ItemModel::Range]));
        editor->setGeometry(box);
    }

private:
    // Its field lies over the columns beside it.
    static bool isWide(const ItemModel::Row& row) {
        return (row.whole && row.item->length > 1) || row.item->kind == Kind::String;
    }

    // Such a field covers the column of units.
    static void putUnitInside(QLineEdit& field, const QString& unit) {
        auto* label = new TextLabel{TextSize::Text, false, &Tokens::ink2};
        label->show(unit);
        auto* across = new QHBoxLayout{&field};
        across->setContentsMargins(0, 0, Look::units(2), 0);
        across->addStretch(1);
        across->addWidget(label);
        field.setTextMargins(0, 0, textWidth(unit) + Look::units(3), 0);
    }

    // Whether the event ends what is entered, other than by giving it up.
    static bool ends(const QEvent& event) {
        if (event.type() == QEvent::FocusOut) return true;
        if (event.type() != QEvent::KeyPress) return false;
        const int key = static_cast<const QKeyEvent&>(event).key();
        return key == Qt::Key_Return || key == Qt::Key_Enter || key == Qt::Key_Tab ||
               key == Qt::Key_Backtab;
    }

    // What is not sent yet has a dot before it; what the agent has now stands beside it.
    static void paintEdited(QPainter& painter, const QStyleOptionViewItem& option,
                            const ItemModel::Row& row) {
        paintText(painter, option.rect.adjusted(0, 0, -Look::units(2), 0),
                  QStringLiteral("● ") + row.edited, rowInk(option, Look::colours().accent),
                  Qt::AlignRight, true);
    }

    // Where the column of ranges has given way.
    void paintLineOf(QPainter& painter, const QStyleOptionViewItem& option,
                     const ItemModel::Row& row) const {
        const auto* view = qobject_cast<const QTreeView*>(parent());
        if (view == nullptr || !view->isColumnHidden(ItemModel::Range)) return;
        if (!row.min || !row.max) return;
        paintRangeLine(painter, option.rect.adjusted(Look::units(2), 0, -Look::units(2), 0),
                       {*row.min, *row.max, row.number, isLive(row)});
    }

    static bool isLive(const ItemModel::Row& row) { return !row.mark || isBeyondLimits(row.mark); }

    static void paintRangeOf(QPainter& painter, const QStyleOptionViewItem& option, QRect box,
                             const ItemModel::Row& row) {
        if (!row.min && !row.max) return;
        const QColor ink = rowInk(option, Look::colours().ink2);
        int side = std::max((box.width() - Look::units(leastTrack)) / 2, 0);
        const auto& [least, most] = limitsOf(row);
        if (std::max(textWidth(least), textWidth(most)) > side) side = 0;  // whole, or not at all
        paintText(painter, {box.left(), box.top(), side, box.height()}, least, ink, Qt::AlignRight);
        paintText(painter, {box.right() - side, box.top(), side, box.height()}, most, ink);
        if (!row.min || !row.max) return;
        paintRange(painter, box.adjusted(side, 0, -side, 0),
                   {*row.min, *row.max, row.number, isLive(row)});
    }

    static void paintRemark(QPainter& painter, const QStyleOptionViewItem& option, QRect box,
                            const ItemModel::Row& row) {
        const Tokens& c = Look::colours();
        if (!row.edited.isEmpty()) {
            paintText(painter, box, ItemTable::tr("now %1").arg(row.value), rowInk(option, c.ink));
            return;
        }
        if (!row.mark) {
            paintText(painter, box, row.remark, rowInk(option, c.ink2));
            return;
        }
        const int size = markSize();
        cortex::gui::paint(painter, markBox(box.left(), box, size), *row.mark, c);
        box.setLeft(box.left() + size + Look::units(1.5));
        paintText(painter, box, word(*row.mark), rowInk(option, textColour(*row.mark, c)),
                  Qt::AlignLeft, true);
    }

    const ItemModel& items_;
};

}  // namespace

ItemTable::ItemTable(ItemModel& model, QWidget* parent) : QTreeView{parent}, items_{model} {
    setModel(&model);
    setItemDelegate(new ItemDelegate{model, this});
    setUpRows(*this);
    setAccessibleName(tr("Data"));
    setSelectionBehavior(SelectRows);
    setDragEnabled(true);
    setDragDropMode(DragOnly);
    setEditTriggers(DoubleClicked | EditKeyPressed);
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

// Whatever column the cursor is in: it is the value that is edited. Tab goes on to the next one.
bool ItemTable::edit(const QModelIndex& index, EditTrigger trigger, QEvent* event) {
    const QModelIndex value = index.siblingAtColumn(ItemModel::Value);
    const bool asked = trigger == DoubleClicked || trigger == EditKeyPressed;
    if (asked && state() == EditingState) {  // a wrong one comes first
        if (auto* open = openField()) open->setFocus();
        return false;
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
    } while (next.isValid() && !items_.settable(next));
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

ItemField* ItemTable::openField() const {
    for (auto* each : viewport()->findChildren<QLineEdit*>()) {
        auto* field = dynamic_cast<ItemField*>(each);
        if (field != nullptr && !field->isHidden()) return field;  // one that was closed is hidden
    }
    return nullptr;
}

// What is typed outlasts the rows, which are made anew where an agent starts anew.
void ItemTable::keepField() {
    if (const ItemField* field = openField()) kept_ = field->kept();
}

QModelIndex ItemTable::cellOf(const ItemField::Kept& field) const {
    for (int group = 0; group < items_.rowCount(); ++group) {
        const QModelIndex above = items_.index(group, 0);
        for (int row = 0; row < items_.rowCount(above); ++row) {
            const QModelIndex cell = items_.index(row, ItemModel::Value, above);
            const ItemModel::Row& each = items_.row(cell);
            if (each.item == nullptr || each.path != field.path || each.item->name != field.item)
                continue;
            const QModelIndex whole = cell.siblingAtColumn(0);
            const int element = static_cast<int>(field.element);
            return field.whole ? cell : items_.index(element, ItemModel::Value, whole);
        }
    }
    return {};
}

void ItemTable::openKept() {
    if (!kept_) return;
    if (kept_->path != items_.path()) return kept_.reset();
    const QModelIndex cell = cellOf(*kept_);
    if (!items_.settable(cell)) {  // its simplex may come again; the keyboard is elsewhere then
        kept_->focused = false;
        return;
    }
    const ItemField::Kept kept = *std::exchange(kept_, std::nullopt);
    QWidget* elsewhere = kept.focused ? nullptr : QApplication::focusWidget();
    setExpanded(cell.parent(), true);
    setCurrentIndex(cell);
    if (!edit(cell, AllEditTriggers, nullptr)) return;
    if (ItemField* field = openField()) field->restore(kept);
    if (elsewhere != nullptr) elsewhere->setFocus();
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
