// SPDX-License-Identifier: Apache-2.0
#include "model/item_model.hpp"

#include "cortex/core/labelled_value.hpp"

#include "common/cut_text.hpp"
#include "model/item_node.hpp"
#include "model/item_text.hpp"
#include "model/plain_text.hpp"
#include "model/value_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cortex::gui {

namespace {

// Of what is not live. Violet is for what should be and is not: not for what rests, or has ended as
// it should.
std::optional<Shape> markOf(const Frame& frame, Place place) {
    const AgentFrame& agent = frame.agents[place.agent];
    switch (frame.excuse(place)) {
        case Excuse::Ended:
            return Shape::Ended;
        case Excuse::Rests:
            return Shape::Standby;
        case Excuse::None:
            break;
    }
    if (agent.lost()) return Shape::Lost;
    const Quality quality = agent.quality(place.simplex);
    return shapeOf(quality == Quality::Good ? Quality::Stale : quality);  // its loop stands still
}

std::optional<Shape> outsideOf(const ItemModel::Row& row, const Value& value) {
    const auto* ints = std::get_if<std::vector<std::int64_t>>(&value);
    if (isClosed(*row.item) && ints != nullptr && row.element < ints->size()) {
        const bool known = row.item->labels.contains((*ints)[row.element]);
        return known ? std::nullopt : std::optional{Shape::NoLabel};
    }
    const auto number = numberOf(value, row.element);  // as the model has it, as are its limits
    if (!number || !std::isfinite(*number)) return std::nullopt;
    const auto min = numberOf(row.item->min), max = numberOf(row.item->max);
    if (max && *number > *max) return Shape::AboveLimit;
    if (min && *number < *min) return Shape::BelowLimit;
    return std::nullopt;
}

}  // namespace

ItemModel::ItemModel(QObject* parent)
    : QAbstractItemModel{parent},
      frame_{std::make_shared<Frame>()},
      root_{std::make_unique<Node>()},
      edits_{[this](const std::string& item) { return valueNow(item); }} {}

ItemModel::~ItemModel() { kept_->put(path_, edits_.take()); }

void ItemModel::show(const std::string& path) {
    changeEdits(path);
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
    if (built_) setAsideChanged();
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
            addItem(*group, item, place);
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
        for (const DataItem& item : target.layout->type->data)
            addItem(group, item, {place.agent, edge.target});
    }
}

void ItemModel::addItem(Node& group, const DataItem& item, Place place) {
    const SimplexInfo& info = frame_->info(place);
    Row row;
    row.path = info.path;
    row.item = &item;
    row.name = QString::fromStdString(item.name);
    row.demand = info.role == Role::Modification;
    row.note = QString::fromStdString(item.description);
    describe(row);
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

// What depends on the unit in which it is shown.
void ItemModel::describe(Row& row) const {
    if (row.item == nullptr) return;
    row.shown = units_.of(*row.item);
    const DataItem& item = row.asShown();
    row.unit = unitText(item.unit);
    row.remark = remarkOf(item);
    if (row.remark.isEmpty() && row.demand) row.remark = safeRemark(item);
    row.min = numberOf(item.min);
    row.max = numberOf(item.max);
}

void ItemModel::describe(Node& node) {
    for (const auto& child : node.children) {
        describe(child->row);
        describe(*child);
    }
    if (node.children.empty()) return;
    Q_EMIT dataChanged(
        createIndex(0, 0, node.children.front().get()),
        createIndex(node.children.back()->number, ColumnCount - 1, node.children.back().get()));
}

void ItemModel::setUnits(const ShownUnits& units) {
    if (units == units_) return;
    units_ = units;
    for (const auto& group : root_->children) {
        describe(*group);
        refresh(*group);
    }
}

// Values of a simplex of another agent are found there.
std::optional<Place> ItemModel::placeOf(const Node& node) const {
    if (!built_) return std::nullopt;
    const Place here{built_->agent, node.simplex};
    return frame_->info(here).remote ? frame_->find(node.row.path) : here;
}

std::optional<cortex::Value> ItemModel::valueOf(const Node& node,
                                                std::optional<Place> place) const {
    if (!place) return std::nullopt;
    const AgentFrame& agent = frame_->agents[place->agent];
    const ItemLayout* layout = agent.structure == structure_
                                   ? node.layout
                                   : frame_->info(*place).layout->find(node.row.item->name);
    return layout != nullptr ? agent.value(place->simplex, *layout) : std::nullopt;
}

// What never came says whether it still may.
void ItemModel::readNothing(Row& row, std::optional<Place> place) const {
    const GoneAgent* gone = frame_->goneFrom(row.path);
    const bool nobody = !place && frame_->complete;
    if (gone != nullptr)
        row.mark = gone->ended ? Shape::Ended : Shape::Lost;
    else if (nobody)
        row.mark = Shape::Lost;
    const bool lost = place && frame_->agents[place->agent].lost();
    row.value = gone != nullptr || nobody || lost ? QStringLiteral("—") : QStringLiteral("…");
}

void ItemModel::read(Node& node, std::optional<Place> place) const {
    Row& row = node.row;
    row.mark.reset();
    row.number.reset();
    const auto value = valueOf(node, place);
    if (!value) {
        readNothing(row, place);
        return;
    }
    const bool array = row.whole && row.item->length > 1;
    row.value = array ? tr("%n values", nullptr, static_cast<int>(row.item->length))
                      : shownText(row.shown.get(), *row.item, *value, row.element);
    if (!array && common::mayBeCut(*row.item, *value, row.element)) row.value += QChar{0x2026};
    if (!array) row.number = numberOf(*value, row.element);
    if (row.number && row.shown) *row.number *= row.shown->factor;
    if (!array) row.mark = outsideOf(row, *value);
    if (frame_->agents[place->agent].live(place->simplex, *row.item)) return;
    row.mark = markOf(*frame_, *place);
    row.value = bracketed(row.value);
}

// Texts are made anew and compared; only rows that changed are painted.
void ItemModel::refresh(Node& node) {
    if (node.children.empty() || !built_) return;
    int first = -1, last = -1;
    const auto place = placeOf(*node.children.front());
    for (const auto& child : node.children) {
        Row& row = child->row;
        if (row.item == nullptr || child->layout == nullptr) continue;
        const QString before = row.value, editedBefore = row.edited;
        const auto mark = row.mark;
        row.edited = settableRow(row) ? editedText(row) : QString{};
        read(*child, place);
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

Qt::ItemFlags ItemModel::flags(const QModelIndex& index) const {
    const bool editable = index.column() == Value && settable(index);
    return QAbstractItemModel::flags(index) |
           (index.isValid() ? Qt::ItemIsDragEnabled : Qt::NoItemFlags) |
           (editable ? Qt::ItemIsEditable : Qt::NoItemFlags);
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
        return row.whole
                   ? shownEntry(row.shown.get(), *row.item, value)
                   : shownEntry(row.shown.get(), entryItem(row), elementOf(value, row.element));
    }
    if (role == Qt::ToolTipRole && row.item != nullptr) {
        QStringList lines{QString::fromStdString(row.path + '.' + row.item->name)};
        if (!row.item->description.empty()) {
            lines << QString::fromStdString(row.item->description);
        }
        if (const QString limits = limitsText(row.asShown()); !limits.isEmpty())
            lines << tr("Range: %1").arg(limits);
        if (row.mark) lines << word(*row.mark);
        if (row.mark == Shape::NoLabel) lines << labelsText(*row.item);
        if (row.shown) lines << tr("In the model in %1.").arg(unitText(row.item->unit));
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

}  // namespace cortex::gui
