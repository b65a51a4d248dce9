// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "window/start_again.hpp"
#include "window/start_all.hpp"

#include <QObject>
#include <QString>
#include <vector>

namespace cortex::gui {

class ControlBar;
class StopButton;

// Whatever stops or starts more than one simplex: each new one ends those before, and what became
// of the last one is told in the row below the bar.
class Orders : public QObject {
    Q_OBJECT
public:
    Orders(Session& session, StopButton& stop, ControlBar& control, QObject* parent = nullptr);

    StopButton& stop() { return stop_; }
    StartAll& startAll() { return all_; }
    StartAgain& startAgain() { return again_; }
    void refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes);
    // In the same row, until a person closes it; what became of an order goes before it.
    void say(const QString& text);

private:
    QString told() const;
    void tell();

    StopButton& stop_;
    ControlBar& control_;
    StartAll all_;
    StartAgain again_;
    QString said_;
};

}  // namespace cortex::gui
