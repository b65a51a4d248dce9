// SPDX-License-Identifier: Apache-2.0
// Where values and lines that are dragged to a plot go, and what is said of that before.
#include "plots/plot_panel.hpp"
#include "plots/plot_view.hpp"
#include "plots/tag_strip.hpp"
#include "style/look.hpp"
#include "widgets/drop_zone.hpp"
#include "widgets/item_drag.hpp"

#include <QDragEnterEvent>
#include <QDragLeaveEvent>
#include <QDragMoveEvent>
#include <QDropEvent>
#include <utility>

namespace cortex::gui {

namespace {

int edge() { return Look::units(5); }  // of a panel, above and below: between it and the next

}  // namespace

// Near its edges a panel gives way to a new one.
PlotPlace PlotView::placeAt(const QPoint& at) const {
    for (std::size_t i = 0; i < panels_.size(); ++i) {
        const int y = panels_[i]->mapFrom(const_cast<PlotView*>(this), at).y();
        const int panel = static_cast<int>(i);
        const QRect canvas = panels_[i]->canvasBox();
        if (y < canvas.top() + edge()) return {panel, true};
        if (y <= canvas.bottom() - edge()) return {panel, false};
    }
    return {panels_.empty() ? -1 : static_cast<int>(panels_.size()), !panels_.empty()};
}

QRect PlotView::boxOf(PlotPlace place) const {
    if (panels_.empty()) return rect().adjusted(2, 2, -2, -2);
    const auto panel = [&](int number) {
        const PlotPanel& shown = *panels_[static_cast<std::size_t>(number)];
        return shown.canvasBox().translated(shown.mapTo(this, QPoint{}));
    };
    if (!place.anew) return panel(place.panel);
    const bool last = place.panel >= static_cast<int>(panels_.size());
    QRect box = panel(last ? place.panel - 1 : place.panel);
    const int y = last ? box.bottom() : box.top();
    box.setTop(y - edge());
    box.setBottom(y + edge());
    return box;
}

bool PlotView::put(PlotLines& lines, const std::vector<RecordedItem>& items, PlotPlace place) {
    if (place.anew && !lines.open(place.panel)) return false;
    bool any = false;
    for (const RecordedItem& each : items) any = lines.add(each, place.panel) || any;
    return any;
}

// The drop is tried with a copy of the lines: only they know where a unit has room.
void PlotView::outline(const std::vector<RecordedItem>& items, const QPoint& at) {
    const PlotPlace place = placeAt(at);
    PlotLines trial = lines_;
    const bool any = put(trial, items, place);
    if (frame_) trial.learn(*frame_);
    const QRect box = boxOf(place);
    if (!any) {
        const bool full = place.anew && lines_.panels() >= PlotLines::mostPanels;
        zone_->show(box, full ? tr("no room for another panel") : tr("it is there already"), false);
        return;
    }
    const PlotLine& line = trial.all().back();
    if (line.lane) {
        zone_->show(box, tr("add as words below the panels"));
    } else if (place.anew || panels_.empty()) {
        zone_->show(box, tr("new panel"));
    } else if (line.known && line.panel != place.panel) {
        zone_->show(box, tr("new panel: two other units are here"));
    } else {
        const QString where = lines_.titleOf(place.panel);
        zone_->show(box, line.right ? tr("add to %1, at the right").arg(where)
                                    : tr("add to %1").arg(where));
    }
}

void PlotView::dragTag(int tag, const QPoint& global) {
    const PlotPlace place = placeAt(mapFromGlobal(global));
    PlotLines trial = lines_;
    const bool moves = trial.move(tag, place.panel, place.anew);
    const QString words = !moves       ? tr("two other units are here")
                          : place.anew ? tr("%1 to a new panel").arg(tag)
                                       : tr("%1 to %2").arg(tag).arg(lines_.titleOf(place.panel));
    zone_->show(boxOf(place), words, moves);
}

void PlotView::dropTag(int tag, const QPoint& global) {
    zone_->hide();
    const PlotPlace place = placeAt(mapFromGlobal(global));
    moveLine(tag, place.panel, place.anew);
}

void PlotView::dragEnterEvent(QDragEnterEvent* event) {
    const auto items = itemsIn(event->mimeData());
    if (items.empty()) return;
    outline(items, event->pos());
    event->acceptProposedAction();
}

void PlotView::dragMoveEvent(QDragMoveEvent* event) {
    outline(itemsIn(event->mimeData()), event->pos());
    event->acceptProposedAction();
}

void PlotView::dragLeaveEvent(QDragLeaveEvent* /*event*/) { zone_->hide(); }

void PlotView::dropEvent(QDropEvent* event) {
    zone_->hide();
    const PlotPlace place = placeAt(event->pos());
    add(itemsIn(event->mimeData()), place.panel, place.anew);
    event->acceptProposedAction();
}

}  // namespace cortex::gui
