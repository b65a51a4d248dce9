// SPDX-License-Identifier: Apache-2.0
#include "views/relation_table.hpp"

#include "model/plain_text.hpp"
#include "widgets/rows.hpp"

namespace cortex::explorer {

namespace {

enum Column { RuleColumn, DirectionColumn, TargetColumn, TypeColumn, StateColumn, DetailsColumn };
constexpr int indexRole = Qt::UserRole;

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

void RelationTable::show(const Frame& frame, Place place) {
    clear();
    const Structure& structure = *frame.agents[place.agent].structure;
    const SimplexInfo& info = structure.simplexes[place.simplex];
    count_ = 0;
    const auto add = [&](QTreeWidgetItem* parent, const Edge& edge, std::uint32_t other) {
        const SimplexInfo& target = structure.simplexes[other];
        auto* item = new QTreeWidgetItem{parent,
                                         {QString::fromStdString(edge.rule->name),
                                          QLatin1String{name(edge.rule->direction)},
                                          QString::fromStdString(target.path),
                                          QString::fromStdString(target.layout->type->name),
                                          {},
                                          details(edge, structure.simplexes[edge.target])}};
        item->setData(StateColumn, indexRole, other);
        item->setToolTip(RuleColumn, tipText(QString::fromStdString(edge.rule->description)));
    };
    if (info.edgeCount > 0) {
        auto* own = addGroup(*this, tr("To others"));
        for (std::uint32_t i = info.firstEdge; i < info.firstEdge + info.edgeCount; ++i) {
            if (structure.edges[i].target == noSimplex) continue;
            add(own, structure.edges[i], structure.edges[i].target);
            ++count_;
        }
    }
    QTreeWidgetItem* others = nullptr;
    for (const Edge& edge : structure.edges) {
        if (edge.target != place.simplex) continue;
        if (others == nullptr) others = addGroup(*this, tr("From others"));
        add(others, edge, edge.owner);
    }
    tellWhole(*this);
    expandAll();
    setWidths(*this, {36.0, 20.0, 56.0, 44.0, 28.0});
}

void RelationTable::refresh(const Frame& frame, Place place) {
    const AgentFrame& agent = frame.agents[place.agent];
    for (int g = 0; g < topLevelItemCount(); ++g) {
        for (int i = 0; i < topLevelItem(g)->childCount(); ++i) {
            QTreeWidgetItem* item = topLevelItem(g)->child(i);
            const auto simplex = item->data(StateColumn, indexRole).toUInt();
            const auto state = agent.state(simplex);
            const Quality quality = agent.lost() ? Quality::Lost : agent.quality(simplex);
            QString text = state ? QString{QLatin1String{name(*state)}} : QString{};
            if (!agent.came(simplex))
                text = QStringLiteral("…");
            else if (quality != Quality::Good) {
                text += (text.isEmpty() ? QString{} : QStringLiteral(", ")) +
                        QLatin1String{name(quality)};
            }
            setCell(*item, StateColumn, text);
        }
    }
}

}  // namespace cortex::explorer
