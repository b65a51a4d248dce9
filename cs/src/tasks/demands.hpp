// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"
#include "cortex/core/tables.hpp"

#include "tasks/stopping.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cortex::cs {

// What limiting one modification found, for the caller to report.
struct LimitResult {
    bool any = false;                    // an item was not finite, out of range or too fast
    bool notFinite = false;              // `faulting` is; the items after it were not looked at
    const DataItem* faulting = nullptr;  // the first item that puts its writer into Fault
    bool limited = false;                // an item was out of range or too fast
};

// A device of this agent that reads a demand; its link as the cycle before left it.
struct DemandTaker {
    std::uint32_t simplex;
    const SlotState* state;
    const std::int64_t* link;  // null: its type says nothing of one
    std::int64_t open;         // the number of `link` when it is Open

    bool isConnected() const {
        return state->quality != Quality::Lost && (link == nullptr || *link == open);
    }
};

// The last step before a modification is read or sent: not finite, out of range, too fast.
// One per modification that has a writer; used by the task that ran last among its writers.
// While no device that reads it is connected, what has a rate stands, and a derivative of that
// comes to rest by its own rate: it goes on from there.
class DemandLimits {
public:
    // The first cycle of an episode of one item. It ends after a second without a limit, so that
    // the strokes of a ramp are one.
    struct Beginning {
        const DataItem* item;
        double value, limit;  // what was written, what it became
        bool notFinite;
        bool byRate;   // in range, but too far from the value before
        bool noLabel;  // of a closed enumeration: it became the value before
        bool unseen;   // it became so, from `value` to `limit`, while no device took it
    };

    // `accepted`: where the values last accepted are kept for a writer that reads them; its state
    // is null where none does, and they are kept here.
    DemandLimits(const TypeLayout& layout, const Slice& live, const Slice& accepted,
                 std::uint32_t simplex);

    // Setup. Devices that read it by a relationship that is not delayed; `taken`: what writers see
    // of them.
    void setTakers(std::vector<DemandTaker> takers, bool& taken);

    std::uint32_t simplex() const { return simplex_; }
    // By the last apply(): whether it stands, as none of the devices that read it is connected.
    bool stands() const { return taken_ != nullptr && !*taken_; }
    std::uint32_t taker() const { return takers_.front().simplex; }  // the first of them
    // Whether it stands, and what has no rate is not what the last device left. Between cycles.
    bool changedUnseen() const;
    // Limits the live values against those last accepted. May be called again with other values
    // before accept(): a demand still moves no further than once.
    LimitResult apply(double elapsedSeconds) CORTEX_REALTIME;
    std::span<const Beginning> beginnings() const { return beginnings_; }  // of the last apply()
    void accept() CORTEX_REALTIME;   // the live values are those that go out
    void restore() CORTEX_REALTIME;  // the values last accepted go out once more
    // The value of an item as last accepted; null for items outside the cyclic table.
    const std::byte* previous(const DataItem& item) const;

private:
    struct Item {
        const DataItem* item;
        std::byte* live;
        std::byte* previous;
        std::uint32_t size;  // octets
        bool limited, inEpisode;
        bool plain;   // one number without a rate
        bool closed;  // a closed enumeration: its labels are its range
        double min, max, rate;
        const Item* base;  // of one that is safe="stop": the item whose derivative it is
        bool hasRate = false, derives = false;  // derives: of an item with a rate
        double quiet = 0;            // seconds of the episode in which nothing was limited
        std::byte* taken = nullptr;  // what has no rate, as the last device left it
    };
    static void follow(Item& item, bool limitedNow, double elapsed) CORTEX_REALTIME;
    static bool standsAtItsEnd(const Item& item, std::uint32_t element) CORTEX_REALTIME;
    bool applyFloat(Item& item, double elapsed, LimitResult& result) CORTEX_REALTIME;
    bool applyInt(Item& item, LimitResult& result) CORTEX_REALTIME;
    void devicesChanged() CORTEX_REALTIME;
    void stand(double elapsed) CORTEX_REALTIME;
    void found(const Item& item, bool first, double value, double limit, bool byRate,
               LimitResult& result) CORTEX_REALTIME;

    std::uint32_t simplex_;
    std::vector<Item> items_;
    std::vector<std::byte> memory_, takenMemory_;
    std::vector<Beginning> beginnings_;
    std::vector<DemandTaker> takers_;
    bool* taken_ = nullptr;                  // null: no device reads it
    bool stood_ = false, wasTaken_ = false;  // wasTaken_: since the start
};

// The safe values that one writer gives one modification. In Standby, in Fault and while an input
// of onLoss="safe" is lost they stand, whatever hooks wrote; on the way between states until a hook
// moves them.
class SafeDemands {
public:
    // `counterpart`: slice of the simplex that observes what is demanded, and its layout; null if
    // the rule names none.
    SafeDemands(const TypeLayout& layout, const Slice& out, const DemandLimits& limits,
                const TypeLayout* observedLayout, const Slice& observed);

    // On leaving Active and on startup: `observed` takes the observation, `hold` the last demand.
    // An observation that is bad or lost cannot be taken; then the last demand stands in. `stop`
    // takes the observation on startup, at rest; otherwise it goes on from the last demand. So does
    // a startup of what still slows down, until it rests.
    enum class Latch : std::uint8_t { Startup, Stop };
    void latch(Latch why) CORTEX_REALTIME;
    // What stops is slower by this time. Called again before the demand goes out, it gives the
    // same.
    void slow(double elapsedSeconds) CORTEX_REALTIME {
        if (slows_ && startsUp_ && !isMoving()) takeSafe();
        if (!slows_) return;
        for (const Stopping& each : stops_) each.step(elapsedSeconds);
    }
    bool stops() const { return !stops_.empty(); }
    void write() CORTEX_REALTIME;
    // Again, but for the items that are their writer's at rest.
    void hold() CORTEX_REALTIME;
    // Before hooks on the way between states: what no hook has moved goes on to its safe value.
    void put(double elapsedSeconds) CORTEX_REALTIME {
        if (moved_) return;
        slow(elapsedSeconds);
        hold();
    }
    // After them: whether a hook has moved it since the last latch().
    bool moved() CORTEX_REALTIME;
    // At rest, before write(): the first item that a hook wrote and that is not its safe value.
    // `sole`: what went out last stands here too, perhaps on its way to the safe value.
    const DataItem* writtenInVain(bool sole) const CORTEX_REALTIME;

    // An item that went out last on its way to its safe value, as far as its rate allows.
    struct Way {
        const DataItem* item;
        double value, safe;
    };
    std::optional<Way> onTheWay() const CORTEX_REALTIME;
    // Whether an `observed` item may be latched: its observation is good.
    bool observationIsGood() const CORTEX_REALTIME;
    bool observes() const { return observedState_ != nullptr; }

private:
    struct Item {
        const DataItem* item;
        std::byte* out;
        std::byte* safe;
        const std::byte* previous;
        const std::byte* observed;  // null: not observed
        std::uint32_t size;
        bool given;
    };
    void addStops();
    void takeSafe() CORTEX_REALTIME;
    // What stops, by what went out last.
    bool isMoving() const CORTEX_REALTIME {
        return std::ranges::any_of(stops_, [](const Stopping& each) { return each.moving() >= 0; });
    }
    std::vector<Item> items_;
    std::vector<std::byte> memory_;
    const SlotState* observedState_ = nullptr;
    std::vector<Stopping> stops_;
    bool moved_ = false;
    bool startsUp_ = false;  // the last latch() was one on startup
    bool slows_ = false;     // not from rest on in a startup
};

}  // namespace cortex::cs
