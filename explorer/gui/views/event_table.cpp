// SPDX-License-Identifier: Apache-2.0
#include "views/event_table.hpp"

#include "widgets/rows.hpp"
#include "widgets/text_label.hpp"

#include <QHeaderView>
#include <QKeyEvent>
#include <QScrollBar>
#include <QStyledItemDelegate>
#include <algorithm>
#include <array>
#include <utility>

namespace cortex::gui {

namespace {

// In units; the text takes the rest. Time, severity and times are never cut: they are at least as
// wide as their texts.
constexpr std::array<double, EventModel::ColumnCount> eventWidths{25, 23, 26, 38, 19, 0, 15};
constexpr double leastTextWidth = 60, leastPathWidth = 24;
constexpr double margins = 3, markWidth = 4.5;

// In units, with a column's margins and that of its title.
double widthOf(const QAbstractItemModel& model, int column, const QStringList& texts,
               bool strong = false) {
    const QString title = model.headerData(column, Qt::Horizontal).toString();
    int widest = textWidth(title, false) + Look::units(1);
    for (const QString& each : texts) widest = std::max(widest, textWidth(each, strong));
    return widest / Look::length(1) + margins;
}

QStringList severities() {
    QStringList words{EventModel::tr("missing")};
    for (const auto each : {Severity::Info, Severity::Warning, Severity::Error})
        words << QLatin1String{name(each)};
    return words;
}

class EventDelegate : public QStyledItemDelegate {
public:
    EventDelegate(const EventFilter& events, QObject* parent)
        : QStyledItemDelegate{parent}, events_{events} {}

    void paint(QPainter* painter, const QStyleOptionViewItem& asked,
               const QModelIndex& index) const override {
        QStyleOptionViewItem option = asked;
        option.state &= ~QStyle::State_MouseOver;  // it is of one cell, not of the row
        const Tokens& c = Look::colours();
        const EventRow& row = events_.at(index.row());
        paintRow(*painter, option, row.isGap() ? c.dataBg : QColor{});
        QRect box = option.rect.adjusted(Look::units(2), 0, -Look::units(1), 0);
        const Shape shape = row.isGap() ? Shape::Bad : shapeOf(row.event.severity);
        if (index.column() == EventModel::SeverityColumn) {
            const int size = Look::units(3);
            gui::paint(*painter, markBox(box.left(), box, size), shape, c);
            box.setLeft(box.left() + Look::units(markWidth));
        }
        const bool times = index.column() == EventModel::Times;
        paintText(*painter, box, opener(index, row) + index.data().toString(),
                  rowInk(option, inkOf(index.column(), row, shape)),
                  times ? Qt::AlignRight : Qt::AlignLeft, times || row.isGap(),
                  index.column() == EventModel::Path ? Qt::ElideMiddle : Qt::ElideRight);
    }

private:
    // Before the number of a row that opens to its events.
    QString opener(const QModelIndex& index, const EventRow& row) const {
        const bool opens =
            index.column() == EventModel::Times && row.times > 1 && !events_.isMember(index.row());
        if (!opens) return {};
        return events_.isOpen(events_.serial(index.row())) ? QStringLiteral("▾ ")
                                                           : QStringLiteral("▸ ");
    }

    static QColor inkOf(int column, const EventRow& row, Shape shape) {
        const Tokens& c = Look::colours();
        if (row.isGap()) return c.dataText;
        switch (column) {
            case EventModel::SeverityColumn:
                return shape == Shape::Info ? c.ink2 : textColour(shape, c);
            case EventModel::Path:
                return c.accent;
            case EventModel::Text:
            case EventModel::Times:
                return c.ink;
            default:
                return c.ink2;
        }
    }

