// SPDX-License-Identifier: Apache-2.0
#include "views/relation_table.hpp"

#include "model/plain_text.hpp"
#include "model/value_text.hpp"
#include "style/shapes.hpp"
#include "widgets/rows.hpp"

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
                     .arg(rule.maxAge)
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
void RelationTable::add(QTreeWidgetItem* group, const Frame& frame, const Edge& edge, Place other) {
    const SimplexInfo& info = frame.info(other);
    const Structure& structure = *frame.agents[other.agent].structure;
    auto* item = new QTreeWidgetItem{group,
                                     {QString::fromStdString(edge.rule->name),
                                      QLatin1String{name(edge.rule->direction)},
                                      QString::fromStdString(info.path),
                                      QString::fromStdString(info.layout->type->name),
                                      {},
                                      details(edge, structure.simplexes[edge.target])}};
    item->setData(StateColumn, simplexRole, other.simplex);
    item->setData(StateColumn, agentRole, other.agent);
    item->setToolTip(RuleColumn, tipText(QString::fromStdString(edge.rule->description)));
    ++count_;
}

void RelationTable::show(const Frame& frame, Place place) {
    clear();
    const Structure& structure = *frame.agents[place.agent].structure;
    const SimplexInfo& info = structure.simplexes[place.simplex];
    count_ = 0;
    if (info.edgeCount > 0) {
        auto* own = addGroup(*this, tr("To others"));
        for (std::uint32_t i = info.firstEdge; i < info.firstEdge + info.edgeCount; ++i) {
            if (structure.edges[i].target == noSimplex) continue;
            add(own, frame, structure.edges[i], {place.agent, structure.edges[i].target});
        }
    }
    showOthers(frame, place);
    tellWhole(*this);
    expandAll();
    setWidths(*this, {36.0, 20.0, 56.0, 44.0, 28.0});
    for (const int column : {RuleColumn, DirectionColumn, TargetColumn}) growToFit(*this, column);
}

// Those of its own agent, and those of other agents that read it.
void RelationTable::showOthers(const Frame& frame, Place place) {
    const std::string& path = frame.info(place).path;
    QTreeWidgetItem* others = nullptr;
    for (std::uint32_t a = 0; a < frame.agents.size(); ++a) {
        const auto& structure = frame.agents[a].structure;
        if (!structure) continue;
        for (const Edge& edge : structure->edges) {
            if (edge.target == noSimplex) continue;
            const SimplexInfo& target = structure->simplexes[edge.target];
            const bool own = a == place.agent && edge.target == place.simplex;
            const bool remote = a != place.agent && target.remote && target.path == path;
            if (!own && !remote) continue;
            if (others == nullptr) others = addGroup(*this, tr("From others"));
            add(others, frame, edge, {a, edge.owner});
        }
    }
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
