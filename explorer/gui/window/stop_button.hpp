// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/session.hpp"
#include "window/order.hpp"

#include <QAbstractButton>
#include <QElapsedTimer>
#include <optional>
#include <string>
#include <vector>

namespace cortex::gui {

// Stops what this window controls, otherwise everything that is known: every agent is told to shut
// down its simplexes there. A click does it at once. F12 does it wherever the focus is, in dialogs,
// menus and fields too: in control at the first press, read-only at the second within a second, as
// an elbow must not stop a plant. It needs no control, asks nothing, and is no emergency stop.
class StopButton : public QAbstractButton {
    Q_OBJECT
public:
    explicit StopButton(Session& session, QWidget* parent = nullptr);

    void refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes);
    const QString& progress() const { return order_.text(); }
    const std::string& scope() const { return prefix_; }
    // Stops this path from now on, whatever is controlled; none: as above.
    void setScope(std::optional<std::string> prefix);
    const std::optional<std::string>& chosenScope() const { return chosen_; }
    void stop(const std::string& prefix);  // this path, once
    QSize sizeHint() const override;

Q_SIGNALS:
    void begun();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

private:
    void pressedByKey();
    void showScope();

    Order order_;
    QElapsedTimer armed_;      // since F12
    std::string prefix_{"/"};  // at and below which it stops
    std::optional<std::string> chosen_;
    bool inControl_ = false;
};

}  // namespace cortex::gui
