// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "motion/motion_axis.hpp"
#include "motion/row_columns.hpp"

#include <QWidget>
#include <array>

class QLabel;
class QLineEdit;
class QPushButton;

namespace cortex::explorer {

// What a row offers: buttons to jog the axis while they are held, a field for its demand, or
// nothing.
enum class RowPart { Jog, Demand, None };

// How a row is shown, beside the axis itself.
struct RowLook {
    ShownNumber position, velocity;
    bool selected = false, focused = false, edited = false;
    bool unitInRow = false;           // not in the titles, as the axes have different ones
    int nameWidth = 0;                // of the longest name
    int held = 0;                     // direction in which it jogs now
    QString whyNot{};                 // it can not be jogged; empty: it can
    std::optional<double> entered{};  // demand as it was entered, otherwise as it was sent
    QString wrong{};                  // with that demand; empty: nothing
};

// One axis of a controller: its range with what is and what is wished, both as numbers, and how its
// drive is.
class AxisRow : public QWidget {
    Q_OBJECT
public:
    AxisRow(const MotionAxis& axis, RowPart part, bool jogs, QWidget* parent = nullptr);

    void setPart(RowPart part);
    void show(const MotionAxis& axis, const RowLook& look);
    QPushButton& button(int direction) const { return *buttons_[direction > 0 ? 1 : 0]; }
    QLineEdit& field() const { return *field_; }
    // The speed that 100 % are of: as the type states it, otherwise as it was entered here.
    std::optional<double> most() const;

Q_SIGNALS:
    void chosen();
    void pressed(int direction, QWidget* button);
    void edited();

protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void addButtons();
    void addSpeedField();
    void place();
    void fit();
    int secondHeight() const;  // of the line of an axis without a stated speed
    void showField(bool otherUnit);
    void describe();
    void paintBar(QPainter& painter, const QRect& box) const;
    void paintCaptions(QPainter& painter, const QRect& box) const;
    void paintNumbers(QPainter& painter, const RowColumns& columns) const;
    void paintDrive(QPainter& painter, const QRect& box) const;
    int mainHeight() const { return units(rowUnits); }

    MotionAxis axis_;
    RowLook look_;
    RowPart part_;
    std::array<QPushButton*, 2> buttons_{};
    QLineEdit* field_;
    QLabel* noSpeed_ = nullptr;  // both only where the type states no speed
    QLineEdit* speedField_ = nullptr;
    std::optional<double> speed_{};  // that was entered there
};

}  // namespace cortex::explorer
