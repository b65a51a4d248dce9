// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/item_model.hpp"

#include <QLineEdit>
#include <QPointer>
#include <optional>
#include <string>

namespace cortex::gui {

class ChoiceList;

// The field of an item in the table of data. It is filled once: what is typed stays in it, whatever
// comes meanwhile. Beside it is a list of the labels, where there are some.
class ItemField : public QLineEdit {
    Q_OBJECT
public:
    // A field that was open when the rows were made anew.
    struct Kept {
        std::string path;
        DataItem item;  // as it was then
        std::size_t element = 0;
        bool whole = true;  // the item, not one of its elements
        std::optional<QString> filled;
        QString text;
        int cursor = 0, selected = 0, length = 0;
        bool modified = false, focused = false;
    };

    ItemField(const ItemModel::Row& row, QWidget* parent);
    ~ItemField() override;

    void fill(const QString& text);  // the first time only
    bool isAsFilled() const { return !isModified() && value() == filled_; }
    // What is meant: what is unseen in it has a sign in the field, and is as it was.
    QString value() const;
    Kept kept() const;
    void restore(const Kept& kept);
    // The text has changed, and is a value or not. True: with the list it means one.
    bool follow(bool isValue);
    void complete();  // what was begun is the label that is chosen in the list

Q_SIGNALS:
    void chosen(QWidget* field);  // in the list, with the mouse

private:
    std::string path_;
    DataItem item_;
    std::size_t element_;
    bool whole_;
    std::optional<QString> filled_;
    QPointer<ChoiceList> choices_;
    bool isValue_ = true;
};

}  // namespace cortex::gui
