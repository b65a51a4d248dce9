// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/session.hpp"

#include <QAbstractButton>
#include <QElapsedTimer>
#include <cstdint>
#include <string>
#include <vector>

namespace cortex::explorer {

// Stops what this window controls, otherwise everything that is heard: every agent is told to shut
// down its simplexes there. A click does it at once. F12 does it wherever the focus is, in dialogs,
// menus and fields too: in control at the first press, read-only at the second within a second, as
// an elbow must not stop a plant. It needs no control, asks nothing, and is no emergency stop.
class StopButton : public QAbstractButton {
    Q_OBJECT
public:
    explicit StopButton(Session& session, QWidget* parent = nullptr);

    void refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes);
    // "Stopping all: 9 of 14 in Standby", "All 14 in Standby, 0.4 s", "2 did not follow: …".
    const QString& progress() const { return progress_; }
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
    void say(const QString& progress);
    void countStates(const Frame& frame);

    Session& session_;
    QElapsedTimer armed_, since_, answered_;  // since F12, since the stop, since the last answer
    std::vector<std::string> stopping_;       // paths that are to reach Standby
    std::vector<std::uint64_t> unanswered_;   // commands
    QStringList refusals_;                    // "robot: …"
    std::string prefix_{"/"};                 // at and below which it stops
    bool inControl_ = false;
    QString stopped_;      // the scope of the stop that is told about
    bool active_ = false;  // until it is known what followed
    QString progress_;
};

}  // namespace cortex::explorer
