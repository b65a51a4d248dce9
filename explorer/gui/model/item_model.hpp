// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/shown_units.hpp"
#include "session/frame.hpp"
#include "session/item_edits.hpp"
#include "style/shapes.hpp"

#include <QAbstractItemModel>
#include <QStringList>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cortex::gui {

// The data of one simplex as rows: a group for its own type, for each ancestor that adds items, and
// for each related simplex. Arrays open to one row an element.
class ItemModel : public QAbstractItemModel {
    Q_OBJECT
public:
    enum Column { Name, Value, Unit, Range, Remark, Description, ColumnCount };

    // What a row shows besides texts.
    struct Row {
        std::string path;                // the simplex that has the item
        const DataItem* item = nullptr;  // null: a group
        std::size_t element = 0;         // of an array
        QString name, value, unit, remark, note;
        QString edited;                          // what was entered and is not sent yet
        std::optional<double> number, min, max;  // as they are shown
        std::shared_ptr<const ShownItem> shown;  // null: as the model has it
        std::optional<Shape> mark;               // outside of its range, or not live
        bool demand = false;                     // a wish, of a modification
        bool whole = true;                       // the item, not one of its elements
        const DataItem& asShown() const { return shown ? shown->item : *item; }
    };

    explicit ItemModel(QObject* parent = nullptr);
    ~ItemModel() override;

    // And its related simplexes. What was entered for the one before is there when it comes back.
    void show(const std::string& path);
    const std::string& path() const { return path_; }
    void update(std::shared_ptr<const Frame> frame);

    void setUnits(const ShownUnits& units);
    const ShownUnits& units() const { return units_; }

    const Row& row(const QModelIndex& index) const;
    // What was entered for items of the simplex itself, and is not sent yet.
    ItemEdits::Values edits() const { return edits_.all(); }
    // What the row is entered as: an element of an array as an item of its own, "pose 3".
    static DataItem entryItem(const Row& row);
    // What a person entered for it, in the unit of the model; none, and why, where it is wrong.
    std::optional<cortex::Value> entered(const Row& row, const QString& text, QString& why) const;
    // Without those that were there when the simplex was shown again, but for the item entered
    // last.
    ItemEdits::Values freshEdits() const { return edits_.fresh(enteredLast_); }
    void clearEdits();
    // What was sent for that simplex when so many had been entered.
    void clearEdits(const std::string& path, const ItemEdits::Values& sent, std::uint64_t entries);
    // What was entered for simplexes that are not shown; by itself it has a store of its own.
    void keepIn(std::shared_ptr<KeptEdits> kept) { kept_ = std::move(kept); }
    const KeptEdits& kept() const { return *kept_; }
    bool settable(const QModelIndex& index) const;
    QString whyNotSettable(const QModelIndex& index) const;  // empty: it is
    // The value at full precision in plain ASCII, in the unit of the model; in brackets where it is
    // not live.
    QString copyText(const QModelIndex& index) const;

    Qt::ItemFlags flags(const QModelIndex& index) const override;
    // Takes what a person entered, unless it is wrong.
    bool setData(const QModelIndex& index, const QVariant& text, int role = Qt::EditRole) override;
    QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
    QModelIndex parent(const QModelIndex& index) const override;
    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

Q_SIGNALS:
    void refused(const QString& why);  // what was entered: "gain is out of the range 0 to 1"
    void accepted();                   // what was entered, also where it is as it was before
    // What was entered for items whose definition has changed since, and is forgotten.
    void setAside(const std::string& path, const QStringList& items);

private:
    struct Node;

    void build();
    void addGroups(Place place);
    void addRelated(Place place);
    void addItem(Node& group, const DataItem& item, Place place);
    void describe(Row& row) const;
    void describe(Node& node);
    void refresh(Node& node);
    std::optional<Place> placeOf(const Node& node) const;
    std::optional<cortex::Value> valueOf(const Node& node, std::optional<Place> place) const;
    void read(Node& node, std::optional<Place> place) const;
    void readNothing(Row& row, std::optional<Place> place) const;
    void changeEdits(const std::string& path);
    void setAsideChanged();
    bool settableRow(const Row& row) const;
    std::optional<cortex::Value> valueNow(const std::string& item) const;
    QString editedText(const Row& row) const;
    Node* nodeOf(const QModelIndex& index) const;

    std::string path_;
    std::shared_ptr<const Frame> frame_;
    std::shared_ptr<const Structure> structure_;  // that the rows were made from
    std::unique_ptr<Node> root_;
    std::optional<Place> built_;
    std::uint64_t structures_ = 0;
    ShownUnits units_;
    ItemEdits edits_;
    std::string enteredLast_;  // item
    std::shared_ptr<KeptEdits> kept_ = std::make_shared<KeptEdits>();
};

}  // namespace cortex::gui