    const EventFilter& events_;
};

}  // namespace

EventTable::EventTable(EventFilter& events, QWidget* parent) : QTableView{parent}, events_{events} {
    setModel(&events);
    setItemDelegate(new EventDelegate{events, this});
    setFrameShape(QFrame::NoFrame);
    setShowGrid(false);
    setWordWrap(false);
    setTabKeyNavigation(false);
    setSelectionBehavior(SelectRows);
    setSelectionMode(SingleSelection);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setAccessibleName(tr("Events"));
    viewport()->setBackgroundRole(QPalette::Window);
    verticalHeader()->hide();
    verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
    verticalHeader()->setMinimumSectionSize(1);
    verticalHeader()->setDefaultSectionSize(gui::rowHeight());
    horizontalHeader()->setHighlightSections(false);
    horizontalHeader()->setSectionResizeMode(QHeaderView::Fixed);
    connect(&events, &QAbstractItemModel::rowsInserted, this,
            [this](const QModelIndex&, int first, int last) { inserted(first, last); });
    connect(&events, &QAbstractItemModel::rowsRemoved, this,
            [this](const QModelIndex&, int first, int last) {
                if (first == 0) removed(last + 1);
            });
    connect(&events, &QAbstractItemModel::modelAboutToBeReset, this, &EventTable::noteRows);
    connect(&events, &QAbstractItemModel::modelReset, this, &EventTable::keepRows);
    connect(verticalScrollBar(), &QScrollBar::actionTriggered, this, [this] {
        const QScrollBar& bar = *verticalScrollBar();
        follows_ = bar.sliderPosition() == bar.maximum();
        if (follows_) forgetNew();
        Q_EMIT moved();
    });
    connect(this, &QTableView::activated, this, [this](const QModelIndex& index) {
        const EventRow& row = events_.at(index.row());
        if (row.isFault()) return Q_EMIT beforeWanted(row.event);
        if (!row.event.path.empty()) Q_EMIT opened(row.event.path);
    });
}

std::optional<std::uint64_t> EventTable::selected() const {
    if (!currentIndex().isValid()) return std::nullopt;
    return events_.serial(currentIndex().row());
}

const comms::AgentEvent* EventTable::selectedFault() const {
    if (!currentIndex().isValid()) return nullptr;
    const EventRow& row = events_.at(currentIndex().row());
    return row.isFault() ? &row.event : nullptr;
}

bool EventTable::isAtEnd() const {
    return verticalScrollBar()->value() == verticalScrollBar()->maximum();
}

// Also where a button lies over it.
bool EventTable::isUnderPointer() const {
    return isVisible() && window()->underMouse() && rect().contains(mapFromGlobal(QCursor::pos()));
}

void EventTable::leaveEvent(QEvent* event) {
    QTableView::leaveEvent(event);
    if (follows_ && !isUnderPointer()) follow();
}

void EventTable::follow() {
    follows_ = true;
    forgetNew();
    scrollToBottom();
    Q_EMIT moved();
}

void EventTable::choose(int row) {
    setCurrentIndex(events_.index(row, 0));
    scrollTo(currentIndex(), PositionAtCenter);
    setFocus(Qt::OtherFocusReason);
    look();
    follows_ = false;
}

void EventTable::look() {
    follows_ = isAtEnd();
    if (follows_) forgetNew();
    Q_EMIT moved();
}

void EventTable::forgetNew() {
    newBelow_ = 0;
    newFrom_.reset();
}

// Of those that are shown.
void EventTable::countNew() {
    newBelow_ = 0;
    for (int row = events_.rowCount() - 1; newFrom_ && row >= 0; --row) {
        if (events_.serial(row) < *newFrom_) break;
        if (!events_.isMember(row)) newBelow_ += events_.at(row).times;
    }
}

void EventTable::inserted(int first, int last) {
    if (events_.isMember(first)) return;
    if (follows_ && !isUnderPointer()) {
        newBelow_ == 0 ? scrollToBottom() : follow();
        return;
    }
    if (!newFrom_) newFrom_ = events_.serial(first);
    for (int row = first; row <= last; ++row) newBelow_ += events_.at(row).times;
    Q_EMIT moved();
}

// What is looked at stays where it is.
void EventTable::removed(int count) {
    if (follows_ && !isUnderPointer())
        scrollToBottom();
    else
        verticalScrollBar()->setValue(verticalScrollBar()->value() - count);
}

void EventTable::rowsAboutToBeRemoved(const QModelIndex& parent, int first, int last) {
    const int row = currentIndex().row();
    if (currentIndex().isValid() && row >= first && row <= last) {
        keeps_ = true;
        setCurrentIndex({});
        keeps_ = false;
        Q_EMIT selectionDropped();
    }
    QTableView::rowsAboutToBeRemoved(parent, first, last);
}

// The first row in sight, or that under the pointer.
void EventTable::noteRows() {
    before_ = selected();
    const QPoint pointer = viewport()->mapFromGlobal(QCursor::pos());
    QModelIndex row = isUnderPointer() ? indexAt(pointer) : QModelIndex{};
    if (!row.isValid()) row = indexAt({0, 0});
    stands_.reset();
    if (!row.isValid()) return;
    stands_ = events_.serial(row.row());
    standsAt_ = row.row() - verticalScrollBar()->value();
}

void EventTable::keepRows() {
    const EventModel& all = events_.events();
    const auto rowNow = [&](std::optional<std::uint64_t> serial) {
        if (serial) serial = all.renumbered(*serial);
        return serial ? events_.rowOf(*serial) : std::nullopt;
    };
    const auto row = rowNow(before_), stands = rowNow(stands_);
    keeps_ = true;
    setCurrentIndex(row ? events_.index(*row, 0) : QModelIndex{});
    keeps_ = false;
    if (before_ && !row) Q_EMIT selectionDropped();
    before_.reset();
    if (newFrom_) newFrom_ = all.renumbered(*newFrom_);
    countNew();
    // Another filter shows the newest again; what agents kept moves no row that is looked at.
    if (follows_ && !(all.renumbers() && isUnderPointer())) return follow();
    if (all.renumbers() && stands) {
        updateGeometries();
        verticalScrollBar()->setValue(*stands - standsAt_);
    }
    Q_EMIT moved();
}

void EventTable::currentChanged(const QModelIndex& current, const QModelIndex& previous) {
    QTableView::currentChanged(current, previous);
    if (!keeps_ && current.isValid()) Q_EMIT selectionSet();
}

void EventTable::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_F || event->key() == Qt::Key_End) {
        follow();
        return;
    }
    const auto row = selected();
    if (event->key() == Qt::Key_Home && events_.rowCount() > 0) {
        setCurrentIndex(events_.index(0, 0));
        look();
        return;
    }
    const bool steps = event->key() == Qt::Key_Up || event->key() == Qt::Key_Down;
    if (!row && steps && events_.rowCount() > 0) {  // from what is in sight
        const QModelIndex last = indexAt(viewport()->rect().bottomLeft());
        setCurrentIndex(last.isValid() ? last : events_.index(events_.rowCount() - 1, 0));
        look();
        return;
    }
    if (row && event->key() == Qt::Key_Right) {
        follows_ = false;  // what was opened stays in sight
        events_.open(*row);
        Q_EMIT moved();
        return;
    }
    if (row && event->key() == Qt::Key_Left) {
        if (events_.isOpen(*row)) setCurrentIndex(events_.index(*events_.rowOf(*row), 0));
        events_.close();
        return;
    }
    QTableView::keyPressEvent(event);
    look();
}

