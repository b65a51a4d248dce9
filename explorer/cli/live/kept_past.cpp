// SPDX-License-Identifier: Apache-2.0
#include "live/kept_past.hpp"

#include "cortex/core/path.hpp"

#include "common/utc_text.hpp"
#include "text/interrupts.hpp"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <iterator>
#include <thread>
#include <utility>

#include <unistd.h>

namespace cortex::cli {
namespace {

constexpr std::chrono::milliseconds betweenPolls{2};
// At least: one that is silent must not cost what the others say.
constexpr std::chrono::milliseconds timeForEachAsk{500};

// On a terminal, after a second: who has not answered yet. It is gone at the end.
class AskingLine {
public:
    AskingLine() = default;
    ~AskingLine() {
        if (!shown_.empty()) std::cerr << "\r\033[K" << std::flush;
    }
    AskingLine(const AskingLine&) = delete;
    AskingLine& operator=(const AskingLine&) = delete;

    void look(const std::map<std::uint64_t, std::string>& waiting) {
        constexpr std::chrono::seconds silent{1};
        constexpr std::size_t widest = 78;
        if (!onTerminal_ || waiting.empty() || Clock::now() - begun_ < silent) return;
        std::vector<std::string> agents;
        for (const auto& [number, agent] : waiting) agents.push_back(agent);
        const std::string line = clipped(printable("asking " + joined(agents)), widest);
        if (line == shown_) return;
        shown_ = line;
        std::cerr << "\r\033[K" << line << std::flush;
    }

private:
    using Clock = std::chrono::steady_clock;

    Clock::time_point begun_ = Clock::now();
    bool onTerminal_ = isatty(STDERR_FILENO) == 1;
    std::string shown_;
};

// Asks that are on their way; their end gives up those that are not answered.
class AsksOfPast {
public:
    explicit AsksOfPast(comms::Mirror& mirror) : mirror_{mirror} {}
    ~AsksOfPast() {
        for (const auto& [number, agent] : waiting_) (void)mirror_.abandonPast(number);
    }
    AsksOfPast(const AsksOfPast&) = delete;
    AsksOfPast& operator=(const AsksOfPast&) = delete;

    void ask(const std::string& agent, std::int64_t from, std::int64_t until) {
        waiting_.emplace(mirror_.askPast(agent, from, until), agent);
    }
    std::vector<comms::PastEvents> answers(Live& live) {
        const auto least = std::chrono::steady_clock::now() + timeForEachAsk;
        std::vector<comms::PastEvents> all;
        AskingLine line;
        while (!waiting_.empty()) {
            throwIfInterrupted();
            line.look(waiting_);
            std::erase_if(waiting_, [&](const auto& each) {
                comms::PastEvents past;
                if (!mirror_.pollPast(each.first, past)) return false;
                all.push_back(std::move(past));
                return true;
            });
            const bool late = std::chrono::steady_clock::now() > least;
            if (late && live.isLimited() && live.over()) break;
            if (!waiting_.empty()) std::this_thread::sleep_for(betweenPolls);
        }
        for (const auto& [number, agent] : waiting_) {
            comms::PastEvents late = mirror_.abandonPast(number);
            late.agent = agent;
            late.trouble = "not all that it keeps came within " + live.limitText() +
                           "; wait longer (--timeout)";
            all.push_back(std::move(late));
        }
        waiting_.clear();
        return all;
    }

private:
    comms::Mirror& mirror_;
    std::map<std::uint64_t, std::string> waiting_;  // agents, by the number of the ask
};

}  // namespace

common::AgentEvents arrived(Live& live, Arrivals& arrivals) {
    common::AgentEvents events;
    for (;;) {
        const auto quiet = std::min(live.left(), std::chrono::milliseconds{300});
        throwIfInterrupted();
        const auto more = arrivals.take(quiet);
        events.insert(events.end(), more.begin(), more.end());
        if (live.over()) break;
        if (more.empty() && live.mirror().eventsComplete()) break;
    }
    return events;
}

// Also one whose model has not come.
bool KeptPast::concerns(const std::string& agent, const std::string& prefix) const {
    const auto structure = live_.mirror().structure(agent);
    return !structure || isAtOrBelow("/" + agent, prefix) ||
           std::ranges::any_of(structure->simplexes, [&](const SimplexInfo& each) {
               return isAtOrBelow(each.path, prefix);
           });
}

common::AgentEvents KeptPast::ask(const std::string& prefix, std::int64_t from,
                                  std::int64_t until) {
    AsksOfPast asks{live_.mirror()};
    for (const comms::AgentStatus& each : live_.mirror().agents()) {
        if (!troubles_.contains(each.name) && concerns(each.name, prefix))
            asks.ask(each.name, from, until);
    }
    common::AgentEvents events;
    for (comms::PastEvents& each : asks.answers(live_)) {
        std::ranges::move(each.events, std::back_inserter(events));
        if (!each.since.empty()) since_[each.agent] = std::move(each.since);
        if (!each.trouble.empty()) troubles_[each.agent] = std::move(each.trouble);
    }
    return events;
}

void KeptPast::printNotes(std::int64_t from, const std::vector<std::string>& kinds) const {
    const auto note = [](const std::string& text) {
        std::cerr << "cortex: " << printable(text) << '\n';
    };
    for (auto [agent, since] : since_) {
        std::erase_if(since, [&](const comms::PastEvents::Since& each) {
            return !kinds.empty() && std::ranges::count(kinds, each.kind) == 0;
        });
        const std::string text =
            common::keptText(std::move(since), from, live_.statusOf(agent).epoch,
                             [](std::int64_t time) { return common::utcText(time); });
        if (!text.empty()) note(agent + ": " + text);
    }
    for (const auto& [agent, trouble] : troubles_) note(agent + ": " + trouble);
    if (const std::string lacking = live_.incomplete(); !lacking.empty()) note(lacking);
}

}  // namespace cortex::cli
