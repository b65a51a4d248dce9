// SPDX-License-Identifier: Apache-2.0
#include "views/item_actions.hpp"

#include "model/item_model.hpp"
#include "model/plotted_items.hpp"
#include "model/shell_text.hpp"
#include "widgets/item_table.hpp"
#include "widgets/unit_menu.hpp"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QEvent>
#include <QMenu>
#include <functional>
#include <utility>

namespace cortex::gui {

namespace {

void copy(const QString& text) { QApplication::clipboard()->setText(text); }

// "cortex set …" of what was entered and is not sent yet, otherwise "cortex watch …" of the item.
QString commandOf(const ItemModel& items, const ItemModel::Row& row,
                  const comms::NetworkOptions& network) {
    if (row.item == nullptr) return shellText(network, "show", row.path);
    if (row.edited.isEmpty()) {
        return shellText(network, "watch", row.path + '.' + row.item->name);
    }
    comms::Mirror::Arguments arguments;
    for (const auto& [name, value] : items.edits()) arguments[name] = value;
    return shellText(network, "set", row.path, {}, arguments);
}

// Before the menu of a table opens, however it is asked for.
class BeforeMenu : public QObject {
public:
    BeforeMenu(ItemTable& table, std::function<void()> act)
        : QObject{&table}, act_{std::move(act)} {
        table.installEventFilter(this);  // by key
        table.viewport()->installEventFilter(this);
    }
    bool eventFilter(QObject* /*object*/, QEvent* event) override {
        if (event->type() == QEvent::ContextMenu) act_();
        return false;
    }

private:
    std::function<void()> act_;
};

// What cannot be set says why in its place.
void addSet(ItemTable& table, const ItemModel& items) {
    auto* set = new QAction{ItemTable::tr("Set…"), &table};
    QObject::connect(set, &QAction::triggered, &table, [&table, &items] {
        const QModelIndex value = table.currentIndex().siblingAtColumn(ItemModel::Value);
        if (items.settable(value)) table.QTreeView::edit(value);
    });
    table.addAction(set);
    new BeforeMenu{
        table, [set, &table, &items] {
            const QString why = items.whyNotSettable(table.currentIndex());
            set->setEnabled(why.isEmpty());
            set->setText(why.isEmpty() ? ItemTable::tr("Set…") : ItemTable::tr("Set: %1").arg(why));
        }};
}

void addPlaces(ItemTable& table, const ItemModel& items) {
    auto* menu = new QMenu{ItemTable::tr("Plot in…"), &table};
    QObject::connect(menu, &QMenu::aboutToShow, &table, [menu, &table, &items] {
        menu->clear();
        Q_EMIT table.placesWanted(menu, plottedItems(items, table.currentIndex()));
    });
    table.addAction(menu->menuAction());
}

void addUnits(ItemTable& table, ItemModel& items) {
    auto* menu = new QMenu{ItemTable::tr("Units"), &table};
    fillUnitMenu(*menu, [&table, &items] {
        return UnitsOfView{[&items] { return items.units(); },
                           [&table, &items](const ShownUnits& units) {
                               items.setUnits(units);
                               Q_EMIT table.unitsChanged();
                           }};
    });
    table.addAction(menu->menuAction());
}

}  // namespace

void addItemActions(ItemTable& table, ItemModel& items, const comms::NetworkOptions& network) {
    using Row = ItemModel::Row;
    const auto add = [&](const QString& text, const QKeySequence& keys,
                         const std::function<void(const Row&)>& act) {
        auto* action = new QAction{text, &table};
        action->setShortcut(keys);
        action->setShortcutContext(Qt::WidgetShortcut);
        QObject::connect(action, &QAction::triggered, &table, [&table, &items, act] {
            if (table.currentIndex().isValid()) act(items.row(table.currentIndex()));
        });
        table.addAction(action);
    };
    add(ItemTable::tr("Plot"), QKeySequence{Qt::Key_P}, [&table, &items](const Row& /*row*/) {
        const auto wanted = plottedItems(items, table.currentIndex());
        if (!wanted.empty()) Q_EMIT table.plotWanted(wanted);
    });
    addPlaces(table, items);
    add(ItemTable::tr("Compare all of this name"), {}, [&table](const Row& row) {
        if (row.item != nullptr) Q_EMIT table.compareWanted(QString::fromStdString(row.item->name));
    });
    add(ItemTable::tr("Copy value"), QKeySequence::Copy,
        [&table, &items](const Row& /*row*/) { copy(items.copyText(table.currentIndex())); });
    add(ItemTable::tr("Copy path"), {}, [](const Row& row) {
        copy(QString::fromStdString(row.item == nullptr ? row.path
                                                        : row.path + '.' + row.item->name));
    });
    add(ItemTable::tr("Copy as cortex command"), QKeySequence{Qt::CTRL | Qt::SHIFT | Qt::Key_C},
        [&items, network](const Row& row) { copy(commandOf(items, row, network)); });
    addSet(table, items);
    addUnits(table, items);
    table.setContextMenuPolicy(Qt::ActionsContextMenu);
}

}  // namespace cortex::gui
