// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "motion/axis_row.hpp"

#include <QWidget>
#include <vector>

class QVBoxLayout;

namespace cortex::explorer {

// The axes of a controller, a row each. One place for the keyboard: ↑ ↓ choose the axis, ← → jog it
// while they are held.
class AxisRows : public QWidget {
    Q_OBJECT
public:
    explicit AxisRows(QWidget* parent = nullptr);

    void make(const std::vector<MotionAxis>& axes, RowPart part, bool jogs);
    void setPart(RowPart part);
    int count() const { return static_cast<int>(rows_.size()); }
    AxisRow& row(int axis) const { return *rows_[static_cast<std::size_t>(axis)]; }
    int selected() const { return selected_; }
    void select(int axis);
    int nameWidth() const;  // of the longest name
    void setTitles(const QString& value, const QString& target, const QString& act);

Q_SIGNALS:
    void chosen(int axis);
    void pressed(int axis, int direction, QWidget* held);  // of a button, or of a key
    void edited(int axis);

protected:
    void paintEvent(QPaintEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void fit();
    void describe();

    QVBoxLayout* layout_;
    std::vector<AxisRow*> rows_;
    RowPart part_ = RowPart::Jog;
    int selected_ = 0;
    QString value_, target_, act_;
};

}  // namespace cortex::explorer
