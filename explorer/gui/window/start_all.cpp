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

void StartAll::begin(const std::string& prefix) {
    forget();
    waits_ = prefix;
    waiting_.start();
    if (!holds(*session_.frame())) Q_EMIT controlWanted(prefix);
}

void StartAll::forget() {
    waits_.clear();
    order_.forget();
}

void StartAll::refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes) {
    order_.refresh(frame, outcomes);
    if (waits_.empty()) return;
    if (holds(frame)) {
        order_.begin({std::exchange(waits_, {})});
    } else if (waiting_.hasExpired(longestQuestion)) {
        waits_.clear();
    }
}

QString StartAll::text() const {
    if (waits_.empty()) return order_.text();
    return tr("Starting %1: needs control").arg(scopeWord({waits_}));
}

bool StartAll::holds(const Frame& frame) const {
    return std::ranges::any_of(frame.control.prefixes(),
                               [&](const std::string& held) { return isAtOrBelow(waits_, held); });
}

}  // namespace cortex::gui
