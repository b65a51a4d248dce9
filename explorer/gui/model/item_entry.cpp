// SPDX-License-Identifier: Apache-2.0
// What a person enters into the table of values, and copies from it.
#include "model/item_node.hpp"
#include "model/plain_text.hpp"
#include "model/value_text.hpp"

#include <utility>

namespace cortex::gui {

// Items of related simplexes are set where those are shown.
bool ItemModel::settableRow(const Row& row) const {
    return row.item != nullptr && !row.item->settable.empty() && row.path == path_;
}

bool ItemModel::settable(const QModelIndex& index) const {
    return index.isValid() && built_ && settableRow(nodeOf(index)->row);
}

QString ItemModel::whyNotSettable(const QModelIndex& index) const {
    if (settable(index)) return {};
    if (!index.isValid() || row(index).item == nullptr) return tr("this is no item");
    const Row& one = row(index);
    const QString item = QString::fromStdString(one.item->name);
    if (one.item->constant) return tr("%1 is constant").arg(item);
    if (one.item->settable.empty()) return tr("%1 is not settable").arg(item);
    return tr("it is set in %1").arg(QString::fromStdString(one.path));
}

bool ItemModel::setData(const QModelIndex& index, const QVariant& text, int role) {
    if (role != Qt::EditRole || !settable(index)) return false;
    enteredLast_ = nodeOf(index)->row.item->name;
    if (text == data(index, Qt::EditRole)) {  // opened, and left as it was
        Q_EMIT accepted();
        return true;
    }
    const Row& row = nodeOf(index)->row;
    const DataItem item = entryItem(row);
    QString why;
    auto value = entered(row, text.toString(), why);
    if (value && row.whole) {
        edits_.enter(item, std::move(*value));
    } else if (value && !edits_.enter(*row.item, row.element, *value)) {
        why = tr("has no values yet");
    }
    if (!why.isEmpty()) {
        Q_EMIT refused(wrongText(item.name, why));
        return false;
    }
    for (const auto& group : root_->children) refresh(*group);
    Q_EMIT accepted();
    return true;
}

DataItem ItemModel::entryItem(const Row& row) {
    return row.whole ? *row.item : elementItem(*row.item, row.element);
}

std::optional<cortex::Value> ItemModel::entered(const Row& row, const QString& text,
                                                QString& why) const {
    auto now = valueNow(row.item->name);
    if (now && !row.whole) now = elementOf(*now, row.element);
    return enteredShown(row.shown.get(), entryItem(row), text, why, now);
}

std::optional<cortex::Value> ItemModel::valueNow(const std::string& item) const {
    if (!built_) return std::nullopt;
    const AgentFrame& agent = frame_->agents[built_->agent];
    const ItemLayout* layout = frame_->info(*built_).layout->find(item);
    if (layout == nullptr || !agent.came(built_->simplex)) return std::nullopt;
    return (*agent.image)->value(built_->simplex, *layout);
}

QString ItemModel::editedText(const Row& row) const {
    const std::string& name = row.item->name;
    const auto value = row.whole ? edits_.of(name) : edits_.of(name, row.element);
    return value ? shownEntry(row.shown.get(), entryItem(row), *value) : QString{};
}

QString ItemModel::copyText(const QModelIndex& index) const {
    const Node& node = *nodeOf(index);
    if (node.row.item == nullptr || node.layout == nullptr || !built_) return node.row.name;
    const auto place = placeOf(node);
    auto value = valueOf(node, place);
    if (!value) return {};
    if (!node.row.whole) value = elementOf(*value, node.row.element);
    const QString text = QString::fromStdString(toText(*value));
    const bool live = frame_->agents[place->agent].live(place->simplex, *node.row.item);
    return live ? text : bracketed(text);
}

void ItemModel::clearEdits() { clearEdits(path_, edits_.all(), ItemEdits::count()); }

void ItemModel::clearEdits(const std::string& path, const ItemEdits::Values& sent,
                           std::uint64_t entries) {
    if (path != path_) {
        ItemEdits::All kept = kept_->take(path);
        ItemEdits::clear(kept, sent, entries);
        kept_->put(path, std::move(kept));
        return;
    }
    edits_.clear(sent, entries);
    for (const auto& group : root_->children) refresh(*group);
}

void ItemModel::changeEdits(const std::string& path) {
    if (path == path_) return;
    enteredLast_.clear();
    kept_->put(path_, edits_.take());
    edits_.put(kept_->take(path));
}

void ItemModel::setAsideChanged() {
    const Type& type = frame_->type(*built_);
    QStringList items;
    for (const std::string& each :
         edits_.dropChanged([&](const std::string& item) { return type.findData(item); }))
        items << plainText(each);
    if (!items.isEmpty()) Q_EMIT setAside(path_, items);
}

}  // namespace cortex::gui
