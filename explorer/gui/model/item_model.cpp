// SPDX-License-Identifier: Apache-2.0
#include "model/item_model.hpp"

#include "cortex/core/labelled_value.hpp"

#include "model/item_text.hpp"
#include "model/plain_text.hpp"
#include "model/value_text.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace cortex::explorer {

struct ItemModel::Node {
    Row row;
    Node* parent = nullptr;
    int number = 0;
    std::uint32_t agent = 0, simplex = 0;
    const ItemLayout* layout = nullptr;
    std::vector<std::unique_ptr<Node>> children;

    Node& add(Row below) {
        children.push_back(std::make_unique<Node>());
        Node& node = *children.back();
        node.row = std::move(below);
        node.parent = this;
        node.number = static_cast<int>(children.size()) - 1;
        return node;
    }
};

namespace {

// Violet is for what should be live and is not: not for what rests, or has ended as it should.
std::optional<Shape> markOf(const AgentFrame& agent, std::uint32_t simplex, Quality quality) {
    if (agent.status.ended) return Shape::Ended;
    return agent.rests(simplex) ? Shape::Standby : shapeOf(quality);
}

// The types whose items only the framework writes.
bool isOfFramework(const std::string& type) {
    static const std::set<std::string> types{"Simplex", "Active", "Activity", "Agent", "Cluster"};
    return types.contains(type);
}

std::optional<Shape> outsideOf(const ItemModel::Row& row, const Value& value) {
    const auto* ints = std::get_if<std::vector<std::int64_t>>(&value);
    if (isClosed(*row.item) && ints != nullptr && row.element < ints->size()) {
        const bool known = row.item->labels.contains((*ints)[row.element]);
        return known ? std::nullopt : std::optional{Shape::NoLabel};
    }
    if (!row.number || !std::isfinite(*row.number)) return std::nullopt;
    if (row.max && *row.number > *row.max) return Shape::AboveLimit;
    if (row.min && *row.number < *row.min) return Shape::BelowLimit;
    return std::nullopt;
}

}  // namespace

ItemModel::ItemModel(QObject* parent)
    : QAbstractItemModel{parent},
      frame_{std::make_shared<Frame>()},
      root_{std::make_unique<Node>()},
      edits_{[this](const std::string& item) { return valueNow(item); }} {}

ItemModel::~ItemModel() = default;

void ItemModel::show(const std::string& path) {
    path_ = path;
    build();
}

void ItemModel::update(std::shared_ptr<const Frame> frame) {
    const bool changed = frame->structures != structures_;
    frame_ = std::move(frame);
    if (changed) {
        const auto place = frame_->find(path_);
        const bool same = place && built_ && frame_->agents[place->agent].structure == structure_;
        if (!same)
            build();
        else
            built_ = place;
        structures_ = frame_->structures;
    }
    for (const auto& group : root_->children) refresh(*group);
}

void ItemModel::build() {
    beginResetModel();
    root_ = std::make_unique<Node>();
    built_ = frame_->find(path_);
    structure_ = nullptr;
    if (built_) {
        structure_ = frame_->agents[built_->agent].structure;
        addGroups(*built_);
        addRelated(*built_);
    }
    endResetModel();
}

// Its own type first, then each ancestor that adds items, from the nearest to Simplex.
void ItemModel::addGroups(Place place) {
    const Type& type = frame_->type(place);
    std::vector<std::string> order{type.name};
    const TypeModel& types = *structure_->types;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const Type* each = types.find(order[i]);
        if (each == nullptr) continue;
        for (const std::string& parent : each->parents) {
            if (std::ranges::find(order, parent) == order.end()) order.push_back(parent);
        }
    }
    const auto first = [&](const DataItem& item) {  // the ancestor that first has the item
        std::string found = type.name;
        for (const std::string& each : order) {
            const Type* ancestor = types.find(each);
            if (ancestor != nullptr && ancestor->findData(item.name) != nullptr) found = each;
        }
        return found;
    };
    for (const std::string& each : order) {
        Node* group = nullptr;
        for (const DataItem& item : type.data) {
            if (first(item) != each) continue;
            if (group == nullptr) {
                Row row;
                row.path = path_;
                row.name = QString::fromStdString(each);
                group = &root_->add(std::move(row));
            }
            addItem(*group, item, place, isOfFramework(each));
        }
    }
}

