// SPDX-License-Identifier: Apache-2.0
#include "model/compare_model.hpp"

#include "model/item_text.hpp"
#include "model/natural_order.hpp"
#include "model/value_text.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

namespace cortex::gui {

namespace {

constexpr std::size_t mostElements = 64;

QString nothing() { return QStringLiteral("—"); }

QString shownNumber(const CompareModel::Row& row, double number) {
    return row.shown ? numberText(row.shown->item, number * row.shown->factor)
                     : numberText(*row.item->item, number);
}

// "12 %  0.21 upper"; negative: outside.
QString distanceText(const CompareModel::Row& row) {
    if (!row.left) return nothing();
    QString text = shownNumber(row, *row.left);
    if (row.share) {
        text = QString::number(*row.share * 100, 'f', 1).replace('-', QStringLiteral("−")) +
               QStringLiteral(" %  ") + text;
    }
    if (!row.live && !row.constant) text = bracketed(text);
    return text + ' ' + (row.upper ? CompareModel::tr("upper") : CompareModel::tr("lower"));
}

QString remarkOf(const Frame& frame, const CompareModel::Row& row) {
    const AgentFrame& agent = frame.agents[row.place.agent];
    const Excuse excuse = frame.excuse(row.place);
    if (excuse == Excuse::Ended) return CompareModel::tr("ended");
    if (agent.lost()) return CompareModel::tr("lost");
    if (row.left && *row.left < 0) {
        const bool above = row.max && *row.number > *row.max;
        return above ? CompareModel::tr("above limit") : CompareModel::tr("below limit");
    }
    if (excuse == Excuse::Rests) return CompareModel::tr("rests");
    const Quality quality = agent.quality(row.place.simplex);
    return quality == Quality::Good ? QString{} : QLatin1String{name(quality)};
}

QString csvField(QString text) {
    if (!text.contains(',') && !text.contains('"') && !text.contains('\n')) return text;
    return '"' + text.replace('"', QLatin1String{"\"\""}) + '"';
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
        read(each);
    }
    if (!rows_.empty()) {
        Q_EMIT dataChanged(index(0, 0), index(static_cast<int>(rows_.size()) - 1, ColumnCount - 1));
    }
}

void CompareModel::update(std::shared_ptr<const Frame> frame, bool inOrder) {
    frame_ = std::move(frame);
    if (fresh_ || structures_ != frame_->structures) build();
    for (Row& each : rows_) read(each);
    // The first values of a row give it its place.
    const auto known =
        std::ranges::count_if(rows_, [](const Row& each) { return each.number.has_value(); });
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
    for (Row& each : rows_) read(each);
    order();
    fresh_ = false;
    structures_ = frame_->structures;
    endResetModel();
}

void CompareModel::read(Row& row) const {
    const AgentFrame& agent = frame_->agents[row.place.agent];
    const DataItem& item = *row.item->item;
    row.constant = item.constant;
    row.live = agent.quality(row.place.simplex) == Quality::Good && agent.beats();
    row.unit = unitText(row.shown ? row.shown->item.unit : item.unit);
    row.min = numberOf(item.min);
    row.max = numberOf(item.max);
    row.left = row.share = std::nullopt;
    const auto value = agent.value(row.place.simplex, *row.item);
    row.number = value ? numberOf(*value, row.element) : std::nullopt;
    if (row.number) {
        const double below = row.min ? *row.number - *row.min : INFINITY;
        const double above = row.max ? *row.max - *row.number : INFINITY;
        if (row.min || row.max) row.left = std::min(below, above);
        row.upper = above < below;
        if (row.min && row.max && *row.max > *row.min)
            row.share = *row.left / (*row.max - *row.min);
    }
    const QString text = value ? shownText(row.shown.get(), item, *value, row.element) : QString{};
    row.value = text.isEmpty() ? nothing() : row.live || row.constant ? text : bracketed(text);
    row.distance = distanceText(row);
    row.seconds = agent.age(row.place.simplex);
    row.age = row.seconds ? ageText(static_cast<double>(*row.seconds)) : nothing();
    row.remark = remarkOf(*frame_, row);
}

void CompareModel::sort(int column, Qt::SortOrder order) {
    column_ = column;
    order_ = order;
    this->order();
}

// What is not known stands at the end, whichever way the order goes.
bool CompareModel::before(const Row& one, const Row& other) const {
    const auto shown = [](const Row& row, std::optional<double> number) {
        return number && row.shown ? std::optional{*number * row.shown->factor} : number;
    };
    const auto byNumber = [&](const auto& a, const auto& b) {
        if (a.has_value() != b.has_value()) return a.has_value();
        if (!a || *a == *b) return NaturalOrder{}(one.path.toStdString(), other.path.toStdString());
        return order_ == Qt::AscendingOrder ? *a < *b : *b < *a;
    };
    switch (column_) {
        case Value:
        case Range:
            return byNumber(shown(one, one.number), shown(other, other.number));
        case Distance:
            return byNumber(one.share ? one.share : shown(one, one.left),
                            other.share ? other.share : shown(other, other.left));
        case Age:
            return byNumber(one.seconds, other.seconds);
        default: {
            const bool less = NaturalOrder{}(one.path.toStdString(), other.path.toStdString());
            return order_ == Qt::AscendingOrder
                       ? less
                       : NaturalOrder{}(other.path.toStdString(), one.path.toStdString());
        }
    }
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

QString CompareModel::csv() const {
    QString text = QStringLiteral("path,%1,unit,min,max,distance,share,quality,age_s\n")
                       .arg(QString::fromStdString(item_));
    const auto number = [](const auto& value) {
        return value ? QString::number(static_cast<double>(*value), 'g', 17) : QString{};
    };
    for (const Row& each : rows_) {
        const Quality quality = frame_->agents[each.place.agent].quality(each.place.simplex);
        const QStringList fields{csvField(each.path),
                                 each.number ? number(each.number) : csvField(each.value),
                                 csvField(QString::fromStdString(each.item->item->unit)),
                                 number(each.min),
                                 number(each.max),
                                 number(each.left),
                                 number(each.share),
                                 QLatin1String{name(quality)},
                                 number(each.seconds)};
        text += fields.join(',') + '\n';
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

// "Limits: 0 to 3 rad. 0.2 rad below the upper one."
QString CompareModel::limitText(const Row& row) {
    const DataItem& item = *row.item->item;
    const QString limits = limitsText(row.shown ? row.shown->item : item);
    if (limits.isEmpty()) return tr("It has no limits.");
    QString text = tr("Limits: %1.").arg(limits);
    if (!row.left) return text;
    const bool above = row.upper == (*row.left < 0);
    const QString number = shownNumber(row, std::abs(*row.left)) + ' ' + row.unit;
    const QString place =
        row.upper ? (above ? tr("%1 above the upper one.") : tr("%1 below the upper one."))
                  : (above ? tr("%1 above the lower one.") : tr("%1 below the lower one."));
    return text + ' ' + place.arg(number.trimmed());
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
