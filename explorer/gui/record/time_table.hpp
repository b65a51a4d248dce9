// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cortex::gui {

// When the samples of one agent were taken, in UTC: straight lines between a few known ones.
class TimeTable {
public:
    // The next known sample; its index is above those before it.
    void add(std::int64_t index, std::int64_t utc, std::int64_t period);  // ns
    // A sample from which on no line leads back, as after another start of the agent; 0: its period
    // is not known.
    void startAnew(std::int64_t index, std::int64_t utc, std::int64_t period);
    void forgetBefore(std::int64_t index);

    bool empty() const { return points_.empty(); }
    std::int64_t period() const { return period_; }  // ns, the shortest that was seen
    bool knowsPeriod() const { return known_; }
    std::int64_t last() const { return points_.empty() ? 0 : points_.back().utc; }
    std::int64_t utcAt(std::int64_t index) const;  // beyond its ends by the period
    double indexAt(double utc) const;              // ns; between two samples, too

private:
    struct Point {
        std::int64_t index = 0, utc = 0;
    };
    friend class TimeWalk;
    void take(std::int64_t period);
    std::int64_t utcBefore(std::size_t after, std::int64_t index) const;
    bool isOnLine(const Point& from, std::int64_t index, std::int64_t utc);

    std::vector<Point> points_;
    std::int64_t period_ = 1'000'000;
    bool known_ = false;
    bool open_ = false;            // the last point may still move along its line
    double least_ = 0, most_ = 0;  // slope of that line, ns a sample
};

// The times of one index after the other, each above the one before: quicker than a search.
class TimeWalk {
public:
    explicit TimeWalk(const TimeTable& table) : table_{table} {}
    std::int64_t utcAt(std::int64_t index);

private:
    const TimeTable& table_;
    std::size_t after_ = 0;
};

}  // namespace cortex::gui
