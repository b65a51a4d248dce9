// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/shown_units.hpp"
#include "record/recorded_item.hpp"
#include "session/frame.hpp"

#include <QColor>
#include <QPen>
#include <QString>
#include <QStringList>
#include <QVector>
#include <vector>

namespace cortex::gui {

// One line of a plot, or one lane of words.
struct PlotLine {
    RecordedItem item;  // without an agent until it is known who has it
    DataItem model;     // as its type states it, once that is known
    DataItem data;      // the same in the unit in which it is shown
    double factor = 1;  // from a recorded number to the shown one
    bool known = false;
    bool demand = false;  // it is what is wished
    bool lane = false;    // labels, truths and texts are words
    int tag = 1;          // its number on the screen
    int colour = 0;       // in the order of the series
    int panel = -1;       // none: not known, or a lane
    int wish = -1;        // the panel that it is to have once it is known; none: that of its unit
    bool right = false;   // the axis of its unit is the right one

    QString name() const;  // "/arm/lbr/axes/4.position"
    QString itemName() const;
    QString unit() const;  // in which it is shown
    // Colour, and dashes where colours come again or it is a demand.
    QPen pen(double width) const;
    bool operator==(const PlotLine&) const = default;
};

// What an axis is called: the names of its lines, and their unit.
class AxisTitle {
public:
    void add(const PlotLine& line);
    QString text() const;  // "position (rad)"; empty: no line has it

private:
    QStringList names_;
    QString unit_;
};

// The lines of one plot, each in the panel of its unit.
class PlotLines {
public:
    static constexpr int mostPanels = 8;

    const std::vector<PlotLine>& all() const { return lines_; }
    int panels() const;
    bool add(const RecordedItem& item, int panel = -1);  // false: it is there already
    bool remove(int tag);
    // Makes room for a panel before this one. False: there are too many.
    bool open(int panel);
    // To another panel, or a new one before it; one behind the last is new. False: two other units
    // are there, or it is there already.
    bool move(int tag, int panel, bool anew = false);
    QString titleOf(
        int panel) const;  // "position (rad)"; of two units: "position (rad), force (N)"
    // Learns what agents say of lines that are not known. True: something was learnt.
    bool learn(const Frame& frame);
    std::vector<RecordedItem> recorded() const;  // of those that are known
    const PlotLine* find(int tag) const;
    // Shows numbers in these. A line that has another unit than its axis then goes to another one.
    void setUnits(const ShownUnits& units);
    const ShownUnits& units() const { return units_; }

private:
    void place(PlotLine& line, int wish = -1);
    bool mayBeRight(const PlotLine& line, int panel) const;
    bool fits(const PlotLine& line, int panel, bool right) const;
    void convert(PlotLine& line) const;
    void closeUp();  // panels without lines

    ShownUnits units_;
    std::vector<PlotLine> lines_;
};

}  // namespace cortex::gui
