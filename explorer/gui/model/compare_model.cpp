// SPDX-License-Identifier: Apache-2.0
#include "model/compare_model.hpp"

#include "common/csv_cell.hpp"
#include "model/natural_order.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

namespace cortex::gui {

namespace {

constexpr std::size_t mostElements = 64;

// As the model has it: without a unit and brackets, to the last digit.
std::string exactText(const Value& value, std::size_t element) {
    if (element >= lengthOf(value)) return {};
    if (const auto* texts = std::get_if<std::vector<std::string>>(&value)) return (*texts)[element];
    if (const auto* bools = std::get_if<std::vector<bool>>(&value))
        return (*bools)[element] ? "true" : "false";
    const auto number = exactOf(value, element);
    return number ? number->text() : "nan";
}

// Rows of one dimension are a group; the first has most rows. Numbers are compared in the unit of
// their model, or in that of the group where it has several.
void groupRows(std::vector<CompareRow>& rows) {
    struct Group {
        std::size_t rows = 0;
        std::set<std::string> units;
        int place = 0;
    };
    std::map<std::string, Group> groups;
    for (const CompareRow& each : rows) {
        const std::string& unit = each.item->item->unit;
        Group& group = groups[unitSize(unit).base];
        ++group.rows;
        group.units.insert(unit);
    }
    std::vector<Group*> inOrder;
    for (auto& [base, group] : groups) inOrder.push_back(&group);
    std::ranges::sort(inOrder, [](const Group* one, const Group* other) {
        return std::tie(other->rows, *one->units.begin()) <
               std::tie(one->rows, *other->units.begin());
    });
    for (int place = 0; Group * each : inOrder) each->place = place++;
    for (CompareRow& each : rows) {
        const UnitSize unit = unitSize(each.item->item->unit);
        const Group& group = groups[unit.base];
        each.group = group.place;
        each.scale = group.units.size() > 1 ? unit.size : 1;
    }
}

// What orders a row within its group.
struct OrderKey {
    int group;
    ExactNumber number;
};

std::optional<OrderKey> keyOf(const CompareRow& row, int column) {
    const auto ofGroup = [&](const std::optional<ExactNumber>& number) -> std::optional<OrderKey> {
        if (!number) return std::nullopt;
        return OrderKey{row.group,
                        row.scale == 1 ? *number : ExactNumber{number->near() * row.scale}};
    };
    if (column == CompareModel::Age) {
        if (!row.seconds) return std::nullopt;
        return OrderKey{0, ExactNumber{static_cast<double>(*row.seconds)}};
    }
    if (column != CompareModel::Distance) return ofGroup(row.number);
    constexpr int ofShares = -1;
    return row.share ? OrderKey{ofShares, ExactNumber{*row.share}} : ofGroup(row.left);
}

}  // namespace

void CompareModel::compare(const std::string& item, const QString& filter) {
    item_ = item;
    filter_ = filter;
    query_ = Query{filter};
    fresh_ = true;
}

void CompareModel::setUnits(const ShownUnits& units) {
    units_ = units;
    for (Row& each : rows_) {
        each.shown = units_.of(*each.item->item);
        if (frame_) readRow(each, *frame_);
    }
    if (!rows_.empty()) {
        Q_EMIT dataChanged(index(0, 0), index(static_cast<int>(rows_.size()) - 1, ColumnCount - 1));
    }
}

void CompareModel::update(std::shared_ptr<const Frame> frame, bool inOrder) {
    frame_ = std::move(frame);
    if (fresh_ || structures_ != frame_->structures) build();
    for (Row& each : rows_) readRow(each, *frame_);
    // The first values of a row give it its place.
    const auto known = std::ranges::count_if(rows_, [](const Row& each) { return each.came; });
    if (inOrder || known != known_) order();
    known_ = known;
    if (!rows_.empty()) {
        Q_EMIT dataChanged(index(0, 0), index(static_cast<int>(rows_.size()) - 1, ColumnCount - 1));
    }
}

void CompareModel::build() {
    beginResetModel();
    rows_.clear();
    for (std::uint32_t agent = 0; agent < frame_->agents.size(); ++agent) {
        const auto& structure = frame_->agents[agent].structure;
        if (!structure || item_.empty()) continue;
        for (std::uint32_t simplex = 0; simplex < structure->simplexes.size(); ++simplex) {
            const SimplexInfo& info = structure->simplexes[simplex];
            const ItemLayout* item = info.layout->find(item_);
            const Place place{agent, simplex};
            const bool wanted = item != nullptr && !info.remote &&
                                frame_->find(info.path) == place && query_.matches(*frame_, place);
            const auto shown = wanted ? units_.of(*item->item) : nullptr;
            const std::size_t elements =
                wanted ? std::min<std::size_t>(item->item->length, mostElements) : 0;
            for (std::size_t i = 0; i < elements; ++i) {
                Row row;
                row.place = place;
                row.item = item;
                row.element = i;
                row.shown = shown;
                row.path = QString::fromStdString(info.path);
                if (elements > 1) row.path += QStringLiteral("[%1]").arg(i);
                rows_.push_back(std::move(row));
            }
        }
    }
    for (Row& each : rows_) readRow(each, *frame_);
    groupRows(rows_);
    order();
    fresh_ = false;
    structures_ = frame_->structures;
    endResetModel();
}

void CompareModel::sort(int column, Qt::SortOrder order) {
    column_ = column;
    order_ = order;
    this->order();
}

// What is not known stands at the end, and groups stay as they are, whichever way the order goes.
bool CompareModel::before(const Row& one, const Row& other) const {
    const bool ascending = order_ == Qt::AscendingOrder;
    const auto byPath = [](const Row& a, const Row& b) {
        return NaturalOrder{}(a.path.toStdString(), b.path.toStdString());
    };
    if (column_ != Value && column_ != Range && column_ != Distance && column_ != Age)
        return ascending ? byPath(one, other) : byPath(other, one);
    const auto a = keyOf(one, column_), b = keyOf(other, column_);
    if (a.has_value() != b.has_value()) return a.has_value();
    if (a && a->group != b->group) return a->group < b->group;
    if (!a || a->number == b->number) return byPath(one, other);
    return ascending ? a->number < b->number : b->number < a->number;
}

void CompareModel::order() {
    const auto less = [this](const Row& one, const Row& other) { return before(one, other); };
    if (std::ranges::is_sorted(rows_, less)) return;
    Q_EMIT layoutAboutToBeChanged({}, QAbstractItemModel::VerticalSortHint);
    const QModelIndexList held = persistentIndexList();
    std::vector<std::pair<Place, std::size_t>> keys;
    for (const QModelIndex& each : held)
        keys.emplace_back(row(each.row()).place, row(each.row()).element);
    std::ranges::sort(rows_, less);
    QModelIndexList moved;
    for (int i = 0; i < held.size(); ++i) {
        const auto& [place, element] = keys[static_cast<std::size_t>(i)];
        const auto found = std::ranges::find_if(
            rows_, [&](const Row& each) { return each.place == place && each.element == element; });
        moved << index(static_cast<int>(found - rows_.begin()), held[i].column());
    }
    changePersistentIndexList(held, moved);
    Q_EMIT layoutChanged({}, QAbstractItemModel::VerticalSortHint);
}

RecordedItem CompareModel::recorded(int index) const {
    const Row& each = row(index);
    const AgentFrame& agent = frame_->agents[each.place.agent];
    return {agent.status.name, frame_->info(each.place).path, item_, each.element};
}

std::vector<std::string> CompareModel::paths() const {
    std::vector<std::string> paths;
    for (const Row& each : rows_) {
        if (each.element == 0) paths.push_back(frame_->info(each.place).path);
    }
    return paths;
}

std::string CompareModel::csv() const {
    using common::csvCell;
    std::string text = "path," + item_ + ",unit,min,max,distance,share,quality,age_s\n";
    const auto number = [](const auto& value) {
        return value ? ExactNumber{*value}.text() : std::string{};
    };
    for (const Row& each : rows_) {
        const AgentFrame& agent = frame_->agents[each.place.agent];
        const DataItem& item = *each.item->item;
        const auto value = agent.value(each.place.simplex, *each.item);
        text += csvCell(each.path.toStdString()) + ',';
        if (value) text += csvCell(exactText(*value, each.element));
        text += ',' + csvCell(item.unit) + ',' + number(item.min) + ',' + number(item.max) + ',' +
                number(each.left) + ',' + number(each.share) + ',' +
                name(agent.quality(each.place.simplex)) + ',';
        if (each.seconds) {
            text += QString::number(static_cast<double>(*each.seconds), 'g', 17).toStdString();
        }
        text += '\n';
    }
    return text;
}

int CompareModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

int CompareModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : ColumnCount;
}

