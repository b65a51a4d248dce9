// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drive/axis_numbers.hpp"
#include "drive/axis_reasons.hpp"

#include <QWidget>

class QBoxLayout;
class QGridLayout;
class QLabel;
class QPushButton;

namespace cortex::explorer {

class ActionRow;
class Choices;
class HomingRow;
class PathButton;
class Sentence;
class StateDiagram;
class WordTable;

// How a band shows an axis, beside the axis itself.
struct BandLook {
    AxisReasons reasons{};
    Homing homing{};
    bool homes = false;     // it is this axis that is being homed
    QString whyNoCancel{};  // of that; empty: it can be cancelled
    std::array<ShownNumber, 3> shown{};
};

// One axis of a processor: its states, what can be asked for, and both words bit by bit. Its three
// parts stand side by side, or below each other, as there is room.
class AxisBand : public QWidget {
    Q_OBJECT
public:
    // `processor`: where orders go. `modes`: those that can be chosen, by number.
    AxisBand(const DriveAxis& axis, std::string processor, const std::vector<int>& modes,
             QWidget* parent = nullptr);

    void show(const DriveAxis& axis, const BandLook& look);
    void say(const QString& outcome);  // of an order
    int widthOfAll() const;            // with its parts side by side
    void arrange(int width);           // for so much room

    StateDiagram& diagram() const { return *diagram_; }
    ActionRow& actions() const { return *actions_; }
    Choices& modes() const { return *modes_; }
    HomingRow& homing() const { return *homing_; }

Q_SIGNALS:
    void ordered(const cortex::explorer::Order& order, const QString& title);
    void opened(const QString& path);

protected:
    void paintEvent(QPaintEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    QWidget* makeHead(const DriveAxis& axis);
    QWidget* makeControls(const std::vector<int>& modes);
    void layOut();
    void connectParts();
    void placeAnswer();
    void dress();
    void showState(const DriveAxis& axis, const BandLook& look);
    void showModes(const DriveAxis& axis, const BandLook& look);
    void showWords(const DriveAxis& axis, const BandLook& look);
    void order(const char* command, Arguments arguments, const QString& title);

    std::string processor_;
    DriveAxis axis_;
    QWidget* head_;
    QWidget *left_, *middle_, *right_;
    QWidget* stateBox_;  // with the counts, which give way to a long state
    QGridLayout* grid_;
    QBoxLayout *headRow_, *middleRows_, *rightRows_;
    int columns_ = 0;

    QLabel* title_;
    StateDiagram* diagram_;
    Sentence* next_;  // what can be asked for
    Sentence *state_, *counts_, *mode_, *why_, *told_;
    ActionRow* actions_;
    Choices* modes_;
    HomingRow* homing_;
    WordTable* words_;
    AxisNumbers* numbers_;
};

}  // namespace cortex::explorer
