// SPDX-License-Identifier: Apache-2.0
#include "views/loop_table.hpp"

#include "views/loop_chart.hpp"
#include "widgets/rows.hpp"

#include <QHeaderView>
#include <QScrollBar>
#include <QStyledItemDelegate>
#include <algorithm>

namespace cortex::gui {

namespace {

enum LoopColumn {
    TitleColumn,
    FirstColumn,
    UnitColumn = FirstColumn + LoopFigure::Count,
    ChartColumn
};
enum LoopRow { DutyRow, DutyScaleRow, FirstTimeRow };

constexpr double leastChart = 36;  // units

// "p50 1.2, p99 3.4, …", for who does not see the marks.
QString spoken(const LoopTable& table, const LoopFigure& figure) {
    QStringList parts;
    for (int i = 0; i < LoopFigure::Count; ++i) {
        parts << table.headerItem()->text(FirstColumn + i) + ' ' +
                     figure.texts[static_cast<std::size_t>(i)];
    }
    return parts.join(QStringLiteral(", ")) + ' ' + figure.unit;
}

}  // namespace

class LoopTable::Delegate : public QStyledItemDelegate {
public:
    explicit Delegate(LoopTable& table) : QStyledItemDelegate{&table}, table_{table} {}

    QSize sizeHint(const QStyleOptionViewItem& /*option*/,
                   const QModelIndex& /*index*/) const override {
        return {Look::units(10), gui::rowHeight()};
    }

    void paint(QPainter* painter, const QStyleOptionViewItem& option,
               const QModelIndex& index) const override {
        const QRect box = option.rect.adjusted(Look::units(2), 0, -Look::units(2), 0);
        paintRow(*painter, option);
        painter->save();
        painter->setRenderHint(QPainter::Antialiasing);
        if (index.column() == ChartColumn)
            paintChart(*painter, option, box, index);
        else
            paintWords(*painter, option, box, index);
        painter->restore();
    }

private:
    const LoopFigure* figureOf(int row) const {
        if (row == DutyRow) return &table_.metrics_.duty;
        const auto time = static_cast<std::size_t>(row - FirstTimeRow);
        const auto& times = table_.metrics_.times;
        return row >= FirstTimeRow && time < times.size() ? &times[time] : nullptr;
    }

    void paintWords(QPainter& painter, const QStyleOptionViewItem& option, const QRect& box,
                    const QModelIndex& index) const {
        const Tokens& c = Look::colours();
        const LoopFigure* figure = figureOf(index.row());
        const bool numeric = index.column() >= FirstColumn && index.column() < UnitColumn;
        if (figure == nullptr) {  // a scale, which says what the marks mean
            if (index.row() == DutyScaleRow || !numeric)
                return paintText(painter, box, index.data().toString(), rowInk(option, c.ink2));
            return paintLoopMark(
                painter, static_cast<LoopFigure::Which>(index.column() - FirstColumn),
                {box.right() - Look::length(2), box.center().y() + 0.5}, rowInk(option, c.ink));
        }
        QColor ink = index.column() == UnitColumn ? c.ink2 : c.ink;
        if (numeric) {
            const auto& number =
                figure->numbers[static_cast<std::size_t>(index.column() - FirstColumn)];
            const bool full = index.row() == DutyRow && number && *number > 100;
            ink = !number ? c.ink2 : full ? c.warnText : table_.metrics_.live ? c.ink : c.dataText;
        }
        paintText(painter, box, index.data().toString(), rowInk(option, ink),
                  numeric ? Qt::AlignRight : Qt::AlignLeft);
    }

