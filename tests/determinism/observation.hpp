// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command.hpp"
#include "cortex/core/event.hpp"
#include "cortex/core/quality.hpp"
#include "cortex/core/type_model.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::determinism {

// All tables after one cycle but what is measured: octets of fixed places.
struct Snapshot {
    std::int64_t cycle = 0;
    std::string octets;

    void add(std::uint64_t bits);
    void add(double number);
    void add(std::int64_t number) { add(static_cast<std::uint64_t>(number)); }
    void add(std::string_view text, std::size_t capacity);
    void add(const SlotState& state);
};

struct SeenEvent {
    std::int64_t cycle = 0, time = 0;
    std::uint64_t number = 0;
    std::string path;
    Severity severity = Severity::Info;
    EventKind kind = EventKind::Message;
    std::string text;

    bool operator==(const SeenEvent&) const = default;
};

struct SeenOutsideAnswer {
    std::int64_t cycle = 0;
    std::string sender;
    std::uint64_t sequence = 0;
    Outcome outcome = Outcome::None;
    Reason reason = Reason::None;
    std::string why;
    std::int64_t latencyCycles = 0;

    bool operator==(const SeenOutsideAnswer&) const = default;
};

// What one run of a plan left behind.
struct Observation {
    std::vector<Snapshot> snapshots;
    std::vector<SeenEvent> events;
    std::vector<SeenOutsideAnswer> answers;
    // What happened, for the count of what the systems exercise.
    std::uint64_t commandsExecuted = 0, commandsAcross = 0, plansOffered = 0;
};

// The items that a snapshot holds of a simplex of this type, in its order.
std::vector<const DataItem*> comparedItems(const Type& type);

// "" or the first difference in words. `simplexes`: path and type, sorted by path.
struct NamedType {
    std::string path;
    const Type* type;
};
std::string difference(const std::vector<NamedType>& simplexes, const Observation& expected,
                       const Observation& seen);

}  // namespace cortex::determinism
