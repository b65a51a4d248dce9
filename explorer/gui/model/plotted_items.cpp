// SPDX-License-Identifier: Apache-2.0
#include "model/plotted_items.hpp"

#include "common/live_rule.hpp"
#include "model/item_model.hpp"
#include "model/item_text.hpp"

#include <algorithm>

namespace cortex::gui {

namespace {

constexpr std::size_t most = 16;  // lines at once

void add(std::vector<RecordedItem>& found, const std::string& path, const DataItem& item,
         std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end && found.size() < most; ++i)
        found.push_back({{}, path, item.name, i});
}

void add(std::vector<RecordedItem>& found, const ItemModel::Row& row) {
    if (row.item == nullptr) return;
    const std::size_t first = row.whole ? 0 : row.element;
    add(found, row.path, *row.item, first, row.whole ? row.item->length : first + 1);
}

bool isNumber(const DataItem& item) { return item.kind == Kind::Int || item.kind == Kind::Float; }

}  // namespace

std::vector<RecordedItem> plottedItems(const ItemModel& items, const QModelIndex& row) {
    std::vector<RecordedItem> found;
    if (!row.isValid()) return found;
    const QModelIndex first = row.siblingAtColumn(0);
    const ItemModel::Row& shown = items.row(first);
    add(found, shown);
    if (shown.item != nullptr) return found;
    for (int i = 0; i < items.rowCount(first); ++i) {
        const ItemModel::Row& each = items.row(items.index(i, 0, first));
        if (each.item != nullptr && !each.item->constant) add(found, each);
    }
    return found;
}

std::vector<RecordedItem> plottedItems(const Frame& frame, const std::string& path) {
    std::vector<RecordedItem> found;
    const auto place = frame.find(path);
    if (!place) return found;
    const Structure& structure = *frame.agents[place->agent].structure;
    const auto ofFramework = [&](const DataItem& item) {
        return common::isOfFramework(structure, place->simplex, item.name);
    };
    for (const bool framework : {false, true}) {
        for (const DataItem& each : frame.type(*place).data) {
            if (isNumber(each) && !each.constant && ofFramework(each) == framework)
                add(found, path, each, 0, each.length);
        }
        if (!found.empty()) break;
    }
    return found;
}

std::vector<RecordedItem> plottedItems(const Frame& frame, const std::string& path,
                                       std::string_view item) {
    std::vector<RecordedItem> found;
    const auto place = frame.find(path);
    const DataItem* known = place ? frame.type(*place).findData(item) : nullptr;
    if (known != nullptr) add(found, path, *known, 0, known->length);
    return found;
}

}  // namespace cortex::gui
