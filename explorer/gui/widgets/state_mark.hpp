// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "style/shapes.hpp"

#include <QWidget>

namespace cortex::gui {

// A shape as a widget, named for screen readers by its word.
class StateMark : public QWidget {
    Q_OBJECT
public:
    explicit StateMark(double units, QWidget* parent = nullptr);
    void show(Shape shape);
    void setUnits(double units);
    QSize sizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    double units_;
    Shape shape_ = Shape::Unknown;
};

}  // namespace cortex::gui
