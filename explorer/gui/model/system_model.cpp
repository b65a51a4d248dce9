// SPDX-License-Identifier: Apache-2.0
#include "model/system_model.hpp"

#include "model/natural_order.hpp"

#include <algorithm>
#include <utility>

namespace cortex::gui {

namespace {

constexpr int framesBetweenFilters = 15;  // conditions on states are looked at twice a second

int weight(const std::optional<Shape>& shape) {
    if (!shape) return 0;
    switch (*shape) {
        case Shape::Fault:
            return 6;
        case Shape::Contradiction:
            return 5;
        case Shape::Lost:
            return 4;
        case Shape::Bad:
            return 3;
        case Shape::Stale:
            return 2;
        default:
            return 1;
    }
}

std::optional<Shape> worse(std::optional<Shape> a, std::optional<Shape> b) {
    return weight(a) >= weight(b) ? a : b;
}

bool isAgent(const Type& type) { return type.isA("Agent"); }

Marks ownMarks(const Frame& frame, std::optional<Place> place, bool twice) {
    Marks marks;
    if (!place) return marks;
    const AgentFrame& agent = frame.agents[place->agent];
    const Type& type = frame.type(*place);
    const auto state = agent.state(place->simplex);
    if (isAgent(type))
        marks.shape = Shape::Agent;
    else if (state)
        marks.shape = shapeOf(*state);
    else
        marks.shape = type.active() ? Shape::Unknown : Shape::Data;
    const Excuse excuse = frame.excuse(*place);
    if (excuse == Excuse::Ended)
        marks.own = Shape::Ended;
    else if (agent.lost())
        marks.own = Shape::Lost;
    else if (agent.came(place->simplex) && excuse == Excuse::None)
        marks.own = shapeOf(agent.quality(place->simplex));
    if (twice) marks.own = worse(marks.own, Shape::Contradiction);
    return marks;
}

}  // namespace

struct SystemModel::Wanted {
    std::map<std::string, Wanted, NaturalOrder> children;
    std::optional<Place> place;
    QString type;
    bool twice = false;  // two agents claim it

    void name(const Frame& frame) {
        if (place) type = QString::fromStdString(frame.type(*place).name);
        for (auto& [below, each] : children) each.name(frame);
    }
    void add(const std::string_view whole, Place where, const Frame& frame) {
        Wanted* node = this;
        std::string_view path = whole;
        while (!path.empty()) {
            path.remove_prefix(1);  // the slash
            const std::string_view name = path.substr(0, path.find('/'));
            node = &node->children[std::string{name}];
            path.remove_prefix(name.size());
        }
        if (!node->place) {
            node->place = where;
            return;
        }
        const std::uint32_t first = node->place->agent;
        if (!frame.agents[first].lost() && !frame.agents[where.agent].lost()) node->twice = true;
        if (frame.isOwner(where.agent, first, whole)) node->place = where;
    }
};

struct SystemModel::Node {
    std::string name, path;
    Node* parent = nullptr;
    int row = 0;
    std::vector<std::unique_ptr<Node>> children;
    std::optional<Place> place;
    QString type;  // a place is of the newest frame, which has no row that is just going
    bool twice = false;
    Marks marks;

