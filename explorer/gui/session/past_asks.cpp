// SPDX-License-Identifier: Apache-2.0
#include "session/past_asks.hpp"

#include "session/session.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace cortex::gui {

void PastAsks::ask(const PastAsk& ask) {
    asked_.emplace(mirror_.askPast(ask.agent, ask.from, ask.until), ask.number);
}

std::vector<PastAnswer> PastAsks::step(Moment now) {
    constexpr std::chrono::seconds patienceWithEvents{1};
    if (came_.empty()) since_ = now;
    for (auto each = asked_.begin(); each != asked_.end();) {
        PastAnswer answer{each->second, {}};
        if (!mirror_.pollPast(each->first, answer.past)) {
            ++each;
            continue;
        }
        came_.push_back(std::move(answer));
        each = asked_.erase(each);
    }
    if (came_.empty()) return {};
    const bool waits = !mirror_.eventsComplete() && now - since_ < patienceWithEvents;
    return waits ? std::vector<PastAnswer>{} : std::exchange(came_, {});
}

std::uint64_t Session::askPast(std::string agent, std::int64_t from, std::int64_t until) {
    const std::lock_guard lock{mutex_};
    pastAsks_.push_back({++lastNumber_, std::move(agent), from, until});
    return lastNumber_;
}

std::vector<PastAnswer> Session::takePast() {
    const std::lock_guard lock{mutex_};
    return std::exchange(pastAnswers_, {});
}

void Session::keepPast() {
    std::vector<PastAsk> asks;
    {
        const std::lock_guard lock{mutex_};
        asks = std::exchange(pastAsks_, {});
    }
    std::vector<PastAnswer> answers;
    for (const PastAsk& each : asks) {
        if (past_) {
            past_->ask(each);
            continue;
        }
        PastAnswer& answer = answers.emplace_back();
        answer.number = each.number;
        answer.past.agent = each.agent;
        answer.past.trouble = "no domain is joined";
    }
    if (past_) answers = past_->step(std::chrono::steady_clock::now());
    const std::lock_guard lock{mutex_};
    std::ranges::move(answers, std::back_inserter(pastAnswers_));
}

}  // namespace cortex::gui
