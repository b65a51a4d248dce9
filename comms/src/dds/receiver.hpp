// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/clock.hpp"

#include "dds/security_guard.hpp"
#include "dds/topic_type.hpp"
#include "rtps/datagram_filter.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <span>
#include <utility>

#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

namespace cortex::comms {

// Takes samples from a reader as they arrive. It alone decides whether a callback may still run.
template <class M>
class Receiver final : public eprosima::fastdds::dds::DataReaderListener {
    using SampleInfo = eprosima::fastdds::dds::SampleInfo;
    using DataReader = eprosima::fastdds::dds::DataReader;
    using ReturnCode = eprosima::fastrtps::types::ReturnCode_t;

public:
    Receiver(std::function<void(M&&)> onSample, std::function<void(const Id&)> onDisposed,
             std::atomic<std::uint64_t>& malformed, SecurityGuard* guard)
        : onSample_{std::move(onSample)},
          onDisposed_{std::move(onDisposed)},
          malformed_{malformed},
          guard_{guard} {}

    // Fast DDS holds the lock of the reader here. So our lock is never held while that lock is
    // requested.
    void on_data_available(DataReader* reader) override {
        while (takeOne(*reader)) continue;
    }

    void on_subscription_matched(
        DataReader*, const eprosima::fastdds::dds::SubscriptionMatchedStatus& status) override {
        const rtps::Prefix participant = participantOf(status.last_publication_handle);
        const std::lock_guard lock{matched_};
        if (status.current_count_change > 0) writers_.insert(participant);
        if (status.current_count_change >= 0) return;
        if (const auto known = writers_.find(participant); known != writers_.end()) {
            writers_.erase(known);
            if (writers_.contains(participant)) return;
            std::erase_if(heard_, [&](const auto& each) { return isOf(each.first, participant); });
        }
    }

    // DDS keeps those of participants that are silent for a while. They do not count.
    std::uint32_t writers(const rtps::DatagramFilter& filter) const {
        const std::lock_guard lock{matched_};
        const std::int64_t now = monotonicNow();
        std::uint32_t count = 0;
        for (auto each = writers_.begin(); each != writers_.end();
             each = writers_.upper_bound(*each)) {
            if (!filter.isSilent(*each, now)) ++count;
        }
        return count;
    }

    // Of those, participants of which nothing was taken.
    std::uint32_t unheard(const rtps::DatagramFilter& filter) const {
        const std::lock_guard lock{matched_};
        const std::int64_t now = monotonicNow();
        std::uint32_t count = 0;
        for (auto each = writers_.begin(); each != writers_.end();
             each = writers_.upper_bound(*each)) {
            if (!isHeard(*each) && !filter.isSilent(*each, now)) ++count;
        }
        return count;
    }

    // Whether anything that goes on is heard no more: what somebody forged in its name makes Fast
    // DDS skip it, for as long as this reader exists.
    bool isDeaf(const rtps::DatagramFilter& filter) const {
        constexpr std::int64_t silence = 3'000'000'000;  // ns
        const std::lock_guard lock{matched_};
        const std::int64_t now = monotonicNow();
        return std::ranges::any_of(heard_, [&](const auto& each) {
            return now - each.second >= silence && filter.skips(each.first, now);
        });
    }

    void close() {
        const std::lock_guard lock{mutex_};
        closed_ = true;
    }

private:
    bool takeOne(DataReader& reader) {
        bool taken = false;
        try {
            SampleInfo info;
            taken = reader.take_next_sample(&envelope_, &info) == ReturnCode::RETCODE_OK;
            if (taken) deliver(envelope_, info);
        } catch (...) {
            ++malformed_;
        }
        return taken;
    }

    void deliver(Envelope<M>& envelope, const SampleInfo& info) {
        const std::lock_guard lock{mutex_};
        if (closed_) return;
        if (!info.valid_data) {
            disposed(info);
        } else if (envelope.wellFormed) {
            const M& sample = envelope.incoming;
            if (guard_ && !guard_->admits(info.publication_handle, claimedName(sample))) return;
            onSample_(std::move(envelope.incoming));
            hear(info);
        } else {
            ++malformed_;
        }
    }

    // After it was passed on: whoever counts it as heard finds its sample.
    void hear(const SampleInfo& info) {
        const rtps::WriterGuid writer = guidOf(info.publication_handle);
        const std::lock_guard lock{matched_};
        heard_[writer] = monotonicNow();
    }

    static rtps::WriterGuid guidOf(const eprosima::fastrtps::rtps::InstanceHandle_t& writer) {
        const auto guid = eprosima::fastrtps::rtps::iHandle2GUID(writer);
        rtps::WriterGuid all;
        const auto entity = std::ranges::copy(guid.guidPrefix.value, all.begin()).out;
        std::ranges::copy(guid.entityId.value, entity);
        return all;
    }
    static rtps::Prefix participantOf(const eprosima::fastrtps::rtps::InstanceHandle_t& writer) {
        rtps::Prefix participant;
        std::copy_n(guidOf(writer).begin(), participant.size(), participant.begin());
        return participant;
    }
    static bool isOf(const rtps::WriterGuid& writer, const rtps::Prefix& participant) {
        return std::ranges::equal(std::span{writer}.first(participant.size()), participant);
    }
    bool isHeard(const rtps::Prefix& participant) const {
        rtps::WriterGuid first{};
        std::ranges::copy(participant, first.begin());
        const auto found = heard_.lower_bound(first);
        return found != heard_.end() && isOf(found->first, participant);
    }

    void disposed(const SampleInfo& info) {
        if (!onDisposed_ ||
            info.instance_state == eprosima::fastdds::dds::NOT_ALIVE_NO_WRITERS_INSTANCE_STATE)
            return;
        Id key;
        for (std::size_t i = 0; i < key.size(); ++i) key[i] = info.instance_handle.value[i];
        if (guard_ && !guard_->admits(info.publication_handle, key)) return;
        onDisposed_(key);
    }

    const std::function<void(M&&)> onSample_;
    const std::function<void(const Id&)> onDisposed_;
    std::atomic<std::uint64_t>& malformed_;
    SecurityGuard* const guard_;
    Envelope<M> envelope_;  // keeps the memory that a callback leaves in it
    std::mutex mutex_;
    bool closed_ = false;
    mutable std::mutex matched_;  // of its own: DDS has its locks where it reports a match
    // By their participants; and those that were heard, with the time. `matched_` guards both.
    std::multiset<rtps::Prefix> writers_;
    std::map<rtps::WriterGuid, std::int64_t> heard_;
};

}  // namespace cortex::comms
