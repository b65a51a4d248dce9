// SPDX-License-Identifier: Apache-2.0
#include "widgets/item_field.hpp"

#include "model/plain_text.hpp"
#include "model/value_text.hpp"
#include "widgets/choice_list.hpp"

namespace cortex::gui {

ItemField::ItemField(const ItemModel::Row& row, QWidget* parent)
    : QLineEdit{parent},
      path_{row.path},
      item_{*row.item},
      element_{row.element},
      whole_{row.whole} {
    const DataItem item = ItemModel::entryItem(row);
    const auto choices = choicesOf(item);
    if (choices.empty()) return;
    choices_ = new ChoiceList{choices, item.kind != Kind::Bool, *this};
    connect(choices_, &ChoiceList::taken, this, [this] { Q_EMIT chosen(this); });
}

ItemField::~ItemField() { delete choices_; }

bool ItemField::follow(bool isValue) {
    isValue_ = isValue || isAsFilled();  // also of a number that has no label
    if (!choices_) return isValue_;
    const bool means = choices_->follow(text(), isValue_) || isValue_;
    choices_->setUseful(means || text().isEmpty());
    return means;
}

void ItemField::complete() {
    if (isValue_ || !choices_ || choices_->chosen().isEmpty()) return;
    setText(choices_->chosen());
    setModified(true);
}

void ItemField::fill(const QString& text) {
    if (filled_) return;
    filled_ = text;
    setText(visibleText(text));
}

QString ItemField::value() const { return meantText(text(), filled_.value_or(QString{})); }

ItemField::Kept ItemField::kept() const {
    Kept kept{path_, item_, element_, whole_, filled_, text(), cursorPosition()};
    if (hasSelectedText()) {
        kept.selected = selectionStart();
        kept.length = selectionLength();
    }
    kept.modified = isModified();
    kept.focused = hasFocus();
    return kept;
}

void ItemField::restore(const Kept& kept) {
    filled_ = kept.filled;
    setText(kept.text);
    setModified(kept.modified);
    if (kept.length > 0)
        setSelection(kept.selected, kept.length);
    else
        setCursorPosition(kept.cursor);
}

}  // namespace cortex::gui
