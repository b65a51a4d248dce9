// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/explorer/theme.hpp"

#include <QWidget>
#include <optional>
#include <vector>

class QGridLayout;
class QScrollArea;

namespace cortex::explorer {

class AxisPlots;
class AxisRows;
class Plate;
class Sentence;

// How a view of motion is laid out: what moves the axes in a column, the last seconds of one axis
// beside it where there is room, and lines about a jog below, in places that are kept.
class MotionPage : public QWidget {
    Q_OBJECT
public:
    // `column`: from above to below. `jogs`: there is something to be said of a jog.
    MotionPage(const std::vector<QWidget*>& column, bool jogs, QWidget* parent = nullptr);

    AxisPlots& plots() const { return *plots_; }
    bool settled() const;        // there is something of the past to see
    void reveal(QWidget& part);  // of the column
    // What jogs now, why the last jog ended, and what else is to be known. Empty: nothing.
    void say(const QString& jogging, const QString& ended, const QString& hint,
             std::optional<Tone> tone);

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void addLines();
    bool isLow() const;  // there is room for one of the lines only
    void arrange();

    bool jogs_;
    QScrollArea *left_, *right_;
    QWidget* side_;
    AxisPlots* plots_;
    Plate* jogging_;
    Sentence *ended_, *hint_;
    QGridLayout* lines_;
};

}  // namespace cortex::explorer
