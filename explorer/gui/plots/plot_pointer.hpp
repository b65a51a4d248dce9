// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QObject>
#include <QPoint>
#include <optional>

class QMouseEvent;
class QWheelEvent;

namespace cortex::gui {

class PlotView;

// What the mouse does to a plot: the wheel zooms time, a drag moves it, a drag with Ctrl marks what
// is to be zoomed, a double click lets values be fitted again. Cursors are dragged.
class PlotPointer : public QObject {
    Q_OBJECT
public:
    explicit PlotPointer(PlotView& view);
    bool eventFilter(QObject* watched, QEvent* event) override;
    std::optional<double> moment() const;  // below the pointer, s, UTC

private:
    void wheel(const QWheelEvent& event, int x);
    void press(const QMouseEvent& event, int x);
    void move(int x);
    void release(int x);
    char cursorAt(int x) const;

    enum class Drag { None, Pan, Mark, CursorA, CursorB };
    PlotView& view_;
    Drag drag_ = Drag::None;
    int last_ = 0, start_ = 0;
    std::optional<int> over_;
};

}  // namespace cortex::gui
