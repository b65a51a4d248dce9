// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/session.hpp"
#include "window/stop_order.hpp"

#include <QAbstractButton>
#include <QElapsedTimer>
#include <string>
#include <vector>

namespace cortex::explorer {

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
    QSize sizeHint() const override;

Q_SIGNALS:
    void told(const QString& progress);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

private:
    void pressedByKey();
    QString scopeWord() const;  // "all", "/arm"
    void showScope();
    void stop();
    void tell();

    StopOrder order_;
    QString told_;
    QElapsedTimer armed_;      // since F12
    std::string prefix_{"/"};  // at and below which it stops
    bool inControl_ = false;
};

}  // namespace cortex::explorer