// Without a row that is chosen: the first step begins at what is in sight.
void EventTable::focusInEvent(QFocusEvent* event) {
    const bool chosen = currentIndex().isValid();
    keeps_ = true;
    QTableView::focusInEvent(event);
    if (!chosen) setCurrentIndex({});
    keeps_ = false;
}

void EventTable::changeEvent(QEvent* event) {
    QTableView::changeEvent(event);
    if (event->type() == QEvent::StyleChange) {
        verticalHeader()->setDefaultSectionSize(gui::rowHeight());
        fitColumns();
    }
}

void EventTable::resizeEvent(QResizeEvent* event) {
    QTableView::resizeEvent(event);
    fitColumns();
    if (follows()) scrollToBottom();
}

// When it is narrow the agent goes first, then the kind, then the path is cut.
void EventTable::fitColumns() {
    auto widths = eventWidths;
    const auto widen = [&](int column, double width) {
        auto& now = widths[static_cast<std::size_t>(column)];
        now = std::max(now, width);
    };
    widen(EventModel::Time,
          widthOf(events_, EventModel::Time, {EventModel::timeText(0, true)}, true));
    widen(EventModel::SeverityColumn,
          widthOf(events_, EventModel::SeverityColumn, severities(), true) + markWidth);
    widen(EventModel::Times,
          widthOf(events_, EventModel::Times, {QStringLiteral("▸ ×99,999")}, true));
    double left = viewport()->width() / Look::length(1) - leastTextWidth;
    for (const double each : widths) left -= each;
    for (const int column : {EventModel::Agent, EventModel::Kind}) {
        setColumnHidden(column, left < 0);
        if (left < 0) left += widths[static_cast<std::size_t>(column)];
    }
    if (left < 0) {
        left += widths[EventModel::Path] - leastPathWidth;
        widths[EventModel::Path] = leastPathWidth;
    }
    widths[EventModel::Text] = std::max(left + leastTextWidth, leastPathWidth);
    for (int i = 0; i < EventModel::ColumnCount; ++i) {
        horizontalHeader()->resizeSection(i, Look::units(widths[static_cast<std::size_t>(i)]));
    }
}

}  // namespace cortex::gui
