// SPDX-License-Identifier: Apache-2.0
#include "views/tree_rows.hpp"

#include "model/plotted_items.hpp"
#include "model/system_model.hpp"
#include "style/glyphs.hpp"
#include "widgets/item_drag.hpp"
#include "widgets/rows.hpp"

#include <QDrag>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QScopedValueRollback>
#include <QScrollBar>
#include <QStyledItemDelegate>
#include <algorithm>
#include <utility>

namespace cortex::gui {

namespace {

class TreeDelegate : public QStyledItemDelegate {
public:
    TreeDelegate(const SystemModel& model, QObject* parent)
        : QStyledItemDelegate{parent}, model_{model} {}

    QSize sizeHint(const QStyleOptionViewItem& /*option*/,
                   const QModelIndex& /*index*/) const override {
        return {Look::units(20), rowHeight()};
    }

    // Shape and name, and at the right end the type or the state with its mark.
    void paint(QPainter* painter, const QStyleOptionViewItem& option,
               const QModelIndex& index) const override {
        const Tokens& c = Look::colours();
        const Marks& marks = model_.marks(index);
        const bool selected = option.state.testFlag(QStyle::State_Selected);
        const Tokens& drawn = selected && Look::theme() == Theme::HighContrast ? onSelection() : c;
        const int size = markSize(), gap = Look::units(2);
        QRect box = option.rect.adjusted(Look::units(1), 0, -Look::units(3), 0);
        const auto mark = [&](Shape shape, int left) {
            gui::paint(*painter, markBox(left, box, size), shape, drawn);
        };
        mark(marks.shape, box.left());
        box.setLeft(box.left() + size + gap);

        const auto shown = marks.own ? marks.own : marks.worst;
        if (shown) {
            mark(*shown, box.right() - size);
            box.setRight(box.right() - size - gap);
        }
        const QString name = index.data().toString();
        const int nameWidth = textWidth(name);
        paintText(*painter, box, name, rowInk(option, c.ink));
        box.setLeft(box.left() + std::min(nameWidth, box.width()) + gap);
        QString text = index.data(SystemModel::WordRole).toString();
        QColor ink = marks.shape == Shape::Fault ? c.faultText : c.ink2;
        if (marks.own) {
            const QString quality = word(*marks.own);
            const int width = textWidth(quality);
            paintText(*painter, box, quality, rowInk(option, textColour(*marks.own, c)),
                      Qt::AlignRight);
            box.setRight(box.right() - width - gap);
        }
        paintText(*painter, box, text, rowInk(option, ink), Qt::AlignRight);
    }

private:
    static const Tokens& onSelection() {
        static const Tokens all = [] {
            Tokens t = tokens(Theme::HighContrast);
            for (QColor Tokens::* each :
                 {&Tokens::ink, &Tokens::ink2, &Tokens::data, &Tokens::warnEdge, &Tokens::fault}) {
                t.*each = t.onAccent;
            }
            t.onFault = t.accent;
            return t;
        }();
        return all;
    }

    const SystemModel& model_;
};

}  // namespace

TreeRows::TreeRows(const SystemModel& model) : items_{model} {
    setItemDelegate(new TreeDelegate{model, this});
    setDragEnabled(true);
    setDragDropMode(DragOnly);
    other_.setSingleShot(true);
    other_.setInterval(1000);
}

void TreeRows::goTo(const QModelIndex& index) {
    const QScopedValueRollback act{acts_, true};
    setCurrentIndex(index);
}

void TreeRows::openMany(const std::function<void()>& change) {
    scheduleDelayedItemsLayout();
    change();
}

void TreeRows::keepPlace(const std::function<void()>& change) {
    const QPersistentModelIndex row = underPointer();
    const int place = viewport()->y() + visualRect(row).top();
    change();
    if (row.isValid() && viewport()->y() + visualRect(row).top() != place) {
        const int beyond = verticalScrollBar()->value() + visualRect(row).top() - place;
        scrollBeyond(beyond, std::max(beyond, 0));
    }
    if (underPointer() != row) other_.start();
}

void TreeRows::forgetPlace() {
    if (beyond_ != 0) scrollBeyond(0, verticalScrollBar()->value());
}

bool TreeRows::viewportEvent(QEvent* event) {
    if (event->type() == QEvent::Leave) forgetPlace();
    return isOfOther(*event) || QTreeView::viewportEvent(event);
}

void TreeRows::updateGeometries() {
    if (fits_) return;  // the margin resizes the viewport
    const QScopedValueRollback fit{fits_, true};
    QScrollBar& bar = *verticalScrollBar();
    const int value = bar.value(), margin = std::max(-beyond_, 0);
    QTreeView::updateGeometries();
    if (beyond_ == 0) return;
    setViewportMargins(0, margin, 0, 0);
    bar.setMaximum(std::max(bar.maximum() + margin, beyond_));
    bar.setValue(value);
}

void TreeRows::keyPressEvent(QKeyEvent* event) {
    const QScopedValueRollback act{acts_, true};
    QTreeView::keyPressEvent(event);
}

void TreeRows::mousePressEvent(QMouseEvent* event) {
    if (event->button() == Qt::RightButton) return;  // its menu chooses nothing first
    const QScopedValueRollback act{acts_, true};
    const QScopedValueRollback press{presses_, true};
    QTreeView::mousePressEvent(event);
}

void TreeRows::startDrag(Qt::DropActions /*actions*/) {
    const auto dragged = plottedItems(items_.frame(), items_.path(currentIndex()));
    if (dragged.empty()) return;
    auto* drag = new QDrag{this};
    drag->setMimeData(mimeOf(dragged));
    drag->exec(Qt::CopyAction);
}

void TreeRows::drawRow(QPainter* painter, const QStyleOptionViewItem& option,
                       const QModelIndex& index) const {
    QStyleOptionViewItem whole = option;
    whole.rect.setLeft(0);
    if (selectionModel()->isSelected(index)) whole.state |= QStyle::State_Selected;
    paintRow(*painter, whole);
    if (whole.state.testFlag(QStyle::State_Selected)) {
        painter->fillRect(QRect{0, option.rect.top(), 3, option.rect.height()},
                          Look::colours().accent);
    }
    QTreeView::drawRow(painter, option, index);
}

QModelIndex TreeRows::underPointer() const {
    if (!viewport()->underMouse()) return {};
    return indexAt(viewport()->mapFromGlobal(QCursor::pos()));
}

void TreeRows::scrollBeyond(int beyond, int value) {
    beyond_ = beyond;
    setVerticalScrollBarPolicy(beyond == 0 ? Qt::ScrollBarAsNeeded : Qt::ScrollBarAlwaysOn);
    updateGeometries();
    verticalScrollBar()->setValue(value);
}

// Of a press where another row has just been, until its button is up.
bool TreeRows::isOfOther(const QEvent& event) {
    switch (event.type()) {
        case QEvent::MouseButtonPress:
        case QEvent::MouseButtonDblClick:
            return ignores_ = other_.isActive();
        case QEvent::MouseMove:
            return ignores_ && static_cast<const QMouseEvent&>(event).buttons() != Qt::NoButton;
        case QEvent::MouseButtonRelease:
            return std::exchange(ignores_, false);
        case QEvent::ContextMenu:
            return other_.isActive();
        default:
            return false;
    }
}

}  // namespace cortex::gui
