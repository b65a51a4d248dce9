// SPDX-License-Identifier: Apache-2.0
#include "widgets/flow_layout.hpp"

#include "style/look.hpp"

#include <algorithm>

namespace cortex::gui {

FlowLayout::FlowLayout(double gapUnits) : gap_{gapUnits} { setContentsMargins(0, 0, 0, 0); }

FlowLayout::~FlowLayout() { qDeleteAll(items_); }

void FlowLayout::addItem(QLayoutItem* item) { items_ << item; }

QLayoutItem* FlowLayout::takeAt(int index) {
    return index >= 0 && index < items_.size() ? items_.takeAt(index) : nullptr;
}

void FlowLayout::setGeometry(const QRect& rect) {
    QLayout::setGeometry(rect);
    place(rect, true);
}

QSize FlowLayout::minimumSize() const {
    QSize size;
    for (const QLayoutItem* each : items_) size = size.expandedTo(each->minimumSize());
    return size;
}

int FlowLayout::place(const QRect& rect, bool moves) const {
    const int gap = Look::units(gap_);
    int x = rect.x(), y = rect.y(), high = 0;
    for (QLayoutItem* each : items_) {
        const QSize size = each->sizeHint();
        if (each->isEmpty()) continue;
        if (x > rect.x() && x + size.width() > rect.x() + rect.width()) {
            x = rect.x();
            y += high + gap;
            high = 0;
        }
        if (moves) each->setGeometry(QRect{QPoint{x, y}, size});
        x += size.width() + gap;
        high = std::max(high, size.height());
    }
    return y + high - rect.y();
}

}  // namespace cortex::gui
