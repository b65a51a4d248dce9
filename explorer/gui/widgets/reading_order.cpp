// SPDX-License-Identifier: Apache-2.0
#include "widgets/reading_order.hpp"

#include <QAbstractItemView>
#include <QWidget>
#include <algorithm>

namespace cortex::gui {

namespace {

constexpr int oneLine = 32, sameLine = 14, leastTable = 40;  // px

bool takesTab(const QWidget& widget) {
    return widget.isVisible() && widget.isEnabled() && (widget.focusPolicy() & Qt::TabFocus) != 0 &&
           widget.focusProxy() == nullptr;
}

}  // namespace

QPoint readingPlace(const QWidget& widget) {
    const QPoint at = widget.mapTo(widget.window(), QPoint{});
    return {at.x(), at.y() + std::min(widget.height(), oneLine) / 2};
}

std::vector<QWidget*> readingOrder(QWidget& part) {
    std::vector<QWidget*> all;
    for (QWidget* each : part.findChildren<QWidget*>())
        if (takesTab(*each)) all.push_back(each);
    if (takesTab(part)) all.push_back(&part);
    std::ranges::sort(all, {}, [](const QWidget* each) { return readingPlace(*each).y(); });
    for (auto line = all.begin(); line != all.end();) {
        const int top = readingPlace(**line).y();
        const auto next = std::find_if(line, all.end(), [&](const QWidget* each) {
            return readingPlace(*each).y() > top + sameLine;
        });
        std::sort(line, next, [](const QWidget* left, const QWidget* right) {
            return readingPlace(*left).x() < readingPlace(*right).x();
        });
        line = next;
    }
    return all;
}

bool isTable(const QWidget& widget) {
    const auto* view = qobject_cast<const QAbstractItemView*>(&widget);
    return view != nullptr && view->height() >= leastTable && view->model() != nullptr &&
           view->model()->rowCount() > 0;
}

QWidget* mainStop(QWidget& part) {
    const auto all = readingOrder(part);
    const auto table =
        std::ranges::find_if(all, [](const QWidget* each) { return isTable(*each); });
    if (table != all.end()) return *table;
    return all.empty() ? nullptr : all.front();
}

}  // namespace cortex::gui
