// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/item_model.hpp"

#include <QStyledItemDelegate>

namespace cortex::gui {

class ItemTable;

// Paints the rows of the table of data, and opens the fields in which they are entered: with a list
// of the labels where there are some.
class ItemDelegate : public QStyledItemDelegate {
    Q_OBJECT
public:
    ItemDelegate(const ItemModel& items, ItemTable* parent);

    QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;
    void paint(QPainter* painter, const QStyleOptionViewItem& option,
               const QModelIndex& index) const override;
    QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem& option,
                          const QModelIndex& index) const override;
    void setEditorData(QWidget* editor, const QModelIndex& index) const override;
    // A field that is left as it was opened enters nothing, whatever the value is by now.
    void setModelData(QWidget* editor, QAbstractItemModel* model,
                      const QModelIndex& index) const override;
    void updateEditorGeometry(QWidget* editor, const QStyleOptionViewItem& option,
                              const QModelIndex& index) const override;

protected:
    // A field whose text is wrong stays open with it; Esc gives it up.
    bool eventFilter(QObject* object, QEvent* event) override;

private:
    void take(QWidget* field);  // with what was chosen in its list
    void paintLineOf(QPainter& painter, const QStyleOptionViewItem& option,
                     const ItemModel::Row& row) const;

    const ItemModel& items_;
};

}  // namespace cortex::gui
