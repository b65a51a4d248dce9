// SPDX-License-Identifier: Apache-2.0
#include "timed_interface.hpp"

#include "cortex/core/clock.hpp"

#include <utility>

namespace cortex::profiler {
TimedInterface::TimedInterface(std::unique_ptr<CommunicationInterface> interface)
    : interface_{std::move(interface)} {}

void TimedInterface::record() {
    const std::lock_guard lock{mutex_};
    costs_ = {};
    records_ = true;
}

std::vector<std::int64_t> TimedInterface::take() {
    const std::lock_guard lock{mutex_};
    records_ = false;
    return std::exchange(costs_, {});
}

void TimedInterface::announce(const AgentAccess& agent) {
    if (interface_) interface_->announce(agent);
}

void TimedInterface::read(Inbox& inbox) {
    const std::int64_t begin = monotonicNow();
    if (interface_) interface_->read(inbox);
    reading_ = monotonicNow() - begin;
}

void TimedInterface::write(std::int64_t cycle, Outbox& outbox) {
    const std::int64_t begin = monotonicNow();
    if (interface_) interface_->write(cycle, outbox);
    const std::int64_t end = monotonicNow();
    const std::lock_guard lock{mutex_};
    if (records_) costs_.push_back(reading_ + end - begin);
}

void TimedInterface::close() {
    if (interface_) interface_->close();
}

}  // namespace cortex::profiler
