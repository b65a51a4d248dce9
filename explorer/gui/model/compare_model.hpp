// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/compare_row.hpp"
#include "model/query.hpp"
#include "record/recorded_item.hpp"

#include <QAbstractTableModel>
#include <QString>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace cortex::gui {

// One item of many simplexes, a row each: by value, by distance to its nearer limit, or by age.
class CompareModel : public QAbstractTableModel {
    Q_OBJECT
public:
    enum Column { Path, Value, Unit, Range, Distance, Age, Remark, ColumnCount };

    using Row = CompareRow;

    using QAbstractTableModel::QAbstractTableModel;

    void compare(const std::string& item, const QString& filter);
    const std::string& item() const { return item_; }
    const QString& filter() const { return filter_; }
    QString trouble() const { return frame_ ? query_.troubleIn(*frame_) : query_.trouble(); }
    void setUnits(const ShownUnits& units);
    const ShownUnits& units() const { return units_; }
    // `inOrder`: whether rows may move.
    void update(std::shared_ptr<const Frame> frame, bool inOrder);
    void sort(int column, Qt::SortOrder order) override;

    const Row& row(int index) const { return rows_[static_cast<std::size_t>(index)]; }
    // What a plot shows of a row. None: it is no number.
    RecordedItem recorded(int index) const;
    std::vector<std::string> paths() const;
    std::string csv()
        const;  // what is seen, a line a row, at full precision in the units of the model

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    void build();
    void order();
    bool before(const Row& one, const Row& other) const;

    std::string item_;
    QString filter_;
    Query query_;
    ShownUnits units_;
    std::shared_ptr<const Frame> frame_;
    std::uint64_t structures_ = 0;
    bool fresh_ = true;
    std::ptrdiff_t known_ = 0;  // rows whose value had come, when they were ordered
    std::vector<Row> rows_;
    int column_ = Distance;
    Qt::SortOrder order_ = Qt::AscendingOrder;
};

// The names of all items that are numbers, each once: first those that most simplexes have.
QStringList comparableItems(const Frame& frame);

}  // namespace cortex::gui
