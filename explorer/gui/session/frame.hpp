// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/lease_client.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// One moment of everything that is known. Frames are immutable: the session's thread makes them,
// any thread may read them.
namespace cortex::gui {

// What is known of one agent. Without a structure its types and simplexes have not all come.
struct AgentFrame {
    comms::AgentStatus status;
    std::shared_ptr<const Structure> structure;
    std::shared_ptr<const comms::AgentImage> image;  // null: nothing of it is viewed
    std::vector<float> ages;                         // s, by simplex; negative: never came

    bool lost() const { return status.state == "lost"; }  // or ended
    bool beats() const;         // its loop runs, as far as was heard within a second
    std::uint32_t own() const;  // the simplex of the agent itself; noSimplex: none is known
    bool came(std::uint32_t simplex) const { return image && *image && image->came(simplex); }
    Quality quality(std::uint32_t simplex) const;  // lost where nothing is known
    // None also of a lost agent, whose last state may be over.
    std::optional<State> state(std::uint32_t simplex) const;
    std::optional<State> lastState(std::uint32_t simplex) const;
    // The last one that came; a constant also where nothing did.
    std::optional<Value> value(std::uint32_t simplex, const ItemLayout& item) const;
    // It is stale only because it, or who writes it, is in Standby: nothing is amiss.
    bool rests(std::uint32_t simplex) const;
    std::optional<float> age(std::uint32_t simplex) const;
};

// A simplex of a frame.
struct Place {
    std::uint32_t agent = 0, simplex = 0;
    bool operator==(const Place&) const = default;
};

// What this session may command. Without a prefix it is read-only.
struct Control {
    std::string self;          // how agents know this session
    std::string prefix, asks;  // what it holds first; what it is taking just now
    std::string last;          // the prefix that it held last
    std::int64_t since = 0;    // UTC ns
    std::string notice;        // what became of it last; empty again when it is taken
    std::vector<comms::LeaseClient::Lease> held;  // all, those handed over to it included

    std::vector<std::string> prefixes() const;  // that are held, each once
    std::string common() const;                 // the path around all of them; empty: none

    bool covers(const std::string& agent, std::string_view path) const;
};

struct Frame {
    std::uint64_t number = 0;
    std::int64_t utc = 0;          // ns, by this computer's clock
    std::uint64_t structures = 0;  // changes whenever an agent or its structure came or went
    int domain = 0;
    bool joined = false;
    bool complete = false;  // everything of all has come, and no new one appears
    double seconds = 0;     // since it began to join
    std::string problem;    // why the domain cannot be joined, with the remedy
    std::string security;
    std::uint32_t rate = 0;    // Hz, at which values are taken; 0: every cycle
    std::uint32_t closed = 0;  // participants with security, which cannot be seen without
    Control control;
    std::vector<AgentFrame> agents;
    std::vector<comms::Contested> contested;  // by path

    // What is known of a path that several agents have; null: at most one has it.
    const comms::Contested* contestOf(std::string_view path) const;
    // Whether the one is shown and commanded rather than the other, which has the path as well.
    bool isOwner(std::uint32_t one, std::uint32_t other, std::string_view path) const;

    // Where the simplex is; of several agents that claim the path, the one that owns it.
    std::optional<Place> find(std::string_view path) const;
    const SimplexInfo& info(Place place) const {
        return agents[place.agent].structure->simplexes[place.simplex];
    }
    const Type& type(Place place) const { return *info(place).layout->type; }
};

}  // namespace cortex::gui
