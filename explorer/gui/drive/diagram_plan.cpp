// SPDX-License-Identifier: Apache-2.0
#include "drive/diagram_plan.hpp"

#include "cortex/explorer/theme.hpp"

#include "drive/transitions.hpp"

#include <QFontMetrics>
#include <algorithm>

namespace cortex::explorer {

namespace {

using drives::Ds402State;
using enum drives::Ds402State;

// From left to right: three lanes for the ways that switch off, the states, a gap that ways cross,
// and the states of stop and fault.
struct DiagramColumns {
    int lane, left, leftWide, gap, right, rightWide;
    int row, high, numberWide, numberHigh;  // from one row to the next; of a state; of a number

    int top(int index) const { return index * row; }
    int middle(int index) const { return top(index) + high / 2; }
    int below(int index) const { return top(index) + (high + row) / 2; }  // between two rows
    int laneAt(int index) const { return lane * index + lane / 2; }
};

int widest(const QFontMetrics& metrics, std::initializer_list<Ds402State> states) {
    int width = 0;
    for (const Ds402State each : states)
        width = std::max(width, metrics.horizontalAdvance(nameOfState(each)));
    return width + units(2);
}

DiagramColumns columnsFor(const QFontMetrics& metrics) {
    DiagramColumns c{};
    c.numberWide = metrics.horizontalAdvance(QStringLiteral("16")) + units(2);
    c.numberHigh = metrics.height() + 1;
    c.high = metrics.height() + units(0.5);
    c.row = c.high + c.numberHigh + units(0.5);
    c.lane = c.numberWide + units(0.5);
    c.left = 3 * c.lane;
    c.leftWide = widest(metrics, {SwitchOnDisabled, ReadyToSwitchOn, SwitchedOn, OperationEnabled});
    c.gap = c.numberWide + units(3.5);
    c.right = c.left + c.leftWide + c.gap;
    c.rightWide = widest(metrics, {QuickStopActive, Fault});
    return c;
}

// The two states of the first row are wider, to the left: no way passes there.
void placeStates(DiagramPlan& plan, const DiagramColumns& c, const QFontMetrics& metrics) {
    const auto put = [&](Ds402State state, int left, int row, int width) {
        plan.boxes[static_cast<std::size_t>(state)] = {left, c.top(row), width, c.high};
    };
    const int leftEnd = c.left + c.leftWide, rightEnd = c.right + c.rightWide;
    const int first = std::max(widest(metrics, {NotReadyToSwitchOn}), c.leftWide);
    const int second = std::max(widest(metrics, {FaultReactionActive}), c.rightWide);
    put(NotReadyToSwitchOn, leftEnd - first, 0, first);
    put(FaultReactionActive, rightEnd - second, 0, second);
    int row = 1;
    for (const Ds402State each : {SwitchOnDisabled, ReadyToSwitchOn, SwitchedOn, OperationEnabled})
        put(each, c.left, row++, c.leftWide);
    put(Fault, c.right, 1, c.rightWide);
    put(QuickStopActive, c.right, 4, c.rightWide);
    plan.size = {rightEnd + 1, c.top(4) + c.high + 1};
}

QPolygonF wayOf(std::initializer_list<QPoint> points) {
    QPolygonF way;
    for (const QPoint& each : points) way << each;
    return way;
}

void addWay(DiagramPlan& plan, const DiagramColumns& c, int number, Ds402State from, QPoint centre,
            const QPolygonF& line) {
    plan.routes.push_back({number, from, line});
    plan.numbers[static_cast<std::size_t>(number)] = {
        centre.x() - c.numberWide / 2, centre.y() - c.numberHigh / 2, c.numberWide, c.numberHigh};
}

// Up and down between neighbours, the number on the outer side of the arrow.
void addLadder(DiagramPlan& plan, const DiagramColumns& c) {
    struct Rung {
        int number, row;  // above it
        Ds402State from;
        bool down, right;
    };
    const int side = c.numberWide / 2 + units(1);
    for (const Rung& each :
         {Rung{1, 0, NotReadyToSwitchOn, true, false}, Rung{2, 1, SwitchOnDisabled, true, false},
          Rung{7, 1, ReadyToSwitchOn, false, false}, Rung{3, 2, ReadyToSwitchOn, true, false},
          Rung{6, 2, SwitchedOn, false, false}, Rung{4, 3, SwitchedOn, true, false},
          Rung{5, 3, OperationEnabled, false, false},
          Rung{14, 0, FaultReactionActive, true, true}}) {
        const int centre = each.right ? c.right + c.rightWide / 2 : c.left + c.leftWide / 2;
        const int x = centre + (each.down ? -1 : 1) * units(2);
        const QPoint upper{x, c.top(each.row) + c.high}, lower{x, c.top(each.row + 1)};
        const QPoint number{x + (each.down ? -side : side), c.below(each.row)};
        addWay(plan, c, each.number, each.from, number,
               each.down ? wayOf({upper, lower}) : wayOf({lower, upper}));
    }
}

// Along the left edge: what switches off, whatever it was.
void addLanes(DiagramPlan& plan, const DiagramColumns& c) {
    struct Lane {
        int number, lane, from, to, numberRow;
        Ds402State state;
    };
    for (const Lane& each :
         {Lane{9, 0, 4, 1, 2, OperationEnabled}, Lane{8, 1, 4, 2, 3, OperationEnabled},
          Lane{10, 2, 3, 1, 1, SwitchedOn}}) {
        const int x = c.laneAt(each.lane);
        addWay(plan, c, each.number, each.state, {x, c.below(each.numberRow)},
               wayOf({QPoint{c.left, c.middle(each.from)}, QPoint{x, c.middle(each.from)},
                      QPoint{x, c.middle(each.to)}, QPoint{c.left, c.middle(each.to)}}));
    }
}

// Between the two columns: quick stop and back, its end, and the reset of a fault.
void addCrossings(DiagramPlan& plan, const DiagramColumns& c) {
    const int leftEnd = c.left + c.leftWide, across = leftEnd + c.gap / 2;
    const int inLeft = leftEnd - units(2.5), inRight = c.right + units(2.5);
    const int tall = c.right + c.rightWide / 2;
    addWay(plan, c, 15, Fault, {across, c.middle(1)},
           wayOf({QPoint{c.right, c.middle(1)}, QPoint{leftEnd, c.middle(1)}}));
    addWay(plan, c, 11, OperationEnabled, {across, c.middle(4)},
           wayOf({QPoint{leftEnd, c.middle(4)}, QPoint{c.right, c.middle(4)}}));
    addWay(plan, c, 16, QuickStopActive, {across, c.below(3)},
           wayOf({QPoint{inRight, c.top(4)}, QPoint{inRight, c.below(3)},
                  QPoint{inLeft, c.below(3)}, QPoint{inLeft, c.top(4)}}));
    addWay(plan, c, 12, QuickStopActive, {tall, c.below(2)},
           wayOf({QPoint{tall, c.top(4)}, QPoint{tall, c.below(1)}, QPoint{inLeft, c.below(1)},
                  QPoint{inLeft, c.top(1) + c.high}}));
}

}  // namespace

DiagramPlan diagramPlan(const QFontMetrics& metrics) {
    const DiagramColumns columns = columnsFor(metrics);
    DiagramPlan plan;
    placeStates(plan, columns, metrics);
    addLadder(plan, columns);
    addLanes(plan, columns);
    addCrossings(plan, columns);
    return plan;
}

}  // namespace cortex::explorer
