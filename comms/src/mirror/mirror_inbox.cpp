// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_inbox.hpp"

#include <utility>

namespace cortex::comms {
namespace {

constexpr std::size_t mostSamples = 1'000'000;
constexpr std::size_t mostBlocks = 1'000;  // they are large, and come again or anew

}  // namespace

void MirrorInbox::push(MirrorSample sample) {
    {
        const std::lock_guard lock{mutex_};
        const bool block = std::holds_alternative<StreamBlock>(sample) ||
                           std::holds_alternative<Summary>(sample) ||
                           std::holds_alternative<PastMessage>(sample);
        if (samples_.size() >= mostSamples || (block && blocks_ >= mostBlocks)) {
            ++dropped_;
            return;
        }
        if (block) ++blocks_;
        samples_.push_back(std::move(sample));
    }
    changed_.notify_one();
}

void MirrorInbox::wake() {
    {
        const std::lock_guard lock{mutex_};
        woken_ = true;
    }
    changed_.notify_one();
}

std::vector<MirrorSample> MirrorInbox::take(Moment limit) {
    std::unique_lock lock{mutex_};
    changed_.wait_until(lock, limit, [&] { return woken_ || !samples_.empty(); });
    woken_ = false;
    blocks_ = 0;
    return std::exchange(samples_, {});
}

std::uint64_t MirrorInbox::dropped() const {
    const std::lock_guard lock{mutex_};
    return dropped_;
}

}  // namespace cortex::comms
