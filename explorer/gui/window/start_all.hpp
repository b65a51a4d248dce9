// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/session.hpp"
#include "window/order.hpp"

#include <QElapsedTimer>
#include <QObject>
#include <QPointer>
#include <string>
#include <vector>

namespace cortex::gui {

class Question;

// Starts everything at and below a path. That needs control, so control is asked for first; nothing
// starts if it is not given within a quarter of a minute.
class StartAll : public QObject {
    Q_OBJECT
public:
    explicit StartAll(Session& session, QObject* parent = nullptr);

    void begin(const std::string& prefix, const std::string& agent = {});  // of all, or of one
    // Everything: where all of it is controlled, the person is asked in this window first.
    void ask(QWidget& window);
    void forget();  // what waits, and what became of it
    void refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes);
    QString text() const;

Q_SIGNALS:
    void begun();
    void controlWanted(const std::string& prefix);

private:
    static std::string permittedPart(const Frame& frame, const std::string& prefix);
    bool holds(const Frame& frame, const std::string& prefix) const;

    Session& session_;
    Order order_;
    std::string waits_;  // for control of this path; empty: for nothing
    std::string agent_;  // empty: of all
    QElapsedTimer waiting_;
    QPointer<Question> question_;
};

}  // namespace cortex::gui
