// SPDX-License-Identifier: Apache-2.0
// Tabs of which there may be several of one kind: plots, and what was before faults. Two panes.
#include "plots/plot_view.hpp"
#include "views/fault_history_view.hpp"
#include "window/workspace.hpp"

#include <QMenu>
#include <algorithm>
#include <utility>

namespace cortex::gui {

// The tab of this fault, if there is one already.
void Workspace::openBefore(const comms::AgentEvent& fault) {
    const QJsonObject saved = FaultHistory{fault}.saved();
    for (std::size_t i = 0; i < panes_.size(); ++i) {
        for (int tab = 0; tab < panes_[i]->count(); ++tab) {
            const Page& page = panes_[i]->page(tab);
            if (page.kind != QLatin1String{beforeKind} || page.saved() != saved) continue;
            active_ = i;
            return panes_[i]->choose(tab);
        }
    }
    auto [page, title] = makeBeforePage(parts_, saved);
    QWidget* view = page.widget;
    pane().choose(pane().add(std::move(page), title, place(pane())));
    view->setFocus();
}

// "Plot", "Plot 2", …
QString Workspace::freeTitle(const QString& title) const {
    const auto isTaken = [this](const QString& text) {
        return std::ranges::any_of(panes_, [&](const Pane* each) {
            for (int tab = 0; tab < each->count(); ++tab) {
                if (each->title(tab) == text) return true;
            }
            return false;
        });
    };
    QString text = title;
    for (int number = 2; isTaken(text); ++number) text = tr("%1 %2").arg(title).arg(number);
    return text;
}

std::vector<OpenPlot> Workspace::plots() const {
    std::vector<OpenPlot> all;
    for (const Pane* each : panes_) {
        for (int tab = 0; tab < each->count(); ++tab) {
            if (auto* view = qobject_cast<PlotView*>(each->page(tab).widget)) {
                all.push_back({view, each->title(tab)});
            }
        }
    }
    return all;
}

void Workspace::plotIn(PlotView& plot, const std::vector<RecordedItem>& items, int panel) {
    for (std::size_t i = 0; i < panes_.size(); ++i) {
        for (int tab = 0; tab < panes_[i]->count(); ++tab) {
            if (panes_[i]->page(tab).widget != &plot) continue;
            active_ = i;
            panes_[i]->choose(tab);
        }
    }
    lastPlot_ = &plot;
    plot.add(items, panel, panel >= 0 && panel >= plot.lines().panels());
    plot.setFocus();
}

void Workspace::openPlot(const std::vector<RecordedItem>& items) {
    const auto open = plots();
    if (open.empty()) return newPlot(items);
    const auto last = std::ranges::find(open, lastPlot_.data(), &OpenPlot::view);
    plotIn(*(last != open.end() ? last->view : open.front().view), items, -1);
}

void Workspace::newPlot(const std::vector<RecordedItem>& items) {
    auto [page, title] = makePage(parts_, QStringLiteral("plot"), {});
    auto& plot = *qobject_cast<PlotView*>(page.widget);
    pane().choose(pane().add(std::move(page), freeTitle(title), place(pane())));
    plotIn(plot, items, -1);
}

void Workspace::addPlaces(QMenu& menu, const std::vector<RecordedItem>& items) {
    if (items.empty()) {
        menu.addAction(tr("Nothing here is a value"))->setEnabled(false);
        return;
    }
    fillPlotMenu(menu, plots(), [this, items](PlotView* plot, int panel) {
        plot == nullptr ? newPlot(items) : plotIn(*plot, items, panel);
    });
}

void Workspace::split() {
    const int tab = pane().chosen();
    if (tab < 0) return;
    if (pane().page(tab).stays) {
        openTab(pathOf(pane().page(tab)), true);
    } else {
        move(active_, tab);
    }
}

void Workspace::move(std::size_t from, int tab) {
    const QString title = panes_[from]->title(tab);
    Page page = panes_[from]->take(tab);
    active_ = 1 - from;
    pane().choose(pane().add(std::move(page), title, place(pane())));
}

}  // namespace cortex::gui
