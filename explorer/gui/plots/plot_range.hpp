// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cortex::gui {

struct TimeSpan {
    double from = 0, to = 0;  // s, UTC
    double length() const { return to - from; }
    bool operator==(const TimeSpan&) const = default;
};

// Which stretch of time a plot shows: up to now while it follows, otherwise one that stays where it
// is, whatever comes.
class PlotRange {
public:
    static constexpr double least = 0.01, most = 700;  // s

    explicit PlotRange(double span = 20) : span_{span} {}

    bool follows() const { return follows_; }
    bool known() const { return to_ != 0; }  // anything has come; nothing moves before
    double span() const { return span_; }
    TimeSpan shown() const { return {to_ - span_, to_}; }
    double behind() const { return now_ - to_; }  // s

    void advance(double now);  // a later moment has come
    void setNow(double now);   // also to an earlier one: a clock was found to be wrong
    void follow();
    void hold() { follows_ = false; }
    void setSpan(double seconds);  // up to where it ends
    // All of these hold.
    void show(TimeSpan span);
    void pan(double seconds);
    void zoom(double factor, double around);  // the moment that stays in its place

private:
    double span_, now_ = 0, to_ = 0;
    bool follows_ = true;
};

}  // namespace cortex::gui
