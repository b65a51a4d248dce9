// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "motion/motion_axis.hpp"

#include <QWidget>
#include <deque>
#include <vector>

class QLabel;
class QVBoxLayout;

namespace cortex::explorer {

class SmallPlot;

// The last ten seconds of one axis: position and demand, and velocity. It remembers those of all
// axes, so that another one that is chosen has a past.
class AxisPlots : public QWidget {
    Q_OBJECT
public:
    explicit AxisPlots(QWidget* parent = nullptr);

    void forget(std::size_t axes);
    void add(const std::vector<MotionAxis>& axes, double seconds);
    double length() const;  // s, of what it remembers
    void show(const MotionAxis& axis, std::size_t index, const ShownNumber& position,
              const ShownNumber& velocity);

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    struct Moment {
        double seconds = 0;
        std::optional<double> position, wished, velocity;
    };
    void begin(const MotionAxis& axis, const ShownNumber& position, const ShownNumber& velocity);
    void put(const Moment& moment, const ShownNumber& position, const ShownNumber& velocity);
    void entitle();

    std::vector<std::deque<Moment>> past_;
    QLabel* title_;
    QVBoxLayout* rows_;
    SmallPlot *position_ = nullptr, *velocity_ = nullptr;
    std::size_t shown_ = 0;
    QString unit_, name_;
};

}  // namespace cortex::explorer
