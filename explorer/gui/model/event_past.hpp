// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/event_model.hpp"
#include "model/past_reach.hpp"
#include "model/state_times.hpp"
#include "session/past.hpp"

#include <QElapsedTimer>
#include <QObject>
#include <QString>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace cortex::gui {

// Puts what agents keep of the past among the events of the window: of the last hour from the
// start, of more when it is asked for. Each agent is asked once, and again when it starts anew or
// is heard again. GUI thread.
class EventPast : public QObject {
    Q_OBJECT
public:
    enum class Back { Hour, Day, All };
    static constexpr std::array choices{Back::Hour, Back::Day, Back::All};
    static QString name(Back back);  // "Last hour"

    EventPast(Session& session, EventModel& events, StateTimes& times);

    Past& past() { return past_; }
    EventModel& events() { return events_; }
    Back back() const { return back_; }
    void ask(Back back);  // of all agents, once more
    void refresh(const Frame& frame);
    bool asking() const;  // not all that was asked for is among the events
    // Whose memory goes how far back, who has none, and until when changes of values are known:
    // agents keep them, and do not tell them by themselves.
    QString reach() const;

private:
    struct Asked {
        PastReach reach;
        std::int64_t epoch = 0;
        std::int64_t when = 0;  // UTC ns, it was asked
        double since = 0;       // s, when it was seen first
        bool waits = true, lost = false;
        std::uint64_t round = 0;  // tells its asks apart
    };
    void ask(const AgentFrame& agent, Asked& asked, std::int64_t now);
    void take(const std::string& agent, std::uint64_t round, comms::PastEvents past);
    std::int64_t from(std::int64_t now) const;
    bool isAsked() const;
    std::int64_t valuesUntil() const;  // UTC ns; 0: nobody has told of values

    Past past_;
    EventModel& events_;
    StateTimes& times_;
    Back back_ = Back::Hour;
    std::map<std::string, Asked> asked_;  // by agent
    std::vector<comms::AgentEvent> came_;
    std::vector<comms::AgentEvent> changes_;  // of states, of which none is missing
    QElapsedTimer merged_;                    // since they were put among the others
    std::uint64_t round_ = 0;
    std::int64_t now_ = 0;  // UTC ns, of the ask that goes back least far
};

}  // namespace cortex::gui
