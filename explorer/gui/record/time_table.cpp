// SPDX-License-Identifier: Apache-2.0
#include "record/time_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cortex::gui {

namespace {

constexpr std::int64_t longest = 65'536;  // samples of one line
constexpr double tolerance = 10;          // parts of a period

double between(double x, double x0, double y0, double x1, double y1) {
    return x1 > x0 ? y0 + (x - x0) * (y1 - y0) / (x1 - x0) : y0;
}

}  // namespace

void TimeTable::add(std::int64_t index, std::int64_t utc, std::int64_t period) {
    take(period);
    const std::size_t count = points_.size();
    if (count > 0 && index <= points_.back().index) return;
    const bool open = open_ && count >= 2 && index - points_[count - 2].index <= longest;
    if (open && isOnLine(points_[count - 2], index, utc)) {
        points_.back() = {index, utc};
        return;
    }
    points_.push_back({index, utc});
    open_ = true;
    least_ = -std::numeric_limits<double>::infinity();
    most_ = -least_;
    if (count > 0) isOnLine(points_[count - 1], index, utc);
}

// Whether a line from there to this sample passes all samples between them closely enough. This
// one narrows the slopes of the lines to later ones.
bool TimeTable::isOnLine(const Point& from, std::int64_t index, std::int64_t utc) {
    const auto run = static_cast<double>(index - from.index);
    const auto rise = static_cast<double>(utc - from.utc);
    const double slope = rise / run, slack = static_cast<double>(period_) / tolerance / run;
    if (slope < least_ || slope > most_) return false;
    least_ = std::max(least_, slope - slack);
    most_ = std::min(most_, slope + slack);
    return true;
}

// Of a busy agent, which leaves periods out, most are longer.
void TimeTable::take(std::int64_t period) {
    if (period <= 0 || (known_ && period >= period_)) return;
    period_ = period;
    known_ = true;
}

void TimeTable::startAnew(std::int64_t index, std::int64_t utc, std::int64_t period) {
    known_ = false;
    take(period);
    points_.push_back({index, utc});
    open_ = false;
}

void TimeTable::forgetBefore(std::int64_t index) {
    const auto first = std::ranges::upper_bound(points_, index, {}, &Point::index);
    if (first - points_.begin() > 1) points_.erase(points_.begin(), first - 1);
}

std::int64_t TimeTable::utcAt(std::int64_t index) const {
    const auto after = std::ranges::upper_bound(points_, index, {}, &Point::index);
    return utcBefore(static_cast<std::size_t>(after - points_.begin()), index);
}

// Of an index before this point, and not before the point before it.
std::int64_t TimeTable::utcBefore(std::size_t after, std::int64_t index) const {
    if (points_.empty()) return 0;
    if (after == 0) return points_.front().utc - (points_.front().index - index) * period_;
    const Point& from = points_[after - 1];
    if (after == points_.size()) return from.utc + (index - from.index) * period_;
    const Point& to = points_[after];
    return from.utc + static_cast<std::int64_t>(
                          std::llround(between(static_cast<double>(index - from.index), 0, 0,
                                               static_cast<double>(to.index - from.index),
                                               static_cast<double>(to.utc - from.utc))));
}

std::int64_t TimeWalk::utcAt(std::int64_t index) {
    const auto& points = table_.points_;
    while (after_ < points.size() && points[after_].index <= index) ++after_;
    return table_.utcBefore(after_, index);
}

double TimeTable::indexAt(double utc) const {
    if (points_.empty()) return 0;
    const auto ns = static_cast<std::int64_t>(utc);
    const auto after = std::ranges::upper_bound(points_, ns, {}, &Point::utc);
    const auto period = static_cast<double>(period_);
    const Point& from = after == points_.begin() ? points_.front() : *(after - 1);
    const auto start = static_cast<double>(from.index);
    const auto since = static_cast<double>(ns - from.utc);
    if (after == points_.begin() || after == points_.end()) return start + since / period;
    return between(since, 0, start, static_cast<double>(after->utc - from.utc),
                   static_cast<double>(after->index));
}

}  // namespace cortex::gui
