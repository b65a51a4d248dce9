// SPDX-License-Identifier: Apache-2.0
#include "views/relation_table.hpp"

#include "model/plain_text.hpp"
#include "model/value_text.hpp"
#include "style/shapes.hpp"
#include "widgets/rows.hpp"

#include <QScrollBar>
#include <algorithm>
#include <utility>

namespace cortex::gui {

namespace {

enum Column { RuleColumn, DirectionColumn, TargetColumn, TypeColumn, StateColumn, DetailsColumn };
constexpr int simplexRole = Qt::UserRole, agentRole = Qt::UserRole + 1;

QString details(const Edge& edge, const SimplexInfo& target) {
    const Rule& rule = *edge.rule;
    QStringList parts;
    const QString most = rule.max == Rule::many ? QStringLiteral("∞") : QString::number(rule.max);
    parts << RelationTable::tr("%1 to %2").arg(rule.min).arg(most);
    if (edge.delayed) parts << RelationTable::tr("delayed");
    if (target.remote) {
        parts << RelationTable::tr("of another agent, at most %1 s old, then %2")
                     .arg(edge.maxAge)
                     .arg(QLatin1String{name(rule.onLoss)});
    }
    return parts.join(QStringLiteral(", "));
}

// "[Active], lost"; of a simplex of another agent as that one says.
QString stateText(const Frame& frame, Place place) {
    const SimplexInfo& info = frame.info(place);
    const auto here = info.remote ? frame.find(info.path) : place;
    if (!here || !frame.agents[here->agent].came(here->simplex)) {
        const GoneAgent* gone = frame.goneFrom(info.path);
        if (gone == nullptr) return QStringLiteral("…");
        return word(gone->ended ? Shape::Ended : Shape::Lost);
    }
    const AgentFrame& agent = frame.agents[here->agent];
    const auto state = agent.lastState(here->simplex);
    const Quality quality = agent.lost() ? Quality::Lost : agent.quality(here->simplex);
    QStringList words;
    if (state) words << QLatin1String{name(*state)};
    if (state && agent.lost()) words.front() = bracketed(words.front());
    if (agent.status.ended)
        words << word(Shape::Ended);
    else if (quality != Quality::Good)
        words << QLatin1String{name(quality)};
    return words.join(QStringLiteral(", "));
}

}  // namespace

RelationTable::RelationTable(QWidget* parent) : QTreeWidget{parent} {
    setUpRows(*this);
    setAccessibleName(tr("Relationships"));
    setHeaderLabels(
        {tr("Rule"), tr("Direction"), tr("Simplex"), tr("Type"), tr("State"), tr("Details")});
    connect(this, &QTreeWidget::itemActivated, this, [this](QTreeWidgetItem* item) {
        if (item->parent() != nullptr) Q_EMIT opened(item->text(TargetColumn).toStdString());
    });
}

// `other` is the simplex at the other end.
RelationTable::Row RelationTable::rowOf(const Frame& frame, const Edge& edge, Place other,
                                        bool outgoing) {
    const SimplexInfo& info = frame.info(other);
    const Structure& structure = *frame.agents[other.agent].structure;
    return {outgoing,
            {QString::fromStdString(edge.rule->name),
             QLatin1String{name(edge.rule->direction)},
             QString::fromStdString(info.path),
             QString::fromStdString(info.layout->type->name),
             {},
             details(edge, structure.simplexes[edge.target])},
            tipText(QString::fromStdString(edge.rule->description)),
            other};
}

// Those to others; then those of its own agent to it, and of other agents that read it.
std::vector<RelationTable::Row> RelationTable::rowsOf(const Frame& frame, Place place) {
    std::vector<Row> rows;
    const Structure& own = *frame.agents[place.agent].structure;
    const SimplexInfo& info = own.simplexes[place.simplex];
    for (std::uint32_t i = info.firstEdge; i < info.firstEdge + info.edgeCount; ++i) {
        if (own.edges[i].target == noSimplex) continue;
        rows.push_back(rowOf(frame, own.edges[i], {place.agent, own.edges[i].target}, true));
    }
    for (std::uint32_t a = 0; a < frame.agents.size(); ++a) {
        const auto& structure = frame.agents[a].structure;
        if (!structure) continue;
        for (const Edge& edge : structure->edges) {
            if (edge.target == noSimplex) continue;
            const SimplexInfo& target = structure->simplexes[edge.target];
            const bool inside = a == place.agent && edge.target == place.simplex;
            const bool remote = a != place.agent && target.remote && target.path == info.path;
            if (inside || remote) rows.push_back(rowOf(frame, edge, {a, edge.owner}, false));
        }
    }
    return rows;
}

// The same rows stay as they are: it is shown anew also when another agent comes or goes.
void RelationTable::show(const Frame& frame, Place place) {
    const std::vector<Row> rows = rowsOf(frame, place);
    const std::string& path = frame.info(place).path;
    const bool same =
        std::exchange(path_, path) == path &&
        std::ranges::equal(rows, items_, [](const Row& row, const QTreeWidgetItem* item) {
            const auto isAt = [&](int column) { return item->text(column) == row.texts[column]; };
            const bool outgoing = item->parent()->data(RuleColumn, simplexRole).toBool();
            return outgoing == row.outgoing && isAt(RuleColumn) && isAt(DirectionColumn) &&
                   isAt(TargetColumn) && isAt(TypeColumn) && isAt(DetailsColumn);
        });
    if (!same) fill(rows);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        items_[i]->setData(StateColumn, simplexRole, rows[i].other.simplex);
        items_[i]->setData(StateColumn, agentRole, rows[i].other.agent);
    }
}

void RelationTable::fill(const std::vector<Row>& rows) {
    const int scrolled = verticalScrollBar()->value();
    clear();
    items_.clear();
    QTreeWidgetItem* group = nullptr;
    for (const Row& each : rows) {
        if (group == nullptr || group->data(RuleColumn, simplexRole).toBool() != each.outgoing) {
            group = addGroup(*this, each.outgoing ? tr("To others") : tr("From others"));
            group->setData(RuleColumn, simplexRole, each.outgoing);
        }
        items_.push_back(new QTreeWidgetItem{group, each.texts});
        items_.back()->setToolTip(RuleColumn, each.tip);
    }
    count_ = static_cast<int>(rows.size());
    tellWhole(*this);
    expandAll();
    setWidths(*this, {36.0, 20.0, 56.0, 44.0, 28.0});
    for (const int column : {RuleColumn, DirectionColumn, TargetColumn}) growToFit(*this, column);
    verticalScrollBar()->setValue(scrolled);
}

void RelationTable::refresh(const Frame& frame) {
    bool changed = false;
    for (int g = 0; g < topLevelItemCount(); ++g) {
        for (int i = 0; i < topLevelItem(g)->childCount(); ++i) {
            QTreeWidgetItem* item = topLevelItem(g)->child(i);
            const auto simplex = item->data(StateColumn, simplexRole).toUInt();
            const auto a = item->data(StateColumn, agentRole).toUInt();
            if (a >= frame.agents.size() || !frame.agents[a].structure) continue;
            const QString text = stateText(frame, {a, simplex});
            changed = changed || text != item->text(StateColumn);
            setCell(*item, StateColumn, text);
        }
    }
    if (changed) growToFit(*this, StateColumn);
}

}  // namespace cortex::gui
