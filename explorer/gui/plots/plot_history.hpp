// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plots/plot_lines.hpp"

#include <QString>
#include <optional>
#include <vector>

namespace cortex::gui {

// The lines of a plot before each change of the user, to go back to.
class PlotHistory {
public:
    static constexpr std::size_t most = 50;  // steps
    static constexpr std::size_t kept = 5;   // the newest ones, whose lines go on being recorded

    void remember(PlotLines before, const QString& change);
    std::optional<PlotLines> undo();
    bool empty() const { return steps_.empty(); }
    QString change() const;  // the last one in words; empty: there is none
    // What comes back with its samples where it is undone soon.
    std::vector<RecordedItem> recorded() const;
    void clear() { steps_.clear(); }

private:
    struct Step {
        PlotLines before;
        QString change;
    };
    std::vector<Step> steps_;
};

}  // namespace cortex::gui
