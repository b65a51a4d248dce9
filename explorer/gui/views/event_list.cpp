// SPDX-License-Identifier: Apache-2.0
#include "views/event_list.hpp"

#include "widgets/rows.hpp"
#include "widgets/text_label.hpp"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QScrollBar>
#include <QStyledItemDelegate>
#include <QVBoxLayout>
#include <array>

namespace cortex::explorer {

namespace {

constexpr std::array<double, EventModel::Text> eventWidths{26, 24, 46, 24};  // units

class EventDelegate : public QStyledItemDelegate {
public:
    EventDelegate(const EventModel& events, QObject* parent)
        : QStyledItemDelegate{parent}, events_{events} {}

    QSize sizeHint(const QStyleOptionViewItem& /*option*/,
                   const QModelIndex& /*index*/) const override {
        return {Look::units(10), Look::units(5.5)};
    }

    void paint(QPainter* painter, const QStyleOptionViewItem& option,
               const QModelIndex& index) const override {
        const Tokens& c = Look::colours();
        paintRow(*painter, option);
        QRect box = option.rect.adjusted(Look::units(2), 0, -Look::units(1), 0);
        const Shape shape = shapeOf(events_.severity(index.row()));
        QColor ink = c.ink;
        if (index.column() == EventModel::SeverityColumn) {
            const int size = Look::units(3);
            explorer::paint(*painter, markBox(box.left(), box, size), shape, c);
            box.setLeft(box.left() + size + Look::units(1.5));
            ink = shape == Shape::Info ? c.ink2 : textColour(shape, c);
        } else if (index.column() == EventModel::Path) {
            ink = c.accent;
        } else if (index.column() != EventModel::Text) {
            ink = c.ink2;
        }
        paintText(*painter, box, index.data().toString(), rowInk(option, ink));
    }

private:
    const EventModel& events_;
};

}  // namespace

EventList::EventList(EventModel& events, QWidget* parent)
    : QWidget{parent},
      events_{events},
      rows_{new QTreeView},
      count_{new TextLabel{TextSize::Text, false, &Tokens::ink2}} {
    auto* title = new TextLabel{TextSize::Text, true};
    title->show(tr("Events"));
    auto* head = new QHBoxLayout;
    head->setContentsMargins(Look::units(3), Look::units(1.5), Look::units(3), Look::units(1.5));
    head->setSpacing(Look::units(4));
    head->addWidget(title);
    head->addWidget(count_);
    head->addStretch(1);
    rows_->setModel(&events);
    rows_->setItemDelegate(new EventDelegate{events, rows_});
    setUpRows(*rows_);
    rows_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    rows_->setRootIsDecorated(false);
    rows_->setVerticalScrollMode(QAbstractItemView::ScrollPerItem);
    setAutoFillBackground(true);
    rows_->setHeaderHidden(true);
    rows_->setAccessibleName(tr("Events"));
    auto* all = new QVBoxLayout{this};
    all->setContentsMargins(0, 0, 0, 0);
    all->setSpacing(0);
    all->addLayout(head);
    all->addWidget(rows_, 1);
    tellCount();
    connect(&events, &QAbstractItemModel::rowsInserted, this, &EventList::follow);
    connect(&events, &QAbstractItemModel::dataChanged, this, &EventList::tellCount);
    connect(rows_->verticalScrollBar(), &QScrollBar::actionTriggered, this, [this] {
        const QScrollBar& bar = *rows_->verticalScrollBar();
        follows_ = bar.sliderPosition() == bar.maximum();
    });
    connect(rows_, &QTreeView::activated, this, [this](const QModelIndex& index) {
        const QString path = index.siblingAtColumn(EventModel::Path).data().toString();
        if (!path.isEmpty()) Q_EMIT opened(path.toStdString());
    });
}

void EventList::follow() {
    tellCount();
    if (follows_) rows_->scrollToBottom();
}

void EventList::tellCount() {
    count_->show(events_.count() == 0 ? tr("none yet")
                                      : tr("%1 so far, all agents").arg(events_.count()));
}

void EventList::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    for (int i = 0; i < EventModel::Text; ++i) {  // the text takes the rest
        rows_->header()->resizeSection(i, Look::units(eventWidths[static_cast<std::size_t>(i)]));
    }
    if (follows_) rows_->scrollToBottom();
}

}  // namespace cortex::explorer
