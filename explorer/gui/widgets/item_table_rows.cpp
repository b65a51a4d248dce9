// SPDX-License-Identifier: Apache-2.0
// Rows of the table of data that are looked for: that of an item, and that of a field that was
// open.
#include "model/item_model.hpp"
#include "model/plain_text.hpp"
#include "session/item_meaning.hpp"
#include "widgets/item_table.hpp"

#include <QApplication>
#include <QLineEdit>
#include <utility>

namespace cortex::gui {

bool ItemTable::choose(const std::string& item) {
    ItemField::Kept wanted;
    wanted.path = items_.path();
    wanted.item.name = item;
    const QModelIndex cell = cellOf(wanted);
    if (!cell.isValid()) return false;
    setExpanded(cell.parent(), true);
    setCurrentIndex(cell);
    scrollTo(cell);
    setFocus(Qt::TabFocusReason);
    return true;
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
            if (each.item == nullptr || each.path != field.path ||
                each.item->name != field.item.name)
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
    if (!meansTheSame(*items_.row(cell).item, kept.item)) {
        Q_EMIT items_.setAside(items_.path(), {plainText(kept.item.name)});
        return;
    }
    QWidget* elsewhere = kept.focused ? nullptr : QApplication::focusWidget();
    setExpanded(cell.parent(), true);
    setCurrentIndex(cell);
    if (!edit(cell, AllEditTriggers, nullptr)) return;
    if (ItemField* field = openField()) field->restore(kept);
    if (elsewhere != nullptr) elsewhere->setFocus();
}

}  // namespace cortex::gui
