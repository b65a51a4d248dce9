// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/start_order.hpp"
#include "session/session.hpp"

#include <QElapsedTimer>
#include <QString>
#include <QStringList>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cortex::gui {

// Without those that lie below another one of them.
std::vector<std::string> widest(std::vector<std::string> prefixes);
// What of it lies at and below paths that may be commanded; where nothing does, all of it: agents
// say why they refuse it.
std::vector<std::string> permitted(const std::vector<std::string>& prefixes,
                                   const std::vector<std::string>& rights);
// What of it lies at and below these; it may be nothing.
std::vector<std::string> overlap(const std::vector<std::string>& prefixes,
                                 const std::vector<std::string>& others);
// Agents that are not controlled there, or a part of one.
QStringList leftOut(const Frame& frame, const std::vector<std::string>& prefixes);
// How many of them there a start would ask, of agents that are heard.
int inStandby(const Frame& frame, const std::string& prefix);
QString scopeWord(const std::vector<std::string>& prefixes);   // "all", "/arm", "/arm and 2 more"
QString scopeWords(const std::vector<std::string>& prefixes);  // each of them

// One stop or one start of everything at and below some paths, by a command for each path to every
// agent that has something there. A stop also goes to an agent that is not heard just now: again
// until it answers, for at most ten seconds. An agent does one such command at a time, and a newer
// one ends it: several paths of one agent take turns. A start is sent once, as nothing may start
// long after it was asked for. What signed rights do not cover, or is not held, is left out, and
// that is said. An agent that ended as it should is not told, and nothing of it is missed.
class Order {
public:
    enum Kind { Stop, Start };
    enum class Whom { All, Held };  // Held: of each agent, only what is held of it
    Order(Session& session, Kind kind) : session_{session}, kind_{kind} {}

    // Of all agents, or of one alone.
    void begin(std::vector<std::string> prefixes, Whom whom = Whom::All,
               const std::string& only = {});
    void forget();
    bool isActive() const { return active_; }  // until it is known what followed
    // What was Active or starting up when it began, as far as was known.
    const std::vector<SimplexOf>& worked() const { return worked_; }
    void refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes);
    // "Stopping all: 9 of 14 in Standby", "All 14 of /lift and /drive in Standby, 0.4 s, 12:05:07",
    // "2 did not follow: …", "Not reached: robot". Empty before the first, and once states no
    // longer agree with it.
    const QString& text() const { return text_; }

private:
    struct Told {
        std::string agent, prefix;
        std::uint64_t number = 0;  // of the command that is on its way; 0: none
        bool answered = false, interrupted = false;
        QElapsedTimer sent{};
    };
    using Meant = SimplexOf;
    using State = std::optional<cortex::State>;  // none: it is not known now

    static bool hasMeant(const AgentFrame& agent, const std::vector<std::string>& prefixes);
    void leaveEnded(const Frame& frame);
    void tell(const AgentFrame& agent, const std::string& prefix);
    QString scope() const;  // "all", "/arm", "all of agent robot"
    QString part() const;
    void send(Told& told);
    void sendNext();
    bool mayBeSent(const Told& told) const;
    bool goesOn(const Told& told) const;  // it is sent until it is answered
    void take(const CommandOutcome& outcome);
    void count(const Frame& frame);
    void finish(const Frame& frame);
    std::ptrdiff_t followers(const Frame& frame) const;
    QString notFollowed(const Frame& frame) const;
    QStringList unanswered(const Frame& frame, bool silentOnly) const;
    QString nameOf(const Meant& meant) const;  // with its agent, where several have the path
    State stateOf(const Frame& frame, const Meant& meant) const;
    bool wasReached(const Meant& meant) const;
    bool agrees(const Frame& frame) const;

    Session& session_;
    const Kind kind_;
    std::vector<std::string> prefixes_;  // none below another one
    std::string only_;                   // of this agent; empty: of all
    QString text_;
    bool narrowed_ = false;           // to what may be commanded
    bool active_ = false;             // until it is known what followed
    QElapsedTimer since_, answered_;  // since it began, since the last answer
    QElapsedTimer sinceEnd_;          // since it is known what followed
    std::vector<Told> told_;
    std::vector<Meant> meant_;      // that are to reach Standby, or Active
    std::vector<Meant> worked_;     // of them, when it began
    QStringList refusals_;          // "robot: …"
    QStringList over_;              // agents that have ended
    QStringList left_;              // agents that are left out, as they are not held
    std::map<Meant, State> ended_;  // the states that its result is about
    bool incomplete_ = false;       // its result says so
};

}  // namespace cortex::gui
