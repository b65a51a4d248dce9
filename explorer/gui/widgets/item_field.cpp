// SPDX-License-Identifier: Apache-2.0
#include "widgets/item_field.hpp"

namespace cortex::gui {

ItemField::ItemField(const ItemModel::Row& row, QWidget* parent)
    : QLineEdit{parent},
      path_{row.path},
      item_{row.item->name},
      element_{row.element},
      whole_{row.whole} {}

void ItemField::fill(const QString& text) {
    if (filled_) return;
    filled_ = text;
    setText(text);
}

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
