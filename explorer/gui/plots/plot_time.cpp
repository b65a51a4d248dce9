// SPDX-License-Identifier: Apache-2.0
// What a plot takes for now, and what it says of clocks and of what is kept.
#include "model/plain_text.hpp"
#include "model/value_text.hpp"
#include "plots/plot_bar.hpp"
#include "plots/plot_view.hpp"
#include "plots/time_ticks.hpp"
#include "widgets/text_label.hpp"

#include <QStringList>
#include <algorithm>
#include <cmath>
#include <utility>

namespace cortex::gui {

namespace {

constexpr qint64 quiet = 300;       // ms without anything, after which time goes on by our clock
constexpr double second = 1'000.0;  // ms

// "robot's clock is 0.4 s ahead".
QString clockNotice(const std::string& agent, std::int64_t shift) {
    // Rounded, as two hours less some milliseconds are two hours.
    const double exact = std::abs(static_cast<double>(shift)) * 1e-9;
    const double seconds = exact < 1 ? exact : std::round(exact * 10) / 10;
    const QString size =
        seconds < 1 ? PlotView::tr("%1 s").arg(seconds, 0, 'g', 1) : ageText(seconds);
    return (shift > 0 ? PlotView::tr("%1's clock is %2 ahead")
                      : PlotView::tr("%1's clock is %2 behind"))
        .arg(plainText(agent), size);
}

// "98", or "98 to 246".
QString rangeText(const std::vector<std::int64_t>& counts) {
    if (counts.empty()) return QStringLiteral("0");
    const auto [least, most] = std::ranges::minmax(counts);
    const auto text = [](std::int64_t each) { return countText(static_cast<std::uint64_t>(each)); };
    return least == most ? text(least) : PlotView::tr("%1 to %2").arg(text(least), text(most));
}

}  // namespace

// Takes over what is known of clocks. True: lines are elsewhere than before.
bool PlotView::shiftClocks() {
    std::map<std::string, std::int64_t> now;
    for (const PlotLine& each : lines_.all()) {
        const AgentTime* time = each.known ? recorder_.time(each.item.agent) : nullptr;
        if (time != nullptr && time->clock.shift() != 0) {
            now[each.item.agent] = time->clock.shift();
        }
    }
    const bool shifted = now != shifts_;
    shifts_ = std::move(now);
    return shifted;
}

// Now is the newest moment that anything came from, and goes on while nothing comes.
void PlotView::advance() {
    const bool shifted = shiftClocks();
    double newest = shifted ? 0 : newest_;
    for (const PlotLine& each : lines_.all()) {
        const AgentTime* time = each.known ? recorder_.time(each.item.agent) : nullptr;
        if (time != nullptr && time->end > 0) {
            newest = std::max(newest, time->secondsAt(time->end - 1));
        }
    }
    if (shifted && newest > 0) range_.setNow(newest);
    if (newest > newest_ || shifted) {
        newest_ = newest;
        silence_.restart();
    }
    const qint64 since = silence_.elapsed();
    if (newest_ > 0)
        range_.advance(newest_ + (since > quiet ? static_cast<double>(since) / second : 0));
}

TimeSpan PlotView::kept() const {
    const double now = range_.shown().to + range_.behind();
    TimeSpan kept{now, now};
    for (const DrawnLine& each : drawn()) {
        if (each.any()) kept.from = std::min(kept.from, each.time->secondsAt(each.ring->begin()));
    }
    return kept;
}

// What is kept, and why that is not everything.
void PlotView::showNotices() {
    std::vector<std::int64_t> samples;
    std::uint64_t skipped = 0;
    for (const DrawnLine& each : drawn()) {
        samples.push_back(each.any() ? each.ring->present() : 0);
        if (!each.any()) continue;
        skipped = std::max(skipped, each.time->skipped);
    }
    QString kept =
        tr("%1 samples a line in %2, %3 lost on the way")
            .arg(rangeText(samples), durationText(this->kept().length()), countText(skipped));
    if (!written_.isEmpty()) kept += QStringLiteral("; ") + written_;
    foot_->show(kept);
    QStringList notices;
    if (!notWritten_.isEmpty()) notices << notWritten_;
    if (recorder_.shortened()) {
        notices << tr("Oldest minutes dropped: the memory limit is reached");
    }
    for (const auto& [agent, shift] : shifts_) notices << clockNotice(agent, shift);
    notice_ = notices.join(QStringLiteral("; "));
    bar_->say(notice_);
}

}  // namespace cortex::gui
