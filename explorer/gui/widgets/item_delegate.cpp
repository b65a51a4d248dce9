// SPDX-License-Identifier: Apache-2.0
#include "widgets/item_delegate.hpp"

#include "model/value_text.hpp"
#include "style/explorer_style.hpp"
#include "widgets/choice_list.hpp"
#include "widgets/entry_hint.hpp"
#include "widgets/item_field.hpp"
#include "widgets/item_table.hpp"
#include "widgets/item_widths.hpp"
#include "widgets/range_bar.hpp"
#include "widgets/rows.hpp"
#include "widgets/text_label.hpp"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <algorithm>

namespace cortex::gui {

namespace {

// Its field lies over the columns beside it.
bool isWide(const ItemModel::Row& row) {
    return (row.whole && row.item->length > 1) || row.item->kind == Kind::String;
}

// Such a field covers the column of units.
void putUnitInside(QLineEdit& field, const QString& unit) {
    auto* label = new TextLabel{TextSize::Text, false, &Tokens::ink2};
    label->show(unit);
    auto* across = new QHBoxLayout{&field};
    across->setContentsMargins(0, 0, Look::units(2), 0);
    across->addStretch(1);
    across->addWidget(label);
    field.setTextMargins(0, 0, textWidth(unit) + Look::units(3), 0);
}

// Whether the event ends what is entered, other than by giving it up.
bool ends(const QEvent& event) {
    if (event.type() == QEvent::FocusOut) return true;
    if (event.type() != QEvent::KeyPress) return false;
    const int key = static_cast<const QKeyEvent&>(event).key();
    return key == Qt::Key_Return || key == Qt::Key_Enter || key == Qt::Key_Tab ||
           key == Qt::Key_Backtab;
}

// What is not sent yet has a dot before it; what the agent has now stands beside it.
void paintEdited(QPainter& painter, const QStyleOptionViewItem& option, const ItemModel::Row& row) {
    paintText(painter, option.rect.adjusted(0, 0, -Look::units(2), 0),
              QStringLiteral("● ") + row.edited, rowInk(option, Look::colours().accent),
              Qt::AlignRight, true);
}

bool isLive(const ItemModel::Row& row) { return !row.mark || isBeyondLimits(row.mark); }

void paintRangeOf(QPainter& painter, const QStyleOptionViewItem& option, QRect box,
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

void paintRemark(QPainter& painter, const QStyleOptionViewItem& option, QRect box,
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

}  // namespace

ItemDelegate::ItemDelegate(const ItemModel& items, ItemTable* parent)
    : QStyledItemDelegate{parent}, items_{items} {}

QSize ItemDelegate::sizeHint(const QStyleOptionViewItem& /*option*/,
                             const QModelIndex& /*index*/) const {
    return {Look::units(10), static_cast<const ItemTable*>(parent())->rowHeight()};
}

void ItemDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option,
                         const QModelIndex& index) const {
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

QWidget* ItemDelegate::createEditor(QWidget* parent, const QStyleOptionViewItem& /*option*/,
                                    const QModelIndex& index) const {
    const ItemModel::Row row = items_.row(index);
    auto* field = new ItemField{row, parent};
    const QString name = QString::fromStdString(ItemModel::entryItem(row).name);
    field->setAccessibleName(row.unit.isEmpty() ? name : name + QStringLiteral(", ") + row.unit);
    if (isWide(row) && !row.unit.isEmpty()) putUnitInside(*field, row.unit);
    auto* hint = new EntryHint{*field};
    connect(field, &QLineEdit::textChanged, hint, [this, field, hint, row] {
        QString why;
        const bool means = field->follow(items_.entered(row, field->value(), why).has_value());
        field->setProperty(wrongInput, !means);
        hint->say(means ? QString{} : why);
        field->update();
    });
    connect(field, &ItemField::chosen, this, &ItemDelegate::take);
    return field;
}

void ItemDelegate::setEditorData(QWidget* editor, const QModelIndex& index) const {
    static_cast<ItemField*>(editor)->fill(index.data(Qt::EditRole).toString());
}

void ItemDelegate::setModelData(QWidget* editor, QAbstractItemModel* model,
                                const QModelIndex& index) const {
    const auto* field = static_cast<ItemField*>(editor);
    model->setData(index, field->isAsFilled() ? index.data(Qt::EditRole) : field->value());
}

// Nothing is sent by a click: the value is entered.
void ItemDelegate::take(QWidget* field) {
    Q_EMIT commitData(field);
    Q_EMIT closeEditor(field);
}

bool ItemDelegate::eventFilter(QObject* object, QEvent* event) {
    auto* field = qobject_cast<ItemField*>(object);
    if (field == nullptr || !ends(*event)) return QStyledItemDelegate::eventFilter(object, event);
    field->complete();
    if (!field->property(wrongInput).toBool())
        return QStyledItemDelegate::eventFilter(object, event);
    Q_EMIT commitData(field);  // it is refused, with the reason
    return event->type() == QEvent::KeyPress;
}

void ItemDelegate::updateEditorGeometry(QWidget* editor, const QStyleOptionViewItem& option,
                                        const QModelIndex& index) const {
    const ItemModel::Row& row = items_.row(index);
    QRect box = option.rect;
    if (isWide(row))
        box.setWidth(Look::units(usualItemWidths[ItemModel::Value] +
                                 usualItemWidths[ItemModel::Unit] +
                                 usualItemWidths[ItemModel::Range]));
    editor->setGeometry(box);
}

// Where the column of ranges has given way.
void ItemDelegate::paintLineOf(QPainter& painter, const QStyleOptionViewItem& option,
                               const ItemModel::Row& row) const {
    const auto* view = qobject_cast<const QTreeView*>(parent());
    if (view == nullptr || !view->isColumnHidden(ItemModel::Range)) return;
    if (!row.min || !row.max) return;
    paintRangeLine(painter, option.rect.adjusted(Look::units(2), 0, -Look::units(2), 0),
                   {*row.min, *row.max, row.number, isLive(row)});
}

}  // namespace cortex::gui
