// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/item_model.hpp"

#include <QLineEdit>
#include <optional>
#include <string>

namespace cortex::gui {

// The field of an item in the table of data. It is filled once: what is typed stays in it, whatever
// comes meanwhile.
class ItemField : public QLineEdit {
public:
    // A field that was open when the rows were made anew.
    struct Kept {
        std::string path, item;
        std::size_t element = 0;
        bool whole = true;  // the item, not one of its elements
        std::optional<QString> filled;
        QString text;
        int cursor = 0, selected = 0, length = 0;
        bool modified = false, focused = false;
    };

    ItemField(const ItemModel::Row& row, QWidget* parent);

    void fill(const QString& text);  // the first time only
    bool isAsFilled() const { return !isModified() && text() == filled_; }
    Kept kept() const;
    void restore(const Kept& kept);

private:
    std::string path_, item_;
    std::size_t element_;
    bool whole_;
    std::optional<QString> filled_;
};

}  // namespace cortex::gui
