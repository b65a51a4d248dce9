// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QWidget>

class QPushButton;

namespace cortex::gui {

class PlotRange;
class TextLabel;

// What is done to a whole plot, and whether it follows.
class PlotBar : public QWidget {
    Q_OBJECT
public:
    explicit PlotBar(QWidget* parent = nullptr);

    // What of it is shown, and whether it follows.
    struct Shown {
        bool cursors = false, statistics = false, legend = true;
    };
    void show(const PlotRange& range, const Shown& shown);
    void say(const QString& notice);  // what is not as it should be; empty: nothing

Q_SIGNALS:
    void followWanted();
    void holdWanted();
    void spanWanted(double seconds);
    void cursorsWanted();
    void statisticsWanted();
    void legendWanted();                     // or no longer
    void exportWanted(const QString& kind);  // "csv", "png", "svg"

private:
    QPushButton *follow_, *hold_, *span_, *cursors_, *statistics_, *legend_;
    TextLabel *held_, *notice_;
};

}  // namespace cortex::gui
