// SPDX-License-Identifier: Apache-2.0
#include "window/regions.hpp"

#include <QAbstractButton>
#include <QApplication>
#include <QWidget>
#include <algorithm>
#include <tuple>

namespace cortex::gui {

namespace {

constexpr int oneLine = 32, sameLine = 14;  // px

bool takesFocus(const QWidget& widget) {
    return widget.isVisible() && widget.isEnabled() && (widget.focusPolicy() & Qt::TabFocus) != 0 &&
           widget.focusProxy() == nullptr;
}

QPoint placeOf(const QWidget& widget) {
    const QPoint at = widget.mapTo(widget.window(), QPoint{});
    return {at.x(), at.y() + std::min(widget.height(), oneLine) / 2};
}

// Line by line, and from left to right.
std::vector<QWidget*> readingOrder(QWidget& region) {
    std::vector<QWidget*> all;
    for (QWidget* each : region.findChildren<QWidget*>())
        if (takesFocus(*each)) all.push_back(each);
    if (takesFocus(region)) all.push_back(&region);
    std::ranges::sort(all, {}, [](const QWidget* each) { return placeOf(*each).y(); });
    for (auto line = all.begin(); line != all.end();) {
        const int top = placeOf(**line).y();
        const auto next = std::find_if(line, all.end(), [&](const QWidget* each) {
            return placeOf(*each).y() > top + sameLine;
        });
        std::sort(line, next, [](const QWidget* left, const QWidget* right) {
            return placeOf(*left).x() < placeOf(*right).x();
        });
        line = next;
    }
    return all;
}

}  // namespace

void Regions::walk(bool back) const {
    const QWidget* now = QApplication::focusWidget();
    const auto count = static_cast<int>(regions_.size());
    int at = back ? count : -1;
    for (int i = 0; i < count; ++i) {
        const QWidget* region = regions_[static_cast<std::size_t>(i)];
        if (now != nullptr && (region == now || region->isAncestorOf(now))) at = i;
    }
    for (int tried = 0; tried < count; ++tried) {
        at = (at + (back ? -1 : 1) + count) % count;
        const auto widgets = readingOrder(*regions_[static_cast<std::size_t>(at)]);
        if (widgets.empty()) continue;
        widgets.front()->window()->setAttribute(Qt::WA_KeyboardFocusChange);
        widgets.front()->setFocus(Qt::TabFocusReason);
        return;
    }
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
                          (placeOf(*each) - placeOf(gone)).manhattanLength()};
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
