// SPDX-License-Identifier: Apache-2.0
#include "plots/plot_pointer.hpp"

#include "plots/plot_panel.hpp"
#include "plots/plot_view.hpp"
#include "style/look.hpp"

#include <QMouseEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace cortex::gui {

namespace {

constexpr double wheelStep = 0.8;  // of the span, for one notch
constexpr int notch = 120;         // as Qt counts it

}  // namespace

PlotPointer::PlotPointer(PlotView& view) : QObject{&view}, view_{view} {}

char PlotPointer::cursorAt(int x) const {
    if (!view_.cursors_.shown) return 0;
    const double near = view_.secondsOfPixel() * Look::units(1.5), at = view_.secondsAt(x);
    if (std::abs(view_.cursors_.a - at) < near) return 'A';
    return std::abs(view_.cursors_.b - at) < near ? 'B' : '\0';
}

std::optional<double> PlotPointer::moment() const {
    if (!over_ || drag_ != Drag::None) return {};
    return view_.secondsAt(*over_);
}

void PlotPointer::wheel(const QWheelEvent& event, int x) {
    const double notches = static_cast<double>(event.angleDelta().y()) / notch;
    if (notches == 0) return;
    view_.range_.zoom(std::pow(wheelStep, notches), view_.secondsAt(x));
    view_.redraw();
}

void PlotPointer::press(const QMouseEvent& event, int x) {
    last_ = start_ = x;
    const char cursor = cursorAt(x);
    view_.chosen_ = cursor;
    if (cursor != 0) {
        drag_ = cursor == 'A' ? Drag::CursorA : Drag::CursorB;
    } else {
        drag_ = (event.modifiers() & Qt::ControlModifier) != 0 ? Drag::Mark : Drag::Pan;
    }
    view_.setFocus(Qt::MouseFocusReason);
}

void PlotPointer::move(int x) {
    const int by = x - last_;
    last_ = x;
    switch (drag_) {
        case Drag::None:
            over_ = x;
            view_.frames_ = 0;  // shown in the next frame
            return;
        case Drag::Pan:
            if (by != 0) view_.range_.pan(-by * view_.secondsOfPixel());
            break;
        case Drag::Mark:
            return view_.overlay_->mark(start_, x);
        case Drag::CursorA:
            view_.cursors_.a = view_.secondsAt(x);
            break;
        case Drag::CursorB:
            view_.cursors_.b = view_.secondsAt(x);
            break;
    }
    view_.redraw();
}

void PlotPointer::release(int x) {
    if (drag_ == Drag::Mark) {
        view_.overlay_->mark(0, 0);
        const double one = view_.secondsAt(start_), other = view_.secondsAt(x);
        if (std::abs(x - start_) > Look::units(1)) {
            view_.range_.show({std::min(one, other), std::max(one, other)});
        }
        view_.redraw();
    }
    drag_ = Drag::None;
}

bool PlotPointer::eventFilter(QObject* watched, QEvent* event) {
    auto* canvas = qobject_cast<QWidget*>(watched);
    if (canvas == nullptr) return false;
    const auto place = [&](const QPoint& at) { return canvas->mapTo(view_.column_, at).x(); };
    switch (event->type()) {
        case QEvent::Wheel: {
            const auto& wheeled = static_cast<QWheelEvent&>(*event);
            wheel(wheeled, place(wheeled.position().toPoint()));
            return true;
        }
        case QEvent::MouseButtonPress: {
            const auto& pressed = static_cast<QMouseEvent&>(*event);
            if (pressed.button() != Qt::LeftButton) return false;
            press(pressed, place(pressed.pos()));
            return true;
        }
        case QEvent::MouseMove:
            move(place(static_cast<QMouseEvent&>(*event).pos()));
            return drag_ != Drag::None;
        case QEvent::MouseButtonRelease:
            release(place(static_cast<QMouseEvent&>(*event).pos()));
            return false;
        case QEvent::Leave:
            over_.reset();
            view_.frames_ = 0;
            return false;
        case QEvent::MouseButtonDblClick:
            for (PlotPanel* each : view_.panels_) {
                if (each->canvas() == canvas) each->resetValues();
            }
            view_.redraw();
            return true;
        default:
            return false;
    }
}

}  // namespace cortex::gui