QVariant CompareModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid() ||
        (role != Qt::DisplayRole && role != Qt::AccessibleTextRole && role != Qt::ToolTipRole))
        return {};
    const Row& each = row(index.row());
    const bool ofLimits = index.column() == Range || index.column() == Distance;
    if (ofLimits && role != Qt::DisplayRole) return limitText(each);
    switch (index.column()) {
        case Path:
            return each.path;
        case Value:
            return each.value;
        case Unit:
            return each.unit;
        case Range:
        case Distance:
            return each.distance;
        case Age:
            return each.age;
        case Remark:
            return each.remark;
        default:
            return {};
    }
}

QVariant CompareModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
    const QStringList titles{
        tr("Simplex"),  item_.empty() ? tr("Value") : QString::fromStdString(item_),
        tr("Unit"),     tr("Range"),
        tr("To limit"), tr("Age"),
        tr("Remark")};
    return titles.value(section);
}

QStringList comparableItems(const Frame& frame) {
    std::map<std::string, int> counts;
    for (const AgentFrame& agent : frame.agents) {
        if (!agent.structure) continue;
        for (const SimplexInfo& info : agent.structure->simplexes) {
            if (info.remote) continue;
            for (const DataItem& each : info.layout->type->data) {
                if (each.kind != Kind::String) ++counts[each.name];
            }
        }
    }
    std::vector<std::pair<std::string, int>> sorted{counts.begin(), counts.end()};
    std::ranges::sort(sorted, {}, [](const auto& each) {
        return std::pair{-each.second, std::string_view{each.first}};
    });
    QStringList names;
    for (const auto& [each, count] : sorted) names << QString::fromStdString(each);
    return names;
}

}  // namespace cortex::gui
