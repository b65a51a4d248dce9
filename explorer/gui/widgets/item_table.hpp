// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/shown_units.hpp"
#include "record/recorded_item.hpp"
#include "widgets/item_field.hpp"

#include <QAbstractItemDelegate>
#include <QMenu>
#include <QTreeView>
#include <optional>
#include <vector>

namespace cortex::gui {

class ItemModel;

// The data of a simplex: name, value, unit, range bar, remark, description. Columns are as wide as
// their texts in the font of the present. When it is narrow they give way: first the description,
// then long remarks, then the ranges. The numbers of the ranges are whole or not there.
class ItemTable : public QTreeView {
    Q_OBJECT
public:
    explicit ItemTable(ItemModel& model, QWidget* parent = nullptr);

    void setLow(bool low);  // there is little height: rows are lower, columns have no titles
    int rowHeight() const;
    // Makes the row of an item of the simplex itself the current one, in sight and with the
    // keyboard.
    bool choose(const std::string& item);

Q_SIGNALS:
    void submitted();  // Enter in a field
    void givenUp();    // Esc in a field
    void plotWanted(const std::vector<RecordedItem>& items);
    // A menu of places for these is about to open.
    void placesWanted(QMenu* menu, const std::vector<RecordedItem>& items);
    void compareWanted(const QString& item);
    void unitsChanged();

protected:
    bool event(QEvent* event) override;  // what begins a value is no shortcut
    void startDrag(Qt::DropActions actions) override;
    bool edit(const QModelIndex& index, EditTrigger trigger, QEvent* event) override;
    void closeEditor(QWidget* editor, QAbstractItemDelegate::EndEditHint hint) override;
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;
    void drawRow(QPainter* painter, const QStyleOptionViewItem& option,
                 const QModelIndex& index) const override;

private:
    bool beginsValue(const QKeyEvent& event) const;
    void openGroups();
    ItemField* openField() const;  // null: none
    void keepField();
    void openKept();
    QModelIndex cellOf(const ItemField::Kept& field) const;
    void fitColumns();

    ItemModel& items_;
    ShownUnits units_;  // for which the columns are fitted
    int longest_ = 0;   // value at that time
    bool low_ = false;
    std::optional<ItemField::Kept> kept_;
};

}  // namespace cortex::gui
