// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drive/axis_reasons.hpp"

#include <QWidget>

class QLabel;
class QProgressBar;
class QPushButton;

namespace cortex::explorer {

class Sentence;

// Homing of an axis: its button, how far it is, and its end.
class HomingRow : public QWidget {
    Q_OBJECT
public:
    explicit HomingRow(QWidget* parent = nullptr);

    // `runs`: it is this axis that is being homed. `whyNoCancel`: empty: it can be cancelled.
    void show(const DriveAxis& axis, const Homing& homing, bool runs, const AxisReasons& reasons,
              const QString& whyNoCancel);
    QPushButton& homeButton() const { return *home_; }
    QPushButton& cancelButton() const { return *cancel_; }

Q_SIGNALS:
    void homeWanted();
    void cancelWanted();

protected:
    void changeEvent(QEvent* event) override;

private:
    void dress();

    QPushButton *home_, *cancel_;
    QProgressBar* bar_;
    QLabel* percent_;
    Sentence* note_;
};

}  // namespace cortex::explorer
