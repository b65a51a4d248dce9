// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/session.hpp"
#include "window/order.hpp"

#include <QAbstractButton>
#include <QStringList>
#include <QTimer>
#include <optional>
#include <string>
#include <vector>

namespace cortex::gui {

// Stops exactly what this window controls, at once, otherwise everything that is known. At one
// press only what is held of an agent is stopped, and agents that are not controlled are named.
// What signed rights do not cover is left out, and that is said. What is more than it controls
// takes a second press within three seconds, and the button names it: neither an elbow nor a hand
// that reaches for its own part may stop a plant. F12 presses it wherever the focus is, in dialogs,
// menus and fields too. It needs no control, asks nothing, and is no emergency stop.
class StopButton : public QAbstractButton {
    Q_OBJECT
public:
    explicit StopButton(Session& session, QWidget* parent = nullptr);

    void refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes);
    const QString& progress() const { return order_.text(); }
    void forget() { order_.forget(); }  // what became of it
    const std::vector<std::string>& scope() const { return scope_; }
    // Stops this path from now on, whatever is controlled; none: as above.
    void setScope(std::optional<std::string> prefix);
    const std::optional<std::string>& chosenScope() const { return chosen_; }
    // This path, once, of one agent or of all.
    void stop(const std::string& prefix, const std::string& agent = {});
    bool isStopping() const { return order_.isActive(); }
    const std::vector<SimplexOf>& worked() const { return order_.worked(); }  // when it began
    QSize sizeHint() const override;

Q_SIGNALS:
    void begun();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

private:
    void press();
    void disarm();
    void showScope();
    bool isArmed() const { return armed_.remainingTime() > 0; }
    QString but() const;
    QString whole() const;
    QString saying(const QString& scope) const;
    void paintWords(QPainter& painter) const;
    QStringList twoLines(QFont& font, int room) const;

    Order order_;
    QTimer armed_;                          // after a first press
    std::vector<std::string> scope_{"/"};   // paths, at and below which it stops
    std::vector<std::string> wanted_{"/"};  // the same, if signed rights were no matter
    std::optional<std::string> chosen_;
    QStringList others_;   // agents that have some of it, and are not controlled
    bool isHeld_ = false;  // one press does it
};

}  // namespace cortex::gui
