// SPDX-License-Identifier: Apache-2.0
#include "window/plot_places.hpp"

#include "plots/plot_view.hpp"

#include <QCoreApplication>
#include <QMenu>
#include <QPointer>

namespace cortex::gui {

namespace {

QString placeText(const char* text) { return QCoreApplication::translate("PlotPlaces", text); }

}  // namespace

void fillPlotMenu(QMenu& menu, const std::vector<OpenPlot>& plots,
                  const std::function<void(PlotView*, int)>& choose) {
    const auto add = [&](QString text, PlotView* plot, int panel) {
        menu.addAction(text.replace('&', QLatin1String{"&&"}), &menu,
                       [choose, of = QPointer{plot}, panel] { choose(of, panel); });
    };
    for (const OpenPlot& each : plots) {
        const int panels = each.view->lines().panels();
        for (int panel = 0; panel < panels; ++panel) {
            add(placeText("%1: %2").arg(each.title, each.view->lines().titleOf(panel)), each.view,
                panel);
        }
        add(panels > 0 ? placeText("%1: new panel").arg(each.title) : each.title, each.view,
            panels);
        menu.addSeparator();
    }
    add(placeText("New plot"), nullptr, -1);
}

}  // namespace cortex::gui
