// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "record/recorded_item.hpp"

#include <QString>
#include <functional>
#include <vector>

class QMenu;

namespace cortex::gui {

class PlotView;

// A plot that is open, with the title of its tab.
struct OpenPlot {
    PlotView* view = nullptr;
    QString title;
};

// Where values can be plotted, as a menu: each panel of each plot that is open, a new panel of it,
// and a new plot. `plot` is given null for a new one, and the panel; one behind the last is new.
void fillPlotMenu(QMenu& menu, const std::vector<OpenPlot>& plots,
                  const std::function<void(PlotView* plot, int panel)>& choose);

}  // namespace cortex::gui
