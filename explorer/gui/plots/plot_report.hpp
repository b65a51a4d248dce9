// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QStringList>
#include <QWidget>

class QPainter;

namespace cortex::gui {

// A plot as a report has it: the range and all names above the panels, and the whole legend beside
// them, however much of it is seen in the window.
class PlotReport {
public:
    // The legend may be none.
    PlotReport(QWidget& panels, QWidget* legend, const QString& range, const QStringList& names);
    QSize size() const;
    QStringList title() const { return title_; }  // its rows
    void paint(QPainter& painter) const;

private:
    int width() const;
    void addNames(const QStringList& names);

    QWidget& panels_;
    QWidget* legend_;
    QStringList title_;
};

}  // namespace cortex::gui
