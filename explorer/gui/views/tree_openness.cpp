// SPDX-License-Identifier: Apache-2.0
#include "views/tree_openness.hpp"

#include "model/system_model.hpp"
#include "views/tree_rows.hpp"

#include <QJsonArray>
#include <QScopedValueRollback>

namespace cortex::gui {

namespace {

// That are kept from start to start: a layout is a small file.
constexpr std::size_t mostPaths = 1'000, mostBytes = 100'000;

QString openKey(bool open) { return open ? QStringLiteral("open") : QStringLiteral("closed"); }

}  // namespace

TreeOpenness::TreeOpenness(TreeRows& rows, const SystemModel& model) : rows_{rows}, model_{model} {
    QObject::connect(&rows, &QTreeView::expanded, &rows,
                     [this](const QModelIndex& row) { note(row, true); });
    QObject::connect(&rows, &QTreeView::collapsed, &rows,
                     [this](const QModelIndex& row) { note(row, false); });
    QObject::connect(
        &model, &QAbstractItemModel::rowsInserted, &rows,
        [this](const QModelIndex& above, int first, int last) { added(above, first, last); });
}

// The first rows below one that had none.
void TreeOpenness::added(const QModelIndex& above, int first, int last) {
    apply(above, first, last);
    if (!above.isValid() || model_.rowCount(above) > last - first + 1) return;
    const QScopedValueRollback applying{applies_, true};
    rows_.setExpanded(above, isOpen(above));
}

bool TreeOpenness::isOpenAtFirst(const QModelIndex& row) const {
    const QModelIndex above = row.parent();
    if (above.parent().isValid()) return false;
    const auto place = model_.place(above.isValid() ? above : row);
    return !place || !model_.frame().type(*place).isA("Agent");
}

bool TreeOpenness::isOpen(const QModelIndex& row) const {
    if (all_) return true;
    const auto known = noted_.find(model_.path(row));
    return known != noted_.end() ? known->second : isOpenAtFirst(row);
}

void TreeOpenness::apply(const QModelIndex& above, int first, int last) {
    const QScopedValueRollback applying{applies_, true};
    for (int i = first; i <= last; ++i) {
        const QModelIndex row = model_.index(i, 0, above);
        const int below = model_.rowCount(row);
        if (below == 0) continue;
        rows_.setExpanded(row, isOpen(row));
        apply(row, 0, below - 1);
    }
}

void TreeOpenness::applyToAll() {
    rows_.openMany([this] { apply({}, 0, model_.rowCount() - 1); });
}

void TreeOpenness::note(const QModelIndex& row, bool open) {
    if (applies_ || all_) return;
    if (open == isOpenAtFirst(row))
        noted_.erase(model_.path(row));
    else
        noted_[model_.path(row)] = open;
}

void TreeOpenness::showAll(bool all) {
    if (!all && !all_) return;
    all_ = all;
    applyToAll();
}

QJsonObject TreeOpenness::saved() const {
    QJsonArray paths[2];
    std::size_t count = 0, bytes = 0;
    for (const auto& [path, open] : noted_) {
        bytes += path.size();
        if (++count > mostPaths || bytes > mostBytes) break;
        paths[open ? 1 : 0].append(QString::fromStdString(path));
    }
    return {{openKey(false), paths[0]}, {openKey(true), paths[1]}};
}

void TreeOpenness::restore(const QJsonObject& saved) {
    noted_.clear();
    for (const bool open : {false, true}) {
        for (const QJsonValue each : saved[openKey(open)].toArray()) {
            if (noted_.size() >= mostPaths) break;
            if (each.isString()) noted_[each.toString().toStdString()] = open;
        }
    }
    applyToAll();
}

}  // namespace cortex::gui
