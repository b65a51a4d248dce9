// SPDX-License-Identifier: Apache-2.0
#include "views/counter_table.hpp"

#include "model/plain_text.hpp"
#include "model/value_text.hpp"
#include "widgets/rows.hpp"

#include <QHeaderView>
#include <cmath>

namespace cortex::gui {

namespace {

enum CounterColumn { NameColumn, CountColumn, MinuteColumn, MeaningColumn };

struct CounterWords {
    const char* name;
    bool trouble;  // one more of it is worth a look
};
constexpr std::array<CounterWords, counterCount> counterWords{{
    {QT_TRANSLATE_NOOP("CounterTable", "Missed ticks"), true},
    {QT_TRANSLATE_NOOP("CounterTable", "Commands"), false},
    {QT_TRANSLATE_NOOP("CounterTable", "Rejected commands"), false},
    {QT_TRANSLATE_NOOP("CounterTable", "Writer conflicts"), true},
    {QT_TRANSLATE_NOOP("CounterTable", "Cycles at a limit"), false},
    {QT_TRANSLATE_NOOP("CounterTable", "Dropped events"), true},
    {QT_TRANSLATE_NOOP("CounterTable", "Lost samples"), true},
}};

QString meaningOf(const AgentFrame& agent, Counter counter) {
    if (counter == Counter::Loss)
        return CounterTable::tr("Blocks and events that did not come here.");
    if (agent.own() == noSimplex) return {};
    const Type& type = *agent.structure->simplexes[agent.own()].layout->type;
    const ItemLayout* item = agent.structure->simplexes[agent.own()].layout->find(itemOf(counter));
    if (item == nullptr)
        return CounterTable::tr("%1 does not count it.").arg(QString::fromStdString(type.name));
    return plainText(item->item->description);
}

QString textOfCount(std::int64_t count) {
    return count < 0 ? QString::number(count) : countText(static_cast<std::uint64_t>(count));
}

QString changeText(const LoopHistory::Change& change) {
    QString more = (change.more > 0 ? "+" : "") + textOfCount(change.more);
    if (change.seconds > 58) return more;
    return CounterTable::tr("%1 in %2").arg(more, wholeAgeText(change.seconds));
}

}  // namespace

CounterTable::CounterTable(QWidget* parent) : QTreeWidget{parent} {
    setUpRows(*this);
    setRootIsDecorated(false);
    setAccessibleName(tr("What the agent counts"));
    setHeaderLabels({tr("Counted"), tr("Since the start"), tr("Last minute"), tr("What it is")});
    for (const int column : {CountColumn, MinuteColumn})
        headerItem()->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
    keepWidths(*this, {40, 30, 30});
    setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
    for (const CounterWords& each : counterWords) {
        auto* row = new QTreeWidgetItem{this, {tr(each.name)}};
        for (const int column : {CountColumn, MinuteColumn})
            row->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
    }
    tellWhole(*this);
}

void CounterTable::show(const AgentFrame& agent, const LoopHistory& history) {
    const Tokens& c = Look::colours();
    for (int i = 0; i < topLevelItemCount(); ++i) {
        QTreeWidgetItem& row = *topLevelItem(i);
        const auto counter = static_cast<Counter>(i);
        const auto count = countOf(agent, counter);
        const auto change = history.change(agent, counter);
        QString text = QStringLiteral("—");
        if (count) text = textOfCount(*count);
        if (count && !agent.beats() && counter != Counter::Loss) text = bracketed(text);
        setCell(row, CountColumn, text);
        setCell(row, MinuteColumn, change ? changeText(*change) : QStringLiteral("—"));
        setCell(row, MeaningColumn, meaningOf(agent, counter));
        const bool amber =
            counterWords[static_cast<std::size_t>(i)].trouble && change && change->more > 0;
        row.setForeground(MinuteColumn, amber ? c.warnText : c.ink);
        row.setForeground(MeaningColumn, c.ink2);
    }
    for (const int column : {NameColumn, CountColumn, MinuteColumn}) growToFit(*this, column);
}

QSize CounterTable::sizeHint() const {
    return {Look::units(120),
            header()->sizeHint().height() + topLevelItemCount() * gui::rowHeight()};
}

}  // namespace cortex::gui