    void number() {
        for (std::size_t i = 0; i < children.size(); ++i) children[i]->row = static_cast<int>(i);
    }
    static std::unique_ptr<Node> make(Node& parent, const std::string& name, const Wanted& wanted) {
        auto node = std::make_unique<Node>();
        node->name = name;
        node->path = parent.path + '/' + name;
        node->parent = &parent;
        node->place = wanted.place;
        node->type = wanted.type;
        node->twice = wanted.twice;
        for (const auto& [below, each] : wanted.children) {
            node->children.push_back(make(*node, below, each));
        }
        node->number();
        return node;
    }
};

SystemModel::SystemModel(QObject* parent)
    : QAbstractItemModel{parent},
      frame_{std::make_shared<Frame>()},
      root_{std::make_unique<Node>()} {}

SystemModel::~SystemModel() = default;

void SystemModel::update(std::shared_ptr<const Frame> frame) {
    const bool changed = frame->structures != frame_->structures;
    frame_ = std::move(frame);
    const std::uint64_t now = frame_->number / framesBetweenFilters;  // some frames are never seen
    if (changed || (!query_.empty() && now != looked_)) change(*root_, wanted());
    looked_ = now;
    refresh(*root_);
}

Qt::ItemFlags SystemModel::flags(const QModelIndex& index) const {
    const Qt::ItemFlags usual = QAbstractItemModel::flags(index);
    return place(index) ? usual | Qt::ItemIsDragEnabled : usual;
}

void SystemModel::setFilter(Query query) {
    query_ = std::move(query);
    change(*root_, wanted());
    refresh(*root_);
}

SystemModel::Wanted SystemModel::wanted() {
    Wanted all;
    simplexes_ = matching_ = 0;
    for (std::uint32_t a = 0; a < frame_->agents.size(); ++a) {
        const auto& structure = frame_->agents[a].structure;
        if (!structure) continue;
        for (std::uint32_t i = 0; i < structure->simplexes.size(); ++i) {
            const SimplexInfo& info = structure->simplexes[i];
            if (info.remote) continue;
            ++simplexes_;
            if (!query_.matches(*frame_, {a, i})) continue;
            ++matching_;
            all.add(info.path, {a, i}, *frame_);
        }
    }
    all.name(*frame_);
    return all;
}

// Rows that go, then rows that come, then the same below what stays.
void SystemModel::change(Node& node, const Wanted& wanted) {
    takeRows(node, wanted);
    addRows(node, wanted);
    for (const auto& child : node.children) {
        const Wanted& each = wanted.children.find(child->name)->second;
        child->place = each.place;
        child->type = each.type;
        child->twice = each.twice;
        change(*child, each);
    }
}

void SystemModel::takeRows(Node& node, const Wanted& wanted) {
    const auto goes = [&](int row) {
        return !wanted.children.contains(node.children[static_cast<std::size_t>(row)]->name);
    };
    for (int last = static_cast<int>(node.children.size()) - 1; last >= 0; --last) {
        if (!goes(last)) continue;
        int first = last;
        while (first > 0 && goes(first - 1)) --first;
        beginRemoveRows(indexOf(node), first, last);
        node.children.erase(node.children.begin() + first, node.children.begin() + last + 1);
        node.number();
        endRemoveRows();
        last = first;
    }
}

void SystemModel::addRows(Node& node, const Wanted& wanted) {
    std::size_t row = 0;
    for (auto each = wanted.children.begin(); each != wanted.children.end();) {
        const auto isHere = [&] {
            return row < node.children.size() && node.children[row]->name == each->first;
        };
        if (isHere()) {
            ++row;
            ++each;
            continue;
        }
        std::vector<std::unique_ptr<Node>> run;
        for (; each != wanted.children.end() && !isHere(); ++each) {
            run.push_back(Node::make(node, each->first, each->second));
        }
        const auto first = static_cast<int>(row), last = first + static_cast<int>(run.size()) - 1;
        beginInsertRows(indexOf(node), first, last);
        row += run.size();
        node.children.insert(node.children.begin() + first, std::make_move_iterator(run.begin()),
                             std::make_move_iterator(run.end()));
        node.number();
        endInsertRows();
    }
}

void SystemModel::refresh(Node& node) {
    Marks marks = ownMarks(*frame_, node.place, node.twice);
    int first = -1, last = -1;
    for (const auto& child : node.children) {
        const Marks before = child->marks;
        refresh(*child);
        if (!(child->marks == before)) {
            if (first < 0) first = child->row;
            last = child->row;
        }
        marks.worst = worse(marks.worst, child->marks.worst);
        marks.worst = worse(marks.worst, child->marks.own);
        if (child->marks.shape == Shape::Fault) marks.worst = worse(marks.worst, Shape::Fault);
    }
    node.marks = marks;
    if (first >= 0) {
        Q_EMIT dataChanged(
            createIndex(first, 0, node.children[static_cast<std::size_t>(first)].get()),
            createIndex(last, 0, node.children[static_cast<std::size_t>(last)].get()));
    }
}

SystemModel::Node* SystemModel::nodeOf(const QModelIndex& index) const {
    return index.isValid() ? static_cast<Node*>(index.internalPointer()) : root_.get();
}

QModelIndex SystemModel::indexOf(const Node& node) const {
    return node.parent == nullptr ? QModelIndex{}
                                  : createIndex(node.row, 0, const_cast<Node*>(&node));
}

QModelIndex SystemModel::indexOf(const std::string& path) const {
    const Node* node = root_.get();
    while (node->path != path) {
        const auto next = std::ranges::find_if(node->children, [&](const auto& child) {
            return path == child->path || path.starts_with(child->path + '/');
        });
        if (next == node->children.end()) return {};
        node = next->get();
    }
    return indexOf(*node);
}

const Marks& SystemModel::marks(const QModelIndex& index) const { return nodeOf(index)->marks; }
std::string SystemModel::path(const QModelIndex& index) const { return nodeOf(index)->path; }
std::optional<Place> SystemModel::place(const QModelIndex& index) const {
    return nodeOf(index)->place;
}

QModelIndex SystemModel::index(int row, int column, const QModelIndex& parent) const {
    if (!hasIndex(row, column, parent)) return {};
    return createIndex(row, column, nodeOf(parent)->children[static_cast<std::size_t>(row)].get());
}

QModelIndex SystemModel::parent(const QModelIndex& index) const {
    if (!index.isValid()) return {};
    return indexOf(*nodeOf(index)->parent);
}

int SystemModel::rowCount(const QModelIndex& parent) const {
    return static_cast<int>(nodeOf(parent)->children.size());
}

int SystemModel::columnCount(const QModelIndex& /*parent*/) const { return 1; }

// The word of the state stands in place of the type where the state is not an ordinary one.
QString SystemModel::word(const Node& node) const {
    if (!node.place) return {};
    const Shape shape = node.marks.shape;
    const bool ordinary = shape == Shape::Active || shape == Shape::Standby ||
                          shape == Shape::Data || shape == Shape::Agent;
    if (!ordinary) return gui::word(shape);
    return node.type;
}

QVariant SystemModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid()) return {};
    const Node& node = *nodeOf(index);
    switch (role) {
        case Qt::DisplayRole:
            return QString::fromStdString(node.name);
        case PathRole:
            return QString::fromStdString(node.path);
        case WordRole:
            return word(node);
        case TypeRole:
            return node.type;
        case Qt::ToolTipRole:
        case Qt::AccessibleTextRole: {
            QStringList parts{QString::fromStdString(node.path)};
            if (node.place) parts << node.type;
            if (node.marks.shape <= Shape::Unknown) parts << gui::word(node.marks.shape);
            if (node.marks.own) parts << gui::word(*node.marks.own);
            if (node.marks.worst) parts << tr("below: %1").arg(gui::word(*node.marks.worst));
            return parts.join(QStringLiteral(", "));
        }
        default:
            return {};
    }
}

}  // namespace cortex::gui
