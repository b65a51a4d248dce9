// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QAbstractItemDelegate>
#include <QTreeView>

namespace cortex::explorer {

class ItemModel;

// The data of a simplex: name, value, unit, range bar, remark, description. Columns give way when
// it is narrow: first the description, then the remark, then the range.
class ItemTable : public QTreeView {
    Q_OBJECT
public:
    explicit ItemTable(ItemModel& model, QWidget* parent = nullptr);

Q_SIGNALS:
    void submitted();  // Enter in a field

protected:
    bool edit(const QModelIndex& index, EditTrigger trigger, QEvent* event) override;
    void closeEditor(QWidget* editor, QAbstractItemDelegate::EndEditHint hint) override;
    void resizeEvent(QResizeEvent* event) override;
    void drawRow(QPainter* painter, const QStyleOptionViewItem& option,
                 const QModelIndex& index) const override;

private:
    void openGroups();
    void fitColumns();

    ItemModel& items_;
};

}  // namespace cortex::explorer
