// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"
#include "cortex/core/tables.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cortex::cs {

// What limiting one modification found, for the caller to report.
struct LimitResult {
    const DataItem* item = nullptr;  // first item concerned; null: nothing
    double value = 0;                // what was written
    double limit = 0;                // what it became
    bool notFinite = false;
    bool faults = false;  // onLimit="fault"
    bool isNew = false;   // the first cycle of an episode
};

// The last step before a modification is read or sent: not finite, out of range, too fast.
// One per modification that has a writer; used by the task that ran last among its writers.
class DemandLimits {
public:
    DemandLimits(const TypeLayout& layout, const Slice& live, std::uint32_t simplex);

    std::uint32_t simplex() const { return simplex_; }
    LimitResult apply(double elapsedSeconds) CORTEX_REALTIME;
    // The value of an item as it last left apply(); null for items outside the cyclic table.
    const std::byte* previous(const DataItem& item) const;
    void setPrevious() CORTEX_REALTIME;  // takes the present values as the last ones
    void restorePrevious() CORTEX_REALTIME;
    std::uint64_t count() const { return count_; }

private:
    struct Item {
        const DataItem* item;
        std::byte* live;
        std::byte* previous;
        std::uint32_t size;  // octets
        double min, max, rate;
        bool limited, inEpisode;
    };
    bool applyFloat(Item& item, double elapsed, LimitResult& result) CORTEX_REALTIME;
    bool applyInt(Item& item, LimitResult& result) CORTEX_REALTIME;

    std::uint32_t simplex_;
    std::vector<Item> items_;
    std::vector<std::byte> memory_;
    std::uint64_t count_ = 0;
};

// The safe values that one writer gives one modification, written by the framework whenever the
// writer is not Active.
class SafeDemands {
public:
    // `counterpart`: slice of the simplex that observes what is demanded, and its layout; null if
    // the rule names none.
    SafeDemands(const TypeLayout& layout, const Slice& out, const DemandLimits& limits,
                const TypeLayout* observedLayout, const Slice& observed);

    // On leaving Active and on startup: `observed` takes the observation, `hold` the last demand.
    // An observation that is bad or lost cannot be taken; then the last demand stands in.
    void latch() CORTEX_REALTIME;
    void write() CORTEX_REALTIME;
    // Whether an `observed` item may be latched: its observation is good.
    bool observationIsGood() const CORTEX_REALTIME;
    bool observes() const { return observedState_ != nullptr; }

private:
    struct Item {
        std::byte* out;
        std::byte* safe;
        const std::byte* previous;
        const std::byte* observed;  // null: not observed
        std::uint32_t size;
        bool given;
    };
    std::vector<Item> items_;
    std::vector<std::byte> memory_;
    const SlotState* observedState_ = nullptr;
};

}  // namespace cortex::cs
