// SPDX-License-Identifier: Apache-2.0
#include "widgets/state_mark.hpp"

#include "style/look.hpp"

#include <QPainter>

namespace cortex::gui {

StateMark::StateMark(double units, QWidget* parent) : QWidget{parent}, units_{units} {
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    setAccessibleName(word(shape_));
}

void StateMark::show(Shape shape) {
    if (shape == shape_) return;
    shape_ = shape;
    setAccessibleName(word(shape));
    update();
}

void StateMark::setUnits(double units) {
    if (units == units_) return;
    units_ = units;
    updateGeometry();
}

QSize StateMark::sizeHint() const { return {Look::units(units_), Look::units(units_)}; }

void StateMark::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    gui::paint(painter, rect().adjusted(1, 1, -1, -1), shape_, Look::colours());
}

}  // namespace cortex::gui
