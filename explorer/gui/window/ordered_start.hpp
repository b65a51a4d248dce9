// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/start_order.hpp"
#include "session/session.hpp"

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QString>
#include <QStringList>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cortex::gui {

// One start of exactly these simplexes, also of several agents: who relies on another one is asked
// after that is Active. Each is asked once. One that does not start holds back only those that rely
// on it; one that somebody else has started counts as if it had been asked.
class OrderedStart {
    Q_DECLARE_TR_FUNCTIONS(OrderedStart)
public:
    explicit OrderedStart(Session& session) : session_{session} {}

    void begin(const std::vector<SimplexOf>& all, const Frame& frame);
    void forget();
    void refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes);
    bool isActive() const { return active_; }  // until it is known what followed
    // "Starting 9 again: 3 Active", "All 9 Active again, 1.2 s, 12:05:20", "/arm did not start: …".
    // Empty before the first, and once states no longer agree with it, though not in its first ten
    // seconds.
    const QString& text() const { return text_; }

private:
    struct Member {
        SimplexOf simplex;
        StartStep step = StartStep::Waits;
        std::uint64_t number = 0;  // of the command that is on its way; 0: none
        bool ofAgent = false;      // the command is one of its agent
        bool unheard = false;      // its agent
        bool ended = false;        // its agent, as it should
        QElapsedTimer since{};     // it was answered, or seen to start
        QString why{};             // it did not start
    };

    void take(const CommandOutcome& outcome);
    void look(const Frame& frame, Member& member);
    static void lookInStandby(Member& member);
    void ask(const Frame& frame, Member& member);
    bool isTurnOf(const Member& member) const;
    static void fail(Member& member, const QString& why);
    std::vector<StartStep> steps() const;
    std::ptrdiff_t count(StartStep step) const;
    void finish();
    QStringList failures() const;
    QString nameOf(const SimplexOf& simplex) const;  // with its agent, where several have the path
    bool agrees(const Frame& frame) const;

    Session& session_;
    std::vector<Member> members_;
    StartOrder order_;
    bool active_ = false, complete_ = false;
    QElapsedTimer begun_, ended_;
    QString text_;
};

}  // namespace cortex::gui
