// SPDX-License-Identifier: Apache-2.0
#include "views/overview_table.hpp"

#include "model/plain_text.hpp"
#include "widgets/rows.hpp"

#include <QEvent>
#include <QFocusEvent>
#include <QHeaderView>
#include <QKeyEvent>
#include <QStyledItemDelegate>
#include <algorithm>
#include <utility>

namespace cortex::gui {

namespace {

enum OverviewRole { KeyRole = Qt::UserRole, OpensRole, ItemRole, ShapeRole, GoneRole };

constexpr double mostOfShare = 0.34, leastOfShare = 20;  // of the width; units
constexpr double cellMargins = 3, markRoom = 5;          // units

}  // namespace

// A mark before the first cell. Paths that are too long keep their ends, where they differ.
class OverviewTable::Delegate : public QStyledItemDelegate {
public:
    using QStyledItemDelegate::QStyledItemDelegate;

    void paint(QPainter* painter, const QStyleOptionViewItem& option,
               const QModelIndex& index) const override {
        const Tokens& c = Look::colours();
        paintRow(*painter, option);
        const QModelIndex first = index.siblingAtColumn(0);
        QRect box = option.rect.adjusted(Look::units(2), 0, -Look::units(1), 0);
        const QVariant shape = first.data(ShapeRole);
        if (index.column() == 0 && shape.isValid()) {
            const int size = Look::units(3);
            gui::paint(*painter, markBox(box.left(), box, size),
                       static_cast<gui::Shape>(shape.toInt()), c);
            box.setLeft(box.left() + Look::units(markRoom));
        }
        const bool gone = first.data(GoneRole).toBool();
        paintCell(*painter, box, index.data().toString(), rowInk(option, gone ? c.ink2 : c.ink));
    }

private:
    static void paintCell(QPainter& painter, const QRect& box, const QString& text,
                          const QColor& ink) {
        const auto mode =
            text.startsWith('/') && !text.contains(' ') ? Qt::ElideLeft : Qt::ElideRight;
        const QFontMetrics metrics{Look::font(TextSize::Text)};
        paintText(painter, box, metrics.elidedText(text, mode, box.width()), ink);
    }
};

OverviewTable::OverviewTable(const QString& name, std::vector<Column> columns, QWidget* parent)
    : QTreeWidget{parent}, columns_{std::move(columns)} {
    setUpRows(*this);
    setRootIsDecorated(false);
    setItemDelegate(new Delegate{this});
    setAccessibleName(name);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    header()->setStretchLastSection(false);
    header()->setSectionResizeMode(QHeaderView::Fixed);
    QStringList titles;
    for (const Column& each : columns_) titles << each.title;
    setHeaderLabels(titles);
    const auto open = [this](const QTreeWidgetItem* item) {
        const auto told = [&](int role) { return item->data(0, role).toString().toStdString(); };
        Q_EMIT opened({told(KeyRole), told(OpensRole), {}, {}, told(ItemRole)});
    };
    connect(this, &QTreeWidget::itemClicked, this, open);
    connect(this, &QTreeWidget::itemActivated, this, open);
}

bool OverviewTable::isUsed() const { return gui::isUsed(*this) && (underMouse() || !begins_); }

void OverviewTable::setTitle(int column, const QString& title) {
    if (headerItem()->text(column) == title) return;
    headerItem()->setText(column, title);
    fitColumns();
}

void OverviewTable::fill(QTreeWidgetItem& item, const OverviewRow& row) {
    const QString opens = QString::fromStdString(row.opens);
    const QString inside = QString::fromStdString(row.item);
    if (item.data(0, OpensRole) != opens) item.setData(0, OpensRole, opens);
    if (item.data(0, ItemRole) != inside) item.setData(0, ItemRole, inside);
    const QVariant shape = row.shape ? QVariant{static_cast<int>(*row.shape)} : QVariant{};
    if (item.data(0, ShapeRole) != shape) item.setData(0, ShapeRole, shape);
    if (item.data(0, GoneRole).toBool()) item.setData(0, GoneRole, false);
    for (int column = 0; column < row.cells.size(); ++column)
        setCell(item, column, row.cells[column]);
    if (!row.whole.isEmpty()) item.setToolTip(columnCount() - 1, tipText(row.whole));
    const QString read =
        row.shape ? word(*row.shape) + QStringLiteral(", ") + row.cells.front() : QString{};
    if (!read.isEmpty() && item.data(0, Qt::AccessibleTextRole) != read)
        item.setData(0, Qt::AccessibleTextRole, read);
}

// What it was stays, what was said of it does not.
void OverviewTable::leave(QTreeWidgetItem& item, const QString& text) {
    if (!item.data(0, GoneRole).toBool()) {
        item.setData(0, GoneRole, true);
        item.setData(0, ShapeRole, {});
        item.setData(0, Qt::AccessibleTextRole, {});
    }
    for (int column = 1; column < columnCount(); ++column)
        setCell(item, column, column == restColumn() ? text : QString{});
}

void OverviewTable::show(const OverviewRows& rows, const Gone& gone) {
    const bool held = isUsed();
    std::vector<std::string> keys;
    keys.reserve(rows.size());
    for (const OverviewRow& each : rows) keys.push_back(each.key);
    const std::vector<int> places = order_.update(keys, held);
    const auto count = static_cast<int>(places.size());
    const QString chosen =
        currentItem() != nullptr ? currentItem()->data(0, KeyRole).toString() : QString{};
    while (topLevelItemCount() > count) delete takeTopLevelItem(topLevelItemCount() - 1);
    while (topLevelItemCount() < count) new QTreeWidgetItem{this};
    for (int row = 0; row < count; ++row) {
        QTreeWidgetItem& item = *topLevelItem(row);
        const int place = places[static_cast<std::size_t>(row)];
        const QString key = QString::fromStdString(order_.key(row));
        if (item.data(0, KeyRole) != key) item.setData(0, KeyRole, key);
        if (place == HeldOrder::gone) {
            leave(item, gone ? gone(order_.key(row)) : QString{});
            continue;
        }
        const OverviewRow& shown = rows[static_cast<std::size_t>(place)];
        fill(item, shown);
    }
    if (held) return;
    chooseAgain(chosen);
    fitColumns();
    if (keepsNewest_) scrollToBottom();
}

// The row that was chosen, wherever it stands now.
void OverviewTable::chooseAgain(const QString& key) {
    if (currentItem() == nullptr || currentItem()->data(0, KeyRole) == key) return;
    QTreeWidgetItem* found = nullptr;
    for (int row = 0; row < topLevelItemCount(); ++row) {
        if (topLevelItem(row)->data(0, KeyRole) == key) found = topLevelItem(row);
    }
    setCurrentItem(found);
}

int OverviewTable::restColumn() const {
    const auto found = std::ranges::find(columns_, Fit::Rest, &Column::fit);
    return static_cast<int>(found - columns_.begin());
}

// As its widest text and its title.
int OverviewTable::neededWidth(int column) const {
    int needed = textWidth(headerItem()->text(column), false) + Look::units(1);
    needed = std::max(needed, textWidth(columns_[static_cast<std::size_t>(column)].widest));
    for (int row = 0; row < topLevelItemCount(); ++row)
        needed = std::max(needed, textWidth(topLevelItem(row)->text(column)));
    return needed + Look::units(cellMargins + (column == 0 ? markRoom : 0));
}

// What the texts of the last column do not need, the others may have.
void OverviewTable::fitColumns() {
    const int width = viewport()->width();
    const int share = std::max(static_cast<int>(width * mostOfShare), Look::units(leastOfShare));
    const int count = columnCount();
    std::vector<int> needed, widths;
    int left = width;
    for (int column = 0; column < count; ++column) {
        const Fit fit = columns_[static_cast<std::size_t>(column)].fit;
        needed.push_back(neededWidth(column));
        widths.push_back(fit == Fit::Whole ? needed.back() : std::min(needed.back(), share));
        if (fit != Fit::Rest) left -= widths.back();
    }
    const auto rest = static_cast<std::size_t>(restColumn());
    for (std::size_t column = 0; column < widths.size() && left > needed[rest]; ++column) {
        if (column == rest) continue;
        const int more = std::min(needed[column] - widths[column], left - needed[rest]);
        widths[column] += more;
        left -= more;
    }
    widths[rest] = std::max(left, Look::units(leastOfShare / 2));
    for (int column = 0; column < count; ++column) {
        const int now = widths[static_cast<std::size_t>(column)];
        if (header()->sectionSize(column) != now) header()->resizeSection(column, now);
    }
}

void OverviewTable::resizeEvent(QResizeEvent* event) {
    QTreeWidget::resizeEvent(event);
    fitColumns();
    if (keepsNewest_ && !isUsed()) scrollToBottom();
}

void OverviewTable::changeEvent(QEvent* event) {
    QTreeWidget::changeEvent(event);
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange) fitColumns();
}

// Where the keyboard comes to it, it is seen which row Enter opens.
void OverviewTable::focusInEvent(QFocusEvent* event) {
    QTreeWidget::focusInEvent(event);
    begins_ = event->reason() == Qt::OtherFocusReason;
    if (event->reason() == Qt::MouseFocusReason || topLevelItemCount() == 0) return;
    if (selectedItems().isEmpty())
        setCurrentItem(topLevelItem(keepsNewest_ ? topLevelItemCount() - 1 : 0));
}

void OverviewTable::keyPressEvent(QKeyEvent* event) {
    begins_ = false;
    QTreeWidget::keyPressEvent(event);
}

}  // namespace cortex::gui
