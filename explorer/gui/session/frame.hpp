// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/lease_client.hpp"

#include "common/safe_demand.hpp"

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
    bool isSilent() const { return lost() && !status.ended; }
    bool beats() const;         // its loop runs, as far as was heard within a second
    std::uint32_t own() const;  // the simplex of the agent itself; noSimplex: none is known
    bool came(std::uint32_t simplex) const { return image && *image && image->came(simplex); }
    Quality quality(std::uint32_t simplex) const;  // lost where nothing is known
    // None also of a lost agent, whose last state may be over.
    std::optional<State> state(std::uint32_t simplex) const;
    std::optional<State> lastState(std::uint32_t simplex) const;
    // The last one that came; a constant also where nothing did.
    std::optional<Value> value(std::uint32_t simplex, const ItemLayout& item) const;
    // Why it has its safe values, if it is a demand; empty otherwise.
    common::StaleDemand stale(std::uint32_t simplex) const;
    bool isSafe(std::uint32_t simplex) const;
    // Whether what the simplex writes is the present value; what is not stands in brackets.
    bool live(std::uint32_t simplex) const;
    bool live(std::uint32_t simplex, const DataItem& item) const;
    // It is not good only because it, or who writes it, is in Standby: nothing is amiss. So it is
    // also where what it would read is lost.
    bool rests(std::uint32_t simplex) const;
    // How old what is shown of it is, in s; none: it never came.
    std::optional<float> age(std::uint32_t simplex) const;
    AgentFrame later(double seconds) const;  // the same moment, so much older

    // It, or who writes it, starts up, is Active or shuts down: it would need its inputs.
    bool works(std::uint32_t simplex) const;

private:
    bool standsBy(std::uint32_t simplex, std::uint32_t cause) const;
};

// An agent that has ended as it should, or that was lost and dismissed.
struct GoneAgent {
    std::string name;
    bool ended = false;     // as it should
    std::int64_t when = 0;  // it was heard last, UTC ns
    std::shared_ptr<const Structure> structure;
};

struct GoneInput {
    std::string path;
    const GoneAgent* agent = nullptr;
};

// Why what is not good is as it should be.
enum class Excuse { None, Rests, Ended };

// A simplex of a frame.
struct Place {
    std::uint32_t agent = 0, simplex = 0;
    bool operator==(const Place&) const = default;
};

// What this session may command. Without a prefix it is read-only.
struct Control {
    // Why an agent did not give what was to be taken.
    struct Refusal {
        std::string agent, why;
    };
    std::string self, person;  // how agents know this session, and who uses it
    // The paths at and below which it may command, as it was signed; none: it may only look.
    std::vector<std::string> rights{"/"};
    std::string prefix, asks;         // what it holds first; what it is taking just now
    std::string last;                 // the prefix that it held last
    std::vector<std::string> claims;  // that it held, and neither released nor handed over
    std::int64_t since = 0;           // UTC ns
    std::string notice;               // what became of it last; empty again when it is taken
    std::uint64_t told = 0;           // how many notices there were
    // What the notice is about: prefixes that were handed over, one that was not taken, with who
    // refused it, or one that others were asked for.
    std::vector<std::string> handed;
    std::string refused, sought;
    std::vector<Refusal> refusals;
    std::vector<comms::LeaseClient::Lease> held;   // all, those handed over to it included
    std::vector<comms::ToolStatus> tools;          // of others who say who uses them
    comms::LeaseClient::Asking asking;             // what it asks others for
    std::vector<comms::LeaseClient::Asked> asked;  // what others ask it for, the longest first

    std::vector<std::string> prefixes() const;  // that are held, each once
    std::vector<std::string> prefixesOf(const std::string& agent) const;
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
    std::vector<GoneAgent> gone;              // those that ended are in `agents` for a minute, too
    std::vector<comms::Contested> contested;  // by path

    // What is known of a path that several agents have; null: at most one has it.
    const comms::Contested* contestOf(std::string_view path) const;
    // Whether the one is shown and commanded rather than the other, which has the path as well.
    bool isOwner(std::uint32_t one, std::uint32_t other, std::string_view path) const;

    // Where the simplex is; of several agents that claim the path, the one that owns it.
    std::optional<Place> find(std::string_view path) const;
    // The agent that had the path last, where it is gone and no other has the path by now.
    const GoneAgent* goneFrom(std::string_view path) const;
    // What made the simplex not good, also through other agents, where that is gone.
    std::optional<GoneInput> goneInput(Place place) const;
    // It is in Standby, or its agent, or that of its input, has ended as it should: no loss.
    Excuse excuse(Place place) const;
    const SimplexInfo& info(Place place) const {
        return agents[place.agent].structure->simplexes[place.simplex];
    }
    const Type& type(Place place) const { return *info(place).layout->type; }
};

}  // namespace cortex::gui
