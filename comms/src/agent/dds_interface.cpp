// SPDX-License-Identifier: Apache-2.0
#include "cortex/comms/dds_interface.hpp"

#include "agent/agent_thread.hpp"

#include <optional>
#include <utility>

namespace cortex::comms {

struct DdsInterface::Implementation {
    NetworkOptions options;
    std::optional<AgentThread> thread;
};

DdsInterface::DdsInterface(NetworkOptions options)
    : implementation_{std::make_unique<Implementation>()} {
    implementation_->options = std::move(options);
}

DdsInterface::~DdsInterface() = default;

void DdsInterface::announce(const AgentAccess& agent) {
    implementation_->thread.emplace(agent, implementation_->options);
}

void DdsInterface::read(Inbox& inbox) { implementation_->thread->read(inbox); }

void DdsInterface::write(std::int64_t, Outbox& outbox) { implementation_->thread->write(outbox); }

void DdsInterface::close() { implementation_->thread.reset(); }

std::uint64_t DdsInterface::rejected() const {
    return implementation_->thread ? implementation_->thread->rejected() : 0;
}

std::map<std::string, std::uint64_t> DdsInterface::rejections() const {
    return implementation_->thread ? implementation_->thread->rejections()
                                   : std::map<std::string, std::uint64_t>{};
}

bool DdsInterface::isSecond() const {
    return implementation_->thread && implementation_->thread->isSecond();
}

std::uint64_t DdsInterface::lost() const {
    return implementation_->thread ? implementation_->thread->lost() : 0;
}

std::string DdsInterface::lastRejection() const {
    return implementation_->thread ? implementation_->thread->lastRejection() : std::string{};
}

}  // namespace cortex::comms
