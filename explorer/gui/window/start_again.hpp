// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/session.hpp"
#include "window/ordered_start.hpp"

#include <QElapsedTimer>
#include <QObject>
#include <QString>
#include <string>
#include <vector>

namespace cortex::gui {

// Starts again exactly what Stop stopped. That needs control, which is asked for first; nothing
// starts if it is not given within a quarter of a minute. What was stopped is known until all of it
// is Active again. The next Stop adds to it, unless the user has closed what was said of it.
class StartAgain : public QObject {
    Q_OBJECT
public:
    explicit StartAgain(Session& session, QObject* parent = nullptr);

    void note(const std::vector<SimplexOf>& worked);  // when a Stop begins
    void begin();
    void forget();   // a start that waits or is under way, and what became of it
    void decline();  // control, which it waits for
    void close();    // what was said of what is left
    // `stops`: a Stop is under way.
    void refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes, bool stops);
    QString text() const;      // of the start
    QString leftText() const;  // what is still in Standby, until it was closed
    QString offer() const;     // "Start these 9 again"; empty where there is nothing to start
    QString whyNot() const;    // then
    int left() const { return offer().isEmpty() ? 0 : left_; }  // that can be started
    const std::vector<SimplexOf>& stopped() const { return stopped_; }

Q_SIGNALS:
    void begun();
    void controlWanted(const std::string& prefix);

private:
    static bool toBeStarted(const Frame& frame, const SimplexOf& simplex);
    bool isControlled(const Frame& frame) const;
    std::string neededPrefix(const Frame& frame) const;
    void tidy(const Frame& frame);

    Session& session_;
    OrderedStart start_;
    std::vector<SimplexOf> stopped_;  // sorted, and not Active since
    int left_ = 0;                    // of them in Standby, as far as is known
    bool closed_ = false;             // what was said of it
    bool stops_ = false;
    bool waits_ = false;  // for control
    QElapsedTimer waiting_;
    QString refused_;  // why nothing was started
};

}  // namespace cortex::gui
