// SPDX-License-Identifier: Apache-2.0
#include "plots/plot_range.hpp"

#include <algorithm>

namespace cortex::gui {

void PlotRange::advance(double now) {
    now_ = std::max(now_, now);
    if (follows_ || to_ == 0) to_ = now_;
}

void PlotRange::setNow(double now) {
    now_ = now;
    if (follows_) to_ = now;
}

void PlotRange::follow() {
    follows_ = true;
    to_ = now_;
}

void PlotRange::setSpan(double seconds) { span_ = std::clamp(seconds, least, most); }

void PlotRange::show(TimeSpan span) {
    hold();
    setSpan(span.length());
    if (known()) to_ = span.to;
}

void PlotRange::pan(double seconds) {
    hold();
    if (known()) to_ += seconds;
}

void PlotRange::zoom(double factor, double around) {
    hold();
    const double before = span_;
    setSpan(span_ * factor);
    if (known()) to_ = around + (to_ - around) * (span_ / before);
}

}  // namespace cortex::gui
