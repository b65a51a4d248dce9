// SPDX-License-Identifier: Apache-2.0
#include "determinism/observation.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <sstream>

namespace cortex::determinism {

void Snapshot::add(std::uint64_t bits) {
    octets.append(reinterpret_cast<const char*>(&bits), sizeof bits);
}

void Snapshot::add(double number) { add(std::bit_cast<std::uint64_t>(number)); }

void Snapshot::add(std::string_view text, std::size_t capacity) {
    octets += text;
    octets.append(capacity - text.size(), '\0');
}

void Snapshot::add(const SlotState& state) {
    add(static_cast<std::uint64_t>(state.quality));
    add(static_cast<std::uint64_t>(state.cause));
    add(state.cycle);
    add(state.time);
}

std::vector<const DataItem*> comparedItems(const Type& type) {
    std::vector<const DataItem*> items;
    for (const DataItem& item : type.data) {
        if (!item.measured && !item.constant) items.push_back(&item);
    }
    return items;
}

namespace {

struct Place {
    std::string name;
    Kind kind;
    std::size_t first, size;
};

std::vector<Place> placesOf(const std::vector<NamedType>& simplexes) {
    std::vector<Place> places;
    std::size_t next = 0;
    const auto add = [&](std::string name, Kind kind, std::size_t size) {
        places.push_back({std::move(name), kind, next, size});
        next += size;
    };
    for (const NamedType& simplex : simplexes) {
        for (const DataItem* item : comparedItems(*simplex.type)) {
            for (std::uint32_t i = 0; i < item->length; ++i) {
                add(simplex.path + "." + item->name + "[" + std::to_string(i) + "]", item->kind,
                    item->kind == Kind::String ? item->capacity : 8);
            }
        }
        for (const char* name : {"quality", "cause", "stamp's cycle", "stamp's time"}) {
            add(simplex.path + ": " + name, Kind::Int, 8);
        }
    }
    return places;
}

std::string valueAt(const Snapshot& snapshot, const Place& place) {
    const std::string octets = snapshot.octets.substr(place.first, place.size);
    if (place.kind == Kind::String) return "\"" + std::string{octets.c_str()} + "\"";
    if (octets.size() != 8) return "nothing";
    std::int64_t integer = 0;
    std::memcpy(&integer, octets.data(), 8);
    return place.kind == Kind::Float ? toText(std::bit_cast<double>(integer)) : toText(integer);
}

std::string differenceOf(const std::vector<NamedType>& simplexes, const Snapshot& expected,
                         const Snapshot& seen) {
    if (expected.cycle == seen.cycle && expected.octets == seen.octets) return {};
    std::ostringstream text;
    text << "tables after cycle " << expected.cycle << " / " << seen.cycle << ":";
    int shown = 0;
    for (const Place& place : placesOf(simplexes)) {
        const std::string left = valueAt(expected, place), right = valueAt(seen, place);
        if (left != right && shown++ < 12) {
            text << "\n  " << place.name << " must be " << left << ", is " << right;
        }
    }
    return text.str();
}

std::string toText(const SeenEvent& event) {
    std::ostringstream text;
    text << "#" << event.number << " cycle " << event.cycle << " at " << event.time << " "
         << event.path << " " << name(event.severity) << " " << name(event.kind) << ": "
         << event.text;
    return text.str();
}

std::string toText(const SeenOutsideAnswer& answer) {
    std::ostringstream text;
    text << "cycle " << answer.cycle << " " << answer.sender << " " << answer.sequence << " "
         << name(answer.outcome) << " " << name(answer.reason) << " '" << answer.why << "' "
         << answer.latencyCycles << " cycles";
    return text.str();
}

// The first that differs, and its cycle.
template <class List>
std::string differenceOf(const char* what, const List& expected, const List& seen,
                         std::int64_t& cycle) {
    const std::size_t common = std::min(expected.size(), seen.size());
    std::size_t i = 0;
    while (i < common && expected[i] == seen[i]) ++i;
    if (i == expected.size() && i == seen.size()) return {};
    cycle = i < expected.size() ? expected[i].cycle : seen[i].cycle;
    if (i < seen.size()) cycle = std::min(cycle, seen[i].cycle);
    return std::string{what} + " " + std::to_string(i + 1) + ":\n  must be " +
           (i < expected.size() ? toText(expected[i]) : "none") + "\n  is      " +
           (i < seen.size() ? toText(seen[i]) : "none");
}

}  // namespace

std::string difference(const std::vector<NamedType>& simplexes, const Observation& expected,
                       const Observation& seen) {
    std::int64_t eventCycle = 0, answerCycle = 0;
    std::string text;
    for (std::size_t i = 0; i < expected.snapshots.size() && text.empty(); ++i) {
        if (i < seen.snapshots.size()) {
            text = differenceOf(simplexes, expected.snapshots[i], seen.snapshots[i]);
        }
    }
    if (text.empty() && expected.snapshots.size() != seen.snapshots.size()) {
        text = "another number of cycles";
    }
    for (const std::string& more :
         {differenceOf("event", expected.events, seen.events, eventCycle),
          differenceOf("answer", expected.answers, seen.answers, answerCycle)}) {
        if (!more.empty()) text += (text.empty() ? "" : "\n") + more;
    }
    return text;
}

}  // namespace cortex::determinism
