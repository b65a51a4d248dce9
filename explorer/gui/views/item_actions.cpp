// SPDX-License-Identifier: Apache-2.0
#include "views/item_actions.hpp"

#include "model/item_model.hpp"
#include "model/shell_text.hpp"
#include "widgets/item_table.hpp"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <functional>

namespace cortex::explorer {

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

}  // namespace

void addItemActions(ItemTable& table, const ItemModel& items,
                    const comms::NetworkOptions& network) {
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
    add(ItemTable::tr("Copy value"), QKeySequence::Copy,
        [&table, &items](const Row& /*row*/) { copy(items.copyText(table.currentIndex())); });
    add(ItemTable::tr("Copy path"), {}, [](const Row& row) {
        copy(QString::fromStdString(row.item == nullptr ? row.path
                                                        : row.path + '.' + row.item->name));
    });
    add(ItemTable::tr("Copy as cortex command"), QKeySequence{Qt::CTRL | Qt::SHIFT | Qt::Key_C},
        [&items, network](const Row& row) { copy(commandOf(items, row, network)); });
    add(ItemTable::tr("Set…"), {}, [&table, &items](const Row& /*row*/) {
        const QModelIndex value = table.currentIndex().siblingAtColumn(ItemModel::Value);
        if (items.settable(value)) table.QTreeView::edit(value);
    });
    table.setContextMenuPolicy(Qt::ActionsContextMenu);
}

}  // namespace cortex::explorer
