// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plots/plot_range.hpp"

#include <QString>
#include <QStringList>
#include <QWidget>
#include <optional>

namespace cortex::gui {

// Two moments that are compared, and the one below the pointer.
struct Cursors {
    bool shown = false;
    double a = 0, b = 0;  // s, UTC
    std::optional<double> pointer{};
    TimeSpan span() const { return a < b ? TimeSpan{a, b} : TimeSpan{b, a}; }
};

// "A"; "← A" and "A →" where it is out of view.
QString cursorName(QChar name, double at, TimeSpan shown);

// Draws the cursors over panels and lanes, and what is marked to be zoomed. It takes no input.
class CursorOverlay : public QWidget {
    Q_OBJECT
public:
    explicit CursorOverlay(QWidget* parent);
    void show(const Cursors& cursors, TimeSpan span, const QRect& plot, char chosen);
    void mark(int from, int to);  // pixels; equal: nothing
    // Above the panels, so that the moments of cursors hide no line: a row for each.
    static int bandHeight();
    QStringList texts() const;  // of the cursors, as they are shown

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void paintCursor(QPainter& painter, double at, QChar name) const;
    void paintPointer(QPainter& painter, double at) const;
    void paintMoment(QPainter& painter, double x, double clear, double top,
                     const QString& text) const;
    QString momentOf(double at) const;
    // Nothing where the moment is not seen.
    std::optional<double> placeOf(double at) const;
    bool showsAny() const { return cursors_.shown || cursors_.pointer || from_ != to_; }

    Cursors cursors_;
    TimeSpan span_;
    QRect plot_;
    char chosen_ = 0;
    int from_ = 0, to_ = 0;
};

}  // namespace cortex::gui
