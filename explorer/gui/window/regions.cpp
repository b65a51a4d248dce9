// SPDX-License-Identifier: Apache-2.0
#include "window/regions.hpp"

#include "widgets/reading_order.hpp"

#include <QAbstractButton>
#include <QApplication>
#include <QWidget>
#include <algorithm>
#include <tuple>

namespace cortex::gui {

void Regions::walk(bool back) const {
    std::vector<QWidget*> all, stops;  // in reading order
    for (QWidget* region : regions_) {
        for (bool first = true; QWidget * each : readingOrder(*region)) {
            all.push_back(each);
            if (first || isTable(*each)) stops.push_back(each);
            first = false;
        }
    }
    if (stops.empty()) return;
    const auto placeIn = [&](const QWidget* widget) { return std::ranges::find(all, widget); };
    const auto now = placeIn(QApplication::focusWidget());
    const auto isAfter = [&](const QWidget* each) { return placeIn(each) > now; };
    const auto isBefore = [&](const QWidget* each) { return placeIn(each) < now; };
    QWidget* next = back ? stops.back() : stops.front();
    if (now != all.end() && back) {
        const auto found = std::find_if(stops.rbegin(), stops.rend(), isBefore);
        if (found != stops.rend()) next = *found;
    } else if (now != all.end()) {
        const auto found = std::ranges::find_if(stops, isAfter);
        if (found != stops.end()) next = *found;
    }
    next->window()->setAttribute(Qt::WA_KeyboardFocusChange);
    next->setFocus(Qt::TabFocusReason);
}

// Of `all`, in which `gone` is not.
QWidget* Regions::nearest(const std::vector<QWidget*>& all, const QWidget& gone) const {
    const auto regionOf = [this](const QWidget& widget) {
        return std::ranges::find_if(regions_, [&](const QWidget* region) {
            return region == &widget || region->isAncestorOf(&widget);
        });
    };
    return *std::ranges::min_element(all, {}, [&](const QWidget* each) {
        return std::tuple{regionOf(*each) != regionOf(gone),
                          qobject_cast<const QAbstractButton*>(each) != nullptr,
                          (readingPlace(*each) - readingPlace(gone)).manhattanLength()};
    });
}

bool Regions::step(bool back) const {
    std::vector<QWidget*> all;
    for (QWidget* region : regions_) {
        const auto widgets = readingOrder(*region);
        all.insert(all.end(), widgets.begin(), widgets.end());
    }
    if (all.empty()) return false;
    const QWidget* focused = QApplication::focusWidget();
    const auto now = std::ranges::find(all, focused);
    if (focused != nullptr && now == all.end()) {
        nearest(all, *focused)->setFocus(Qt::OtherFocusReason);
        return true;
    }
    const auto size = static_cast<std::ptrdiff_t>(all.size());
    const std::ptrdiff_t at = now == all.end() ? (back ? size : -1) : now - all.begin();
    const std::ptrdiff_t next = (at + (back ? -1 : 1) + size) % size;
    all[static_cast<std::size_t>(next)]->setFocus(back ? Qt::BacktabFocusReason
                                                       : Qt::TabFocusReason);
    return true;
}

}  // namespace cortex::gui
