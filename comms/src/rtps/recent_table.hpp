// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace cortex::comms::rtps {

// What is known of keys that were met recently. It takes its memory once. A key has eight places,
// so each call is bounded; a new key displaces what was met longest ago. The places depend on
// chance, so nobody outside can choose keys that share them.
template <class Key, class Value>
class RecentTable {
public:
    struct Entry {
        Key key;
        std::int64_t met;  // monotonic time, ns
        Value value;
    };

    // `places` is a multiple of 8.
    explicit RecentTable(std::size_t places) : entries_(places) {}

    Entry* find(const Key& key) {
        for (std::optional<Entry>* place = first(key); place != first(key) + ways; ++place) {
            if (*place && (*place)->key == key) return &**place;
        }
        return nullptr;
    }

    const Entry* find(const Key& key) const { return const_cast<RecentTable*>(this)->find(key); }

    // The place that a new key gets, and what stands there.
    std::optional<Entry>& placeFor(const Key& key) {
        std::optional<Entry>* const begin = first(key);
        return *std::min_element(begin, begin + ways, [](const auto& a, const auto& b) {
            return (a ? a->met : 0) < (b ? b->met : 0);
        });
    }

    // All places, for a count.
    const std::vector<std::optional<Entry>>& places() const { return entries_; }

private:
    static constexpr std::size_t ways = 8;

    std::optional<Entry>* first(const Key& key) {
        std::uint64_t hash = seed_;
        for (const std::uint8_t each : key) hash = (hash ^ each) * 0x9e3779b97f4a7c15u >> 1;
        const std::size_t buckets = entries_.size() / ways;
        return &entries_[(hash ^ hash >> 29) % buckets * ways];
    }

    std::vector<std::optional<Entry>> entries_;
    const std::uint64_t seed_ = std::random_device{}();
};

}  // namespace cortex::comms::rtps
