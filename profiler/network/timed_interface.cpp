// SPDX-License-Identifier: Apache-2.0
#include "timed_interface.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/image_pool.hpp"

#include "statistics.hpp"

#include <utility>

namespace cortex::network {
namespace {

// Hands everything on, and tells of links.
class LinkWatch final : public Inbox {
public:
    LinkWatch(Inbox& inbox, const TimedInterface::OnLink& onLink)
        : inbox_{inbox}, onLink_{onLink} {}

    std::int64_t cycle() const override { return inbox_.cycle(); }
    void link(std::uint32_t simplex, const LinkBinding& binding, const Slice& from,
              std::int64_t age) override {
        onLink_(simplex, from);
        inbox_.link(simplex, binding, from, age);
    }
    void linkConstants(std::uint32_t simplex, const LinkBinding& binding,
                       const Slice& from) override {
        inbox_.linkConstants(simplex, binding, from);
    }
    void linkLost(std::uint32_t simplex) override { inbox_.linkLost(simplex); }
    void command(const OutsideCommand& command) override { inbox_.command(command); }
    void senderLost(const Sender& sender) override { inbox_.senderLost(sender); }
    void event(Severity severity, EventKind kind, std::uint32_t simplex,
               const EventText& text) override {
        inbox_.event(severity, kind, simplex, text);
    }

private:
    Inbox& inbox_;
    const TimedInterface::OnLink& onLink_;
};

}  // namespace

void Waker::announce(const AgentAccess& /*agent*/) {
    thread_ = std::thread{[this] {
        for (std::int64_t seen = 0; seen >= 0; seen = cycle_) cycle_.wait(seen);
    }};
}

void Waker::write(std::int64_t cycle, Outbox& /*outbox*/) {
    cycle_ = cycle;
    cycle_.notify_one();
}

void Waker::close() {
    cycle_ = -1;
    cycle_.notify_one();
    thread_.join();
}

TimedInterface::TimedInterface(std::unique_ptr<CommunicationInterface> interface, OnLink onLink)
    : interface_{std::move(interface)}, onLink_{std::move(onLink)} {}

void TimedInterface::record(ImagePool& pool) {
    const std::lock_guard lock{mutex_};
    costs_ = {};
    pool_ = &pool;
}

Costs TimedInterface::take() {
    const std::lock_guard lock{mutex_};
    pool_ = nullptr;
    return std::exchange(costs_, {});
}

void TimedInterface::announce(const AgentAccess& agent) {
    announced_ = steadyNow();
    if (interface_) interface_->announce(agent);
}

void TimedInterface::read(Inbox& inbox) {
    const std::int64_t begin = steadyNow();
    if (interface_ && onLink_) {
        LinkWatch watch{inbox, onLink_};
        interface_->read(watch);
    } else if (interface_) {
        interface_->read(inbox);
    }
    reading_ = steadyNow() - begin;
}

void TimedInterface::write(std::int64_t cycle, Outbox& outbox) {
    const std::int64_t begin = steadyNow();
    if (interface_) interface_->write(cycle, outbox);
    const std::int64_t end = steadyNow();
    const std::lock_guard lock{mutex_};
    if (!pool_) return;
    costs_.readAndWrite.push_back(reading_ + end - begin);
    const std::int64_t copying = steadyNow();
    pool_->publish(cycle, 0, 0);
    costs_.image.push_back(steadyNow() - copying);
}

void TimedInterface::close() {
    if (interface_) interface_->close();
}

}  // namespace cortex::network
