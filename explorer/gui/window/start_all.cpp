// SPDX-License-Identifier: Apache-2.0
#include "window/start_all.hpp"

#include "cortex/core/path.hpp"

#include "session/lease.hpp"
#include "widgets/question.hpp"

#include <algorithm>
#include <utility>

namespace cortex::gui {

namespace {

constexpr int longestQuestion = 15'000;  // ms

}  // namespace

StartAll::StartAll(Session& session, QObject* parent)
    : QObject{parent}, session_{session}, order_{session, Order::Start} {}

// What signed rights do not cover is left out.
void StartAll::begin(const std::string& prefix, const std::string& agent) {
    Q_EMIT begun();
    forget();
    const auto frame = session_.frame();
    waits_ = permittedPart(*frame, prefix);
    agent_ = agent;
    waiting_.start();
    if (!holds(*frame, waits_)) Q_EMIT controlWanted(waits_);
}

// Taking control asks as well.
void StartAll::ask(QWidget& window) {
    const auto frame = session_.frame();
    const std::string prefix = permittedPart(*frame, "/");
    agent_.clear();
    if (!holds(*frame, prefix)) return begin("/");
    const QString title =
        prefix == "/" ? tr("Start everything?") : tr("Start all of %1?").arg(scopeWord({prefix}));
    const QString line = tr("%n simplexes are in Standby.", nullptr, inStandby(*frame, prefix));
    if (question_) question_->close();
    question_ = new Question{{title, {line}, tr("Start all"), tr("Cancel")}, &window};
    connect(question_, &Question::pressed, this, [this] {
        question_->close();
        begin("/");
    });
    question_->openAmid(window);
}

void StartAll::forget() {
    waits_.clear();
    order_.forget();
}

void StartAll::refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes) {
    order_.refresh(frame, outcomes);
    if (waits_.empty()) return;
    if (holds(frame, waits_)) {
        order_.begin({std::exchange(waits_, {})}, Order::Whom::Held, agent_);
    } else if (waiting_.hasExpired(longestQuestion)) {
        waits_.clear();
    }
}

QString StartAll::text() const {
    if (waits_.empty()) return order_.text();
    const QString path = scopeWord({waits_});
    const QString scope =
        agent_.empty() ? path : tr("%1 of agent %2").arg(path, QString::fromStdString(agent_));
    return tr("Starting %1: needs control").arg(scope);
}

std::string StartAll::permittedPart(const Frame& frame, const std::string& prefix) {
    const auto parts = permitted({prefix}, frame.control.rights);
    return parts.size() == 1 ? parts.front() : prefix;
}

bool StartAll::holds(const Frame& frame, const std::string& prefix) const {
    if (!agent_.empty()) return frame.control.covers(agent_, prefix);
    const auto isHeld = [&](const std::string& held) { return isAtOrBelow(prefix, held); };
    if (std::ranges::none_of(frame.control.prefixes(), isHeld)) return false;
    // One that is silent is not started, and cannot be taken.
    return std::ranges::all_of(frame.agents, [&](const AgentFrame& agent) {
        const bool has = prefix == "/" || hasBelow(agent, prefix);
        return !has || agent.lost() || frame.control.covers(agent.status.name, prefix);
    });
}

}  // namespace cortex::gui
