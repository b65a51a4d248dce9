// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include <QWidget>
#include <optional>

class QButtonGroup;
class QComboBox;
class QLineEdit;

namespace cortex::gui {

// Where the value of an item is entered: buttons for up to four labels and for true and false, a
// list for more labels, otherwise a field that says while typing what is wrong. The wheel changes
// nothing.
class ValueField : public QWidget {
    Q_OBJECT
public:
    explicit ValueField(const DataItem& item, QWidget* parent = nullptr);

    // None: nothing was entered, or what was entered is wrong.
    std::optional<Value> value() const;
    // What is wrong with what was entered; empty: nothing.
    QString problem() const;
    bool isEmpty() const;
    void setText(const QString& text);
    QString text() const;  // as it was entered or chosen

Q_SIGNALS:
    void changed();

private:
    void addChoices();
    void goToChosen();
    void addField();

    DataItem item_;
    QLineEdit* field_ = nullptr;  // one of these three
    QComboBox* list_ = nullptr;
    QButtonGroup* buttons_ = nullptr;
};

}  // namespace cortex::gui