void ItemModel::addRelated(Place place) {
    const SimplexInfo& info = frame_->info(place);
    for (std::uint32_t i = info.firstEdge; i < info.firstEdge + info.edgeCount; ++i) {
        const Edge& edge = structure_->edges[i];
        if (edge.target == noSimplex) continue;
        const SimplexInfo& target = structure_->simplexes[edge.target];
        Row row;
        row.path = target.path;
        row.name = tr("%1, %2").arg(QString::fromStdString(edge.rule->name),
                                    QLatin1String{name(edge.rule->direction)});
        row.note = QString::fromStdString(target.layout->type->name);
        row.value = QString::fromStdString(target.path);
        Node& group = root_->add(std::move(row));
        for (const DataItem& item : target.layout->type->data) {
            const bool framework = isOfFramework(item.definedBy);
            addItem(group, item, {place.agent, edge.target}, framework);
        }
    }
}

void ItemModel::addItem(Node& group, const DataItem& item, Place place, bool framework) {
    const SimplexInfo& info = frame_->info(place);
    Row row;
    row.path = info.path;
    row.item = &item;
    row.framework = framework;
    row.name = QString::fromStdString(item.name);
    row.unit = unitText(item.unit);
    row.remark = remarkOf(item);
    if (row.remark.isEmpty() && info.role == Role::Modification) row.remark = safeRemark(item);
    row.note = QString::fromStdString(item.description);
    row.min = numberOf(item.min);
    row.max = numberOf(item.max);
    Node& node = group.add(std::move(row));
    node.agent = place.agent;
    node.simplex = place.simplex;
    node.layout = info.layout->find(item.name);
    if (item.length == 1) return;
    for (std::uint32_t i = 0; i < item.length; ++i) {
        Row element = node.row;
        element.element = i;
        element.whole = false;
        element.name = QString::number(i + 1);
        element.note.clear();
        Node& child = node.add(std::move(element));
        child.simplex = node.simplex;
        child.layout = node.layout;
    }
}

// What the framework writes (state, fault, metrics) is as good as the last cycle that was heard,
// also where the simplex itself writes nothing, as in Standby.
Quality ItemModel::qualityOf(const AgentFrame& agent, const Node& node) {
    if (agent.lost()) return Quality::Lost;
    const Quality quality = agent.quality(node.simplex);
    return node.row.framework && agent.beats() ? Quality::Good : quality;
}

// Texts are made anew and compared; only rows that changed are painted.
void ItemModel::refresh(Node& node) {
    int first = -1, last = -1;
    for (const auto& child : node.children) {
        Row& row = child->row;
        if (row.item == nullptr || child->layout == nullptr || !built_) continue;
        const AgentFrame& agent = frame_->agents[built_->agent];
        const QString before = row.value, editedBefore = row.edited;
        row.edited = settableRow(row) ? editedText(row) : QString{};
        const auto mark = row.mark;
        row.mark.reset();
        row.number.reset();
        const auto known = agent.value(child->simplex, *child->layout);
        if (!known) {
            row.value = agent.lost() ? QStringLiteral("—") : QStringLiteral("…");
        } else {
            const cortex::Value& value = *known;
            const bool array = row.whole && row.item->length > 1;
            row.value = array ? tr("%n values", nullptr, static_cast<int>(row.item->length))
                              : elementText(*row.item, value, row.element);
            if (!array) row.number = numberOf(value, row.element);
            if (!array) row.mark = outsideOf(row, value);
            const Quality quality = qualityOf(agent, *child);
            if (quality != Quality::Good && !row.item->constant) {
                row.mark = markOf(agent, child->simplex, quality);
                row.value = bracketed(row.value);
            }
        }
        if (row.value != before || row.mark != mark || row.edited != editedBefore) {
            if (first < 0) first = child->number;
            last = child->number;
        }
        refresh(*child);
    }
    if (first >= 0) {
        Q_EMIT dataChanged(
            createIndex(first, 0, node.children[static_cast<std::size_t>(first)].get()),
            createIndex(last, ColumnCount - 1,
                        node.children[static_cast<std::size_t>(last)].get()));
    }
}

// Items of related simplexes are set where those are shown.
bool ItemModel::settableRow(const Row& row) const {
    return row.item != nullptr && !row.item->settable.empty() && row.path == path_;
}

bool ItemModel::settable(const QModelIndex& index) const {
    return index.isValid() && built_ && settableRow(nodeOf(index)->row);
}

Qt::ItemFlags ItemModel::flags(const QModelIndex& index) const {
    const bool editable = index.column() == Value && settable(index);
    return QAbstractItemModel::flags(index) | (editable ? Qt::ItemIsEditable : Qt::NoItemFlags);
}

