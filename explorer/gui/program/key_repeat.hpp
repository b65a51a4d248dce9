// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QKeyEvent>
#include <QObject>
#include <QPointer>
#include <QTimer>
#include <QWindow>
#include <optional>

namespace cortex::gui {

// Tells a key that is held from one that is pressed again. X11 repeats a held key by a release and
// a press of one moment, and Qt marks them only where both have come when it looks at the first.
// A release waits here for its press for a moment; a pair becomes one press that repeats itself.
class KeyRepeat : public QObject {
public:
    explicit KeyRepeat(QObject& application);

protected:
    bool eventFilter(QObject* object, QEvent* event) override;

private:
    bool filterKey(QWindow& window, const QKeyEvent& event);
    void letGo();  // what waits

    QPointer<QWindow> window_;
    std::optional<QKeyEvent> release_;
    QTimer timer_;
    bool sends_ = false;
};

}  // namespace cortex::gui
