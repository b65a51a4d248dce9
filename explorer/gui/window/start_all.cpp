// SPDX-License-Identifier: Apache-2.0
#include "window/start_all.hpp"

#include "cortex/core/path.hpp"

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
    const auto parts = permitted({prefix}, frame->control.rights);
    waits_ = parts.size() == 1 ? parts.front() : prefix;
    agent_ = agent;
    waiting_.start();
    if (!holds(*frame)) Q_EMIT controlWanted(waits_);
}

void StartAll::forget() {
    waits_.clear();
    order_.forget();
}

void StartAll::refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes) {
    order_.refresh(frame, outcomes);
    if (waits_.empty()) return;
    if (holds(frame)) {
        order_.begin({std::exchange(waits_, {})}, {}, agent_);
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

bool StartAll::holds(const Frame& frame) const {
    if (!agent_.empty()) return frame.control.covers(agent_, waits_);
    return std::ranges::any_of(frame.control.prefixes(),
                               [&](const std::string& held) { return isAtOrBelow(waits_, held); });
}

}  // namespace cortex::gui