bool ItemModel::setData(const QModelIndex& index, const QVariant& text, int role) {
    if (role != Qt::EditRole || !settable(index)) return false;
    if (text == data(index, Qt::EditRole)) return true;  // opened, and left as it was
    const Row& row = nodeOf(index)->row;
    const DataItem item = entryItem(row);
    QString why;
    auto value = enteredValue(item, text.toString(), why);
    if (value && row.whole) {
        edits_.enter(item.name, std::move(*value));
    } else if (value && !edits_.enter(row.item->name, row.element, *value)) {
        why = tr("has no values yet");
    }
    if (!why.isEmpty()) {
        Q_EMIT refused(QString::fromStdString(item.name) + ' ' + why);
        return false;
    }
    for (const auto& group : root_->children) refresh(*group);
    return true;
}

DataItem ItemModel::entryItem(const Row& row) {
    return row.whole ? *row.item : elementItem(*row.item, row.element);
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
    return value ? entryText(entryItem(row), *value) : QString{};
}

QString ItemModel::copyText(const QModelIndex& index) const {
    const Node& node = *nodeOf(index);
    if (node.row.item == nullptr || node.layout == nullptr || !built_) return node.row.name;
    const AgentFrame& agent = frame_->agents[built_->agent];
    if (!agent.came(node.simplex)) return {};
    cortex::Value value = (*agent.image)->value(node.simplex, *node.layout);
    if (!node.row.whole) value = elementOf(value, node.row.element);
    const QString text = QString::fromStdString(toText(value));
    const bool live = qualityOf(agent, node) == Quality::Good || node.row.item->constant;
    return live ? text : bracketed(text);
}

void ItemModel::clearEdits() {
    edits_.clear();
    for (const auto& group : root_->children) refresh(*group);
}

ItemModel::Node* ItemModel::nodeOf(const QModelIndex& index) const {
    return index.isValid() ? static_cast<Node*>(index.internalPointer()) : root_.get();
}

const ItemModel::Row& ItemModel::row(const QModelIndex& index) const { return nodeOf(index)->row; }

QModelIndex ItemModel::index(int row, int column, const QModelIndex& parent) const {
    if (!hasIndex(row, column, parent)) return {};
    return createIndex(row, column, nodeOf(parent)->children[static_cast<std::size_t>(row)].get());
}

QModelIndex ItemModel::parent(const QModelIndex& index) const {
    if (!index.isValid()) return {};
    Node* node = nodeOf(index)->parent;
    return node == root_.get() ? QModelIndex{} : createIndex(node->number, 0, node);
}

int ItemModel::rowCount(const QModelIndex& parent) const {
    if (parent.isValid() && parent.column() != 0) return 0;
    return static_cast<int>(nodeOf(parent)->children.size());
}

int ItemModel::columnCount(const QModelIndex& /*parent*/) const { return ColumnCount; }

QVariant ItemModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid()) return {};
    const Row& row = nodeOf(index)->row;
    if (role == Qt::EditRole && settable(index)) {
        if (!row.edited.isEmpty()) return row.edited;
        const AgentFrame& agent = frame_->agents[built_->agent];
        const Node& node = *nodeOf(index);
        if (!agent.came(node.simplex)) return {};
        const cortex::Value value = (*agent.image)->value(node.simplex, *node.layout);
        return row.whole ? entryText(*row.item, value)
                         : entryText(entryItem(row), elementOf(value, row.element));
    }
    if (role == Qt::ToolTipRole && row.item != nullptr) {
        QStringList lines{QString::fromStdString(row.path + '.' + row.item->name)};
        if (!row.item->description.empty()) {
            lines << QString::fromStdString(row.item->description);
        }
        if (row.mark) lines << word(*row.mark);
        if (row.mark == Shape::NoLabel) lines << labelsText(*row.item);
        return tipText(lines.join('\n'));
    }
    if (role != Qt::DisplayRole && role != Qt::AccessibleTextRole) return {};
    switch (index.column()) {
        case Name:
            return row.name;
        case Value:
            return row.edited.isEmpty() ? row.value : row.edited;
        case Unit:
            return row.unit;
        case Remark:
            return row.mark ? word(*row.mark) : row.remark;
        case Description:
            return row.note;
        default:
            return {};
    }
}

QVariant ItemModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal) return {};
    if (role == Qt::TextAlignmentRole && section == Value) {
        return QVariant::fromValue(Qt::AlignRight | Qt::AlignVCenter);
    }
    if (role == Qt::TextAlignmentRole) return QVariant::fromValue(Qt::AlignLeft | Qt::AlignVCenter);
    if (role != Qt::DisplayRole) return {};
    switch (section) {
        case Name:
            return tr("Item");
        case Value:
            return tr("Value");
        case Unit:
            return tr("Unit");
        case Range:
            return tr("Range");
        case Description:
            return tr("Description");
        default:
            return tr("Remark");
    }
}

}  // namespace cortex::explorer
