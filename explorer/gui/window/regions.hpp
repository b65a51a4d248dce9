// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

class QWidget;

namespace cortex::gui {

// The parts of a window in reading order. F6 walks them, Tab walks what is in them.
class Regions {
public:
    void set(std::vector<QWidget*> regions) { regions_ = std::move(regions); }
    // To the first widget of the next region that has one, or of the one before.
    void walk(bool back) const;
    // To the next widget of all, or to the one before; false: there is none. From one that has just
    // been hidden or disabled, it is the nearest one of its region, and no button if possible: a
    // second press of the key must not press another one.
    bool step(bool back) const;

private:
    QWidget* nearest(const std::vector<QWidget*>& all, const QWidget& gone) const;

    std::vector<QWidget*> regions_;
};

}  // namespace cortex::gui
