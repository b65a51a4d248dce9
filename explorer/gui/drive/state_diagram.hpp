// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drive/diagram_plan.hpp"

#include <QString>
#include <QWidget>
#include <array>

class QPainter;
class QPushButton;

namespace cortex::explorer {

// How a drive is, as far as its diagram shows it.
struct DiagramNow {
    drives::Ds402State state = drives::Ds402State::Unknown;
    bool live = false;  // otherwise the state is the last one that is known
    int quickStopOption = 2;
    // No transition can be asked for, or none that leads to Operation enabled; empty: those of the
    // state can.
    QString whyNot{}, whyNotEnabled{};

    bool operator==(const DiagramNow&) const = default;
};

// The eight states of CiA 402 with the present one filled, and the transitions between them: each
// that can be asked for is a button with its number.
class StateDiagram : public QWidget {
    Q_OBJECT
public:
    explicit StateDiagram(QWidget* parent = nullptr);

    void show(const DiagramNow& now);
    QPushButton& button(int transition) const;
    const DiagramPlan& plan() const { return plan_; }

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

Q_SIGNALS:
    void wanted(int transition);

protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void fit();
    void describe();
    QString whyNoButton(int transition) const;
    int leftEdge() const;
    void paintRoute(QPainter& painter, const DiagramPlan::Route& route) const;
    void paintState(QPainter& painter, drives::Ds402State state) const;

    DiagramPlan plan_;
    DiagramNow now_;
    bool shown_ = false;
    std::array<QPushButton*, 17> buttons_{};  // by number; null: nobody can ask for it
};

}  // namespace cortex::explorer
