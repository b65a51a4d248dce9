// SPDX-License-Identifier: Apache-2.0
#include "window/start_again.hpp"

#include "cortex/core/path.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace cortex::gui {

namespace {

constexpr int longestAsking = 15'000;  // ms

// The last one that is known, also of an agent that is silent.
std::optional<State> lastStateOf(const Frame& frame, const SimplexOf& simplex) {
    const auto agent = std::ranges::find(frame.agents, simplex.agent,
                                         [](const AgentFrame& each) { return each.status.name; });
    if (agent == frame.agents.end() || !agent->structure) return std::nullopt;
    return agent->lastState(agent->structure->find(simplex.path));
}

bool isSilent(const Frame& frame, const std::string& agent) {
    return std::ranges::none_of(frame.agents, [&](const AgentFrame& each) {
        return each.status.name == agent && !each.lost();
    });
}

// The longest path at or below which both are.
std::string around(std::string one, const std::string& other) {
    while (one.size() > 1 && !isAtOrBelow(other, one)) {
        const std::size_t slash = one.rfind('/');
        one.resize(slash == std::string::npos ? 0 : slash);
        if (one.empty()) one = "/";
    }
    return one;
}

}  // namespace

StartAgain::StartAgain(Session& session, QObject* parent)
    : QObject{parent}, session_{session}, start_{session} {}

// A Stop that finds nothing at work takes nothing away: F12 may be pressed twice.
void StartAgain::note(const std::vector<SimplexOf>& worked) {
    forget();
    stops_ = true;
    if (worked.empty()) return;
    if (closed_) stopped_.clear();
    closed_ = false;
    stopped_.insert(stopped_.end(), worked.begin(), worked.end());
    std::ranges::sort(stopped_);
    const auto twice = std::ranges::unique(stopped_);
    stopped_.erase(twice.begin(), twice.end());
}

void StartAgain::begin() {
    if (!whyNot().isEmpty()) return;
    Q_EMIT begun();
    forget();
    closed_ = false;
    waits_ = true;
    waiting_.start();
    const auto frame = session_.frame();
    if (!isControlled(*frame)) Q_EMIT controlWanted(neededPrefix(*frame));
}

void StartAgain::forget() {
    waits_ = false;
    refused_.clear();
    start_.forget();
}

void StartAgain::decline() { waits_ = false; }

void StartAgain::close() {
    refused_.clear();
    if (!stops_ && !waits_ && !start_.isActive()) closed_ = true;
}

void StartAgain::refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes,
                         bool stops) {
    stops_ = stops;
    start_.refresh(frame, outcomes);
    if (waits_ && isControlled(frame)) {
        waits_ = false;
        start_.begin(stopped_, frame);
    } else if (waits_ && waiting_.hasExpired(longestAsking)) {
        waits_ = false;
        refused_ = tr("Control was not taken: nothing was started again.");
    }
    if (!stops_ && !waits_ && !start_.isActive()) tidy(frame);
}

// Whoever is Active again is not started once more when somebody shuts it down later.
void StartAgain::tidy(const Frame& frame) {
    std::erase_if(stopped_, [&](const SimplexOf& each) {
        return !isSilent(frame, each.agent) && lastStateOf(frame, each) == State::Active;
    });
    left_ = static_cast<int>(std::ranges::count_if(stopped_, [&](const SimplexOf& each) {
        return lastStateOf(frame, each) == State::Standby;
    }));
    if (left_ == 0) refused_.clear();
}

QString StartAgain::text() const {
    if (waits_) return tr("Starting %1 again: needs control").arg(stopped_.size());
    return refused_.isEmpty() ? start_.text() : refused_;
}

QString StartAgain::leftText() const {
    if (closed_ || !whyNot().isEmpty()) return {};
    return left_ == 1 ? tr("One that Stop stopped is in Standby.")
                      : tr("%1 that Stop stopped are in Standby.").arg(left_);
}

QString StartAgain::offer() const {
    if (!whyNot().isEmpty()) return {};
    return left_ == 1 ? tr("Start it again") : tr("Start these %1 again").arg(left_);
}

QString StartAgain::whyNot() const {
    if (stops_) return tr("Stop is under way");
    if (waits_ || start_.isActive()) return tr("it is under way");
    if (stopped_.empty()) return tr("nothing was stopped");
    return left_ == 0 ? tr("nothing of it is in Standby") : QString{};
}

bool StartAgain::toBeStarted(const Frame& frame, const SimplexOf& simplex) {
    return !isSilent(frame, simplex.agent) && lastStateOf(frame, simplex) == State::Standby;
}

bool StartAgain::isControlled(const Frame& frame) const {
    return std::ranges::all_of(stopped_, [&](const SimplexOf& each) {
        return !toBeStarted(frame, each) || frame.control.covers(each.agent, each.path);
    });
}

// The narrowest one, or one that is held already, though not of all agents.
std::string StartAgain::neededPrefix(const Frame& frame) const {
    std::string prefix;
    for (const SimplexOf& each : stopped_) {
        if (!toBeStarted(frame, each)) continue;
        prefix = prefix.empty() ? each.path : around(std::move(prefix), each.path);
    }
    for (const std::string& held : frame.control.prefixes())
        if (isAtOrBelow(prefix, held)) return held;
    return prefix;
}

}  // namespace cortex::gui
