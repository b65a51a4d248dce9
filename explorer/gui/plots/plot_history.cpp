// SPDX-License-Identifier: Apache-2.0
#include "plots/plot_history.hpp"

#include <algorithm>
#include <utility>

namespace cortex::gui {

void PlotHistory::remember(PlotLines before, const QString& change) {
    steps_.push_back({std::move(before), change});
    if (steps_.size() > most) steps_.erase(steps_.begin());
}

std::optional<PlotLines> PlotHistory::undo() {
    if (steps_.empty()) return std::nullopt;
    PlotLines before = std::move(steps_.back().before);
    steps_.pop_back();
    return before;
}

QString PlotHistory::change() const { return steps_.empty() ? QString{} : steps_.back().change; }

std::vector<RecordedItem> PlotHistory::recorded() const {
    std::vector<RecordedItem> all;
    const std::size_t first = steps_.size() - std::min(steps_.size(), kept);
    for (std::size_t i = first; i < steps_.size(); ++i) {
        for (RecordedItem& each : steps_[i].before.recorded()) {
            if (std::ranges::find(all, each) == all.end()) all.push_back(std::move(each));
        }
    }
    return all;
}

}  // namespace cortex::gui
