// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/query.hpp"
#include "session/frame.hpp"
#include "style/shapes.hpp"

#include <QAbstractItemModel>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cortex::gui {

// What a row of the tree says of a simplex and of what lies below it.
struct Marks {
    Shape shape = Shape::Path;
    std::optional<Shape> own;    // of its quality, or that two agents claim it
    std::optional<Shape> worst;  // of what lies below
    bool operator==(const Marks&) const = default;
};

// The paths of all agents as one tree. It is never reset: rows come and go one run at a time, so
// that what is open, chosen and scrolled to stays so.
class SystemModel : public QAbstractItemModel {
    Q_OBJECT
public:
    enum Roles { PathRole = Qt::UserRole, TypeRole, WordRole };

    explicit SystemModel(QObject* parent = nullptr);
    ~SystemModel() override;

    void update(std::shared_ptr<const Frame> frame);
    void setFilter(Query query);
    const Query& filter() const { return query_; }
    Qt::ItemFlags flags(const QModelIndex& index) const override;  // simplexes can be dragged

    const Frame& frame() const { return *frame_; }
    const Marks& marks(const QModelIndex& index) const;
    std::string path(const QModelIndex& index) const;
    std::optional<Place> place(const QModelIndex& index) const;
    QModelIndex indexOf(const std::string& path) const;  // invalid: not shown
    int simplexes() const { return simplexes_; }         // of the present agents
    int matching() const { return matching_; }           // of those, that the filter shows

    QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
    QModelIndex parent(const QModelIndex& index) const override;
    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;

private:
    struct Node;
    struct Wanted;

    Wanted wanted();
    void change(Node& node, const Wanted& wanted);
    void takeRows(Node& node, const Wanted& wanted);
    void addRows(Node& node, const Wanted& wanted);
    void refresh(Node& node);
    Node* nodeOf(const QModelIndex& index) const;
    QModelIndex indexOf(const Node& node) const;
    QString word(const Node& node) const;

    std::shared_ptr<const Frame> frame_;
    std::unique_ptr<Node> root_;
    Query query_;
    int simplexes_ = 0, matching_ = 0;
    std::uint64_t looked_ = 0;  // half second of frames in which conditions were looked at
};

}  // namespace cortex::gui