    void paintChart(QPainter& painter, const QStyleOptionViewItem& option, const QRect& box,
                    const QModelIndex& index) const {
        const Tokens& c = Look::colours();
        const double side = Look::length(2);
        const QRectF chart = QRectF{box}.adjusted(side, Look::length(0.5), -side, 0);
        const QColor quiet = rowInk(option, c.ink2);
        const bool live = table_.metrics_.live;
        const QColor ink = live ? rowInk(option, c.ink) : quiet;
        painter.setFont(Look::font(TextSize::Note));
        const LoopFigure* figure = figureOf(index.row());
        if (figure != nullptr && !figure->unknown.isEmpty())
            paintText(painter, box, figure->unknown, quiet);
        else if (index.row() == DutyRow)
            paintDuty(painter, chart, *figure, live, ink);
        else if (index.row() == DutyScaleRow)
            paintDutyScale(painter, chart, quiet);
        else if (figure != nullptr)
            paintTimes(painter, chart, *figure, table_.axis_, ink);
        else
            paintTimeScale(painter, chart, table_.axis_, quiet);
    }

    const LoopTable& table_;
};

LoopTable::LoopTable(QWidget* parent) : QTreeWidget{parent} {
    setUpRows(*this);
    setRootIsDecorated(false);
    setItemDelegate(new Delegate{*this});
    setAccessibleName(tr("What the loop measures of itself"));
    setHeaderLabels({tr("Measured"), tr("last"), tr("p50"), tr("p99"), tr("p99.9"), tr("max"),
                     tr("Unit"), tr("Bar and marks")});
    for (int column = FirstColumn; column < UnitColumn; ++column)
        headerItem()->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
    keepWidths(*this, {36, 17, 17, 17, 17, 17, 10});
    header()->setStretchLastSection(false);
    connect(header(), &QHeaderView::sectionResized, this, [this](int column) {
        if (column != ChartColumn) fitChart();
    });
    setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
}

void LoopTable::fill(QTreeWidgetItem& row, const LoopFigure& figure) {
    setCell(row, TitleColumn, figure.title);
    for (int i = 0; i < LoopFigure::Count; ++i)
        setCell(row, FirstColumn + i, figure.texts[static_cast<std::size_t>(i)]);
    setCell(row, UnitColumn, figure.unit);
    setCell(row, ChartColumn, figure.unknown);
    const bool known = figure.unknown.isEmpty();
    row.setData(ChartColumn, Qt::AccessibleTextRole,
                known ? spoken(*this, figure) : figure.unknown);
}

void LoopTable::show(const LoopMetrics& metrics, bool anew) {
    const LogAxis needed = LogAxis::around(metrics.times);
    axis_ = anew ? needed : axis_.joined(needed);
    metrics_ = metrics;
    const int count = FirstTimeRow + static_cast<int>(metrics.times.size()) + 1;
    if (topLevelItemCount() != count) {
        clear();
        while (topLevelItemCount() < count) new QTreeWidgetItem{this};
        setCell(*topLevelItem(DutyScaleRow), TitleColumn, tr("Scale"));
        setCell(*topLevelItem(count - 1), TitleColumn, tr("Scale and marks"));
        updateGeometry();
    }
    fill(*topLevelItem(DutyRow), metrics.duty);
    for (int i = FirstTimeRow; i < count - 1; ++i) {
        fill(*topLevelItem(i), metrics.times[static_cast<std::size_t>(i - FirstTimeRow)]);
    }
    for (int column = FirstColumn; column <= UnitColumn; ++column) growToFit(*this, column);
    viewport()->update();
}

QSize LoopTable::sizeHint() const {
    const bool scrolled = horizontalScrollBar()->maximum() > 0;
    return {Look::units(120), header()->sizeHint().height() +
                                  std::max(topLevelItemCount(), 1) * gui::rowHeight() +
                                  (scrolled ? horizontalScrollBar()->sizeHint().height() : 0)};
}

void LoopTable::resizeEvent(QResizeEvent* event) {
    QTreeWidget::resizeEvent(event);
    fitChart();
    updateGeometry();
}

// The chart takes what the numbers leave.
void LoopTable::fitChart() {
    const int before = header()->sectionPosition(ChartColumn);
    header()->resizeSection(ChartColumn,
                            std::max(Look::units(leastChart), viewport()->width() - before));
}

}  // namespace cortex::gui
