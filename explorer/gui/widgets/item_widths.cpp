// SPDX-License-Identifier: Apache-2.0
#include "widgets/item_widths.hpp"

#include "model/value_text.hpp"
#include "widgets/rows.hpp"

#include <algorithm>
#include <vector>

namespace cortex::gui {

namespace {

constexpr double mostLimit = 36, mostValue = 56, mostRemark = 56, leastName = 28;  // units

double usual(int column) { return usualItemWidths[static_cast<std::size_t>(column)]; }

// Texts and arrays may be of any length: they are cut.
bool hasWidth(const ItemModel::Row& row) {
    return row.item->kind != Kind::String && (!row.whole || row.item->length == 1);
}

// The widest that the value can be now: every label of an enumeration.
int widthOfValue(const ItemModel::Row& row) {
    if (!hasWidth(row)) return 0;
    int widest = textWidth(bracketed(row.value), true);
    for (const auto& [number, label] : row.asShown().labels) {
        const QString text =
            elementText(row.asShown(), Value{std::vector<std::int64_t>{number}}, 0);
        widest = std::max(widest, textWidth(bracketed(text)));
    }
    return widest;
}

int widthOfMarks() {
    int widest = 0;
    for (const Shape each : {Shape::Stale, Shape::Bad, Shape::Lost, Shape::AboveLimit,
                             Shape::BelowLimit, Shape::NoLabel})
        widest = std::max(widest, textWidth(word(each), true));
    return markSize() + Look::units(1.5) + widest;
}

template <class Look>
void lookAtItems(const ItemModel& items, Look look) {
    for (int i = 0; i < items.rowCount(); ++i) {
        const QModelIndex group = items.index(i, 0);
        for (int row = 0; row < items.rowCount(group); ++row) {
            const ItemModel::Row& each = items.row(items.index(row, 0, group));
            if (each.item != nullptr) look(each);
        }
    }
}

}  // namespace

std::pair<QString, QString> limitsOf(const ItemModel::Row& row) {
    const DataItem& item = row.asShown();
    const QString least = row.min ? numberText(item, *row.min) : QString{};
    const QString most = row.max ? numberText(item, *row.max) : QString{};
    if (!row.max) return {QStringLiteral("≥ ") + least, {}};
    if (!row.min) return {{}, QStringLiteral("≤ ") + most};
    return {least, most};
}

int longestValue(const ItemModel& items) {
    int longest = 0;
    lookAtItems(items, [&](const ItemModel::Row& row) {
        if (hasWidth(row)) longest = std::max(longest, row.value.size());
    });
    return longest;
}

ItemTexts widestTexts(const ItemModel& items) {
    ItemTexts widest;
    widest.remark = widest.mark = widthOfMarks();
    widest.unit =
        textWidth(items.headerData(ItemModel::Unit, Qt::Horizontal, Qt::DisplayRole).toString());
    lookAtItems(items, [&](const ItemModel::Row& row) {
        widest.name = std::max(widest.name, textWidth(row.name));
        widest.value = std::max(widest.value, widthOfValue(row));
        widest.unit = std::max(widest.unit, textWidth(row.unit));
        widest.remark = std::max(widest.remark, textWidth(row.remark));
        if (!row.min && !row.max) return;
        const auto& [least, most] = limitsOf(row);
        widest.limit = std::max({widest.limit, textWidth(least), textWidth(most)});
    });
    return widest;
}

// Where there is little room, names, units, remarks and then values have no more than they need. A
// mark keeps its word, and a range is whole or not shown. A name is cut before a value is.
ItemWidths itemWidths(const ItemTexts& widest, double room, double indent) {
    const double unit = Look::length(1);
    const auto wider = [&](int column, int pixels, double margins, double most) {
        return std::clamp(pixels / unit + margins, usual(column), std::max(most, usual(column)));
    };
    const auto shrunk = [&](int column, int pixels, double margins, double others) {
        const double least = std::min(pixels / unit + margins, usual(column));
        return std::clamp(room - others, least, usual(column));
    };
    const double range =
        wider(ItemModel::Range, 2 * widest.limit, leastTrack + 4.5, 2 * mostLimit + 24);
    const double remark = wider(ItemModel::Remark, widest.remark, 4.5, mostRemark);
    const double leastRemark = std::min(widest.mark / unit + 4.5, remark);
    const double wanted = wider(ItemModel::Value, widest.value, 2.5, mostValue);
    const double others = wanted + range + remark + usual(ItemModel::Description);
    const double whole =
        shrunk(ItemModel::Name, widest.name, indent + 4.5, others + usual(ItemModel::Unit));
    const double units = shrunk(ItemModel::Unit, widest.unit, 4.5, others + whole);
    const double name = std::min(whole, std::max(room - wanted - units - leastRemark, leastName));
    const double value =
        std::clamp(room - name - units - leastRemark, usual(ItemModel::Value), wanted);
    const double left = room - name - units - value;
    const bool hasRange = left >= range + leastRemark;
    return {name,
            value,
            units,
            range,
            std::clamp(left - (hasRange ? range : 0), leastRemark, remark),
            usual(ItemModel::Description)};
}

}  // namespace cortex::gui
