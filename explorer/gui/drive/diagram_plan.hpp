// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/drives/ds402_state.hpp"

#include <QPolygonF>
#include <QRect>
#include <QSize>
#include <array>
#include <vector>

class QFontMetrics;

namespace cortex::explorer {

// Where the states of CiA 402 and the transitions between them stand in their diagram. 0 and 13,
// which begin anywhere, are not drawn.
struct DiagramPlan {
    struct Route {
        int number;
        drives::Ds402State from;
        QPolygonF line;  // ends at a state
    };

    QSize size;
    std::array<QRect, 9> boxes;       // by state; of Unknown: empty
    std::array<QRect, 17> numbers{};  // where the number of a transition stands
    std::vector<Route> routes;

    const QRect& box(drives::Ds402State state) const {
        return boxes[static_cast<std::size_t>(state)];
    }
};

// For texts in this font.
DiagramPlan diagramPlan(const QFontMetrics& metrics);

}  // namespace cortex::explorer
