// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/explorer/view.hpp"

#include <QObject>
#include <QPointer>
#include <QString>
#include <chrono>
#include <functional>
#include <optional>
#include <string>

namespace cortex::explorer {

// One axis, or one motion of the tip, that is jogged while something is held, and what is said
// about it.
class Jog : public QObject {
    Q_OBJECT
public:
    using Begin = std::function<Hold*(QWidget& held, const HeldOrder& order)>;
    using MakeOrder = std::function<Order(int axis, double velocity)>;  // without a budget

    // `begin`: how the view repeats an order.
    Jog(MakeOrder order, Begin begin, QObject* parent = nullptr);

    // Repeats the order with this velocity until `held` is let go, and sends 0 once then.
    void start(QWidget& held, int axis, double velocity, double holdTime);
    void change(double velocity);
    void end(const QString& why);
    // Whether the controller jogs, from time to time: what it has ended stays ended.
    void see(bool jogging);
    bool runs() const { return hold_ && hold_->runs(); }
    int axis() const { return axis_; }
    int direction() const { return runs() ? (velocity_ > 0 ? 1 : -1) : 0; }
    double velocity() const { return velocity_; }
    double holdTime() const { return holdTime_; }
    // Why the last one ended, for five seconds: "Ended: let go". Empty: it runs, or it is long ago.
    QString said() const;
    void say(const QString& text);  // instead of beginning

private:
    MakeOrder order_;
    Begin begin_;
    QPointer<Hold> hold_;
    int axis_ = 0;
    double velocity_ = 0, holdTime_ = 0;
    bool moved_ = false;
    QString said_;
    std::chrono::steady_clock::time_point since_, started_;
};

}  // namespace cortex::explorer
