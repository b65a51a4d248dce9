// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

// The messages of comms/idl/cortex.idl as C++. `visit` calls `f` once, with all fields in the order
// of the wire.
namespace cortex::comms {

using Id = std::array<std::uint8_t, 16>;

struct Extra {
    std::string name, value;

    static void visit(auto& self, auto&& f) { f(self.name, self.value); }
    bool operator==(const Extra&) const = default;
};

struct NamedValue {
    std::string name, kind;
    std::vector<std::int64_t> ints;
    std::vector<double> floats;
    std::vector<bool> bools;
    std::vector<std::string> strings;

    static void visit(auto& self, auto&& f) {
        f(self.name, self.kind, self.ints, self.floats, self.bools, self.strings);
    }
    bool operator==(const NamedValue&) const = default;
};

struct Presence {
    static constexpr const char* typeName = "cortex::Presence";
    Id agent{};
    std::string name, host;
    std::int64_t epoch = 0;
    std::string role, state;
    std::vector<std::uint16_t> majors;
    std::int64_t cycle = 0, period = 0, interval = 0;
    std::uint32_t types = 0;
    Id typesHash{};
    std::uint32_t simplexes = 0;
    Id structureHash{};
    std::string security;
    std::vector<Extra> extras;

    const Id& key() const { return agent; }
    static void visit(auto& self, auto&& f) {
        f(self.agent, self.name, self.host, self.epoch, self.role, self.state, self.majors,
          self.cycle, self.period, self.interval, self.types, self.typesHash, self.simplexes,
          self.structureHash, self.security, self.extras);
    }
    bool operator==(const Presence&) const = default;
};

struct Attribute {
    std::string name, value;

    static void visit(auto& self, auto&& f) { f(self.name, self.value); }
    bool operator==(const Attribute&) const = default;
};

struct Parameter {
    std::string name;
    std::vector<Attribute> attributes;

    static void visit(auto& self, auto&& f) { f(self.name, self.attributes); }
    bool operator==(const Parameter&) const = default;
};

struct DataItemModel {
    std::string name, kind;
    std::uint32_t length = 1, capacity = 64;
    std::string unit;
    bool constant = false;
    std::string description;
    std::vector<Attribute> attributes;

    static void visit(auto& self, auto&& f) {
        f(self.name, self.kind, self.length, self.capacity, self.unit, self.constant,
          self.description, self.attributes);
    }
    bool operator==(const DataItemModel&) const = default;
};

struct CommandModel {
    std::string name, description;
    std::vector<Attribute> attributes;
    std::vector<Parameter> request, response;

    static void visit(auto& self, auto&& f) {
        f(self.name, self.description, self.attributes, self.request, self.response);
    }
    bool operator==(const CommandModel&) const = default;
};

struct RuleModel {
    std::string name, direction, target, description;
    std::vector<Attribute> attributes;

    static void visit(auto& self, auto&& f) {
        f(self.name, self.direction, self.target, self.description, self.attributes);
    }
    bool operator==(const RuleModel&) const = default;
};

struct TypeMessage {
    std::string name;
    Id hash{};
    std::vector<std::string> parents;
    std::string description;
    std::vector<Attribute> attributes;
    std::vector<DataItemModel> data;
    std::vector<CommandModel> commands;
    std::vector<RuleModel> rules;

    static void visit(auto& self, auto&& f) {
        f(self.name, self.hash, self.parents, self.description, self.attributes, self.data,
          self.commands, self.rules);
    }
    bool operator==(const TypeMessage&) const = default;
};

struct Relationship {
    std::string rule, target;
    bool delayed = false, remote = false;
    double maxAge = 0;  // s, of its own; 0: the rule's. Written as an extra of its sample

    static void visit(auto& self, auto&& f) {
        f(self.rule, self.target, self.delayed, self.remote);
    }
    bool operator==(const Relationship&) const = default;
};

struct SimplexMessage {
    std::uint32_t index = 0;
    std::string path, type;
    Id typeHash{};
    std::string role;
    std::uint32_t every = 1;
    std::int32_t phase = -1;
    std::vector<Relationship> relationships;
    std::vector<NamedValue> constants;

    static void visit(auto& self, auto&& f) {
        f(self.index, self.path, self.type, self.typeHash, self.role, self.every, self.phase,
          self.relationships, self.constants);
    }
    bool operator==(const SimplexMessage&) const = default;
};

struct Model {
    static constexpr const char* typeName = "cortex::Model";
    Id id{};
    std::string agent;
    std::int64_t epoch = 0;
    std::vector<TypeMessage> types;
    std::vector<SimplexMessage> simplexes;
    std::vector<Extra> extras;

    const Id& key() const { return id; }
    static void visit(auto& self, auto&& f) {
        f(self.id, self.agent, self.epoch, self.types, self.simplexes, self.extras);
    }
    bool operator==(const Model&) const = default;
};

struct View {
    std::uint32_t rate = 30;
    std::vector<std::string> prefixes;

    static void visit(auto& self, auto&& f) { f(self.rate, self.prefixes); }
    bool operator==(const View&) const = default;
};

// What one participant wants of every agent that has it.
struct Interest {
    static constexpr const char* typeName = "cortex::Interest";
    Id agent{};
    std::string name;
    std::int64_t epoch = 0;
    std::vector<std::string> links;
    std::vector<View> views;
    std::vector<Extra> extras;

    const Id& key() const { return agent; }
    static void visit(auto& self, auto&& f) {
        f(self.agent, self.name, self.epoch, self.links, self.views, self.extras);
    }
    bool operator==(const Interest&) const = default;
};

struct SimplexData {
    std::uint32_t index = 0;
    std::uint8_t quality = 0;
    std::uint32_t cause = 0;
    std::int64_t cycle = 0, time = 0;
    std::vector<std::int64_t> ints;
    std::vector<double> floats;
    std::vector<bool> bools;
    std::vector<std::string> strings;

    static void visit(auto& self, auto&& f) {
        f(self.index, self.quality, self.cause, self.cycle, self.time, self.ints, self.floats,
          self.bools, self.strings);
    }
    bool operator==(const SimplexData&) const = default;
};

struct Block {
    static constexpr const char* typeName = "cortex::Block";
    Id agent{};
    std::int64_t epoch = 0;
    Id structureHash{};
    std::uint64_t sequenceNumber = 0;
    std::int64_t cycle = 0, nominalTime = 0, wallClock = 0;
    bool keyFrame = true;
    std::vector<SimplexData> simplexes;
    std::vector<Extra> extras;

    static void visit(auto& self, auto&& f) {
        f(self.agent, self.epoch, self.structureHash, self.sequenceNumber, self.cycle,
          self.nominalTime, self.wallClock, self.keyFrame, self.simplexes, self.extras);
    }
    bool operator==(const Block&) const = default;
};

struct Summary {
    static constexpr const char* typeName = "cortex::Summary";
    Id agent{};
    std::int64_t epoch = 0;
    Id structureHash{};
    std::int64_t cycle = 0;
    std::vector<std::uint8_t> marks;
    std::vector<Extra> extras;

    static void visit(auto& self, auto&& f) {
        f(self.agent, self.epoch, self.structureHash, self.cycle, self.marks, self.extras);
    }
    bool operator==(const Summary&) const = default;
};

struct Command {
    static constexpr const char* typeName = "cortex::Command";
    Id link{};
    std::string sender, host;
    std::int64_t senderEpoch = 0;
    std::string target;
    std::int64_t targetEpoch = 0;
    std::uint64_t sequenceNumber = 0, answeredBelow = 0;
    std::int64_t notAfter = 0;
    std::string path, command;
    std::vector<NamedValue> arguments;
    std::vector<Extra> extras;

    const Id& key() const { return link; }
    static void visit(auto& self, auto&& f) {
        f(self.link, self.sender, self.host, self.senderEpoch, self.target, self.targetEpoch,
          self.sequenceNumber, self.answeredBelow, self.notAfter, self.path, self.command,
          self.arguments, self.extras);
    }
    bool operator==(const Command&) const = default;
};

struct Answer {
    static constexpr const char* typeName = "cortex::Answer";
    Id link{};
    std::string agent;
    std::int64_t epoch = 0;
    std::string sender;
    std::int64_t senderEpoch = 0;
    std::uint64_t sequenceNumber = 0;
    std::string outcome, reason, why;
    std::int64_t latencyCycles = 0, latency = 0;
    std::vector<NamedValue> response;
    std::vector<Extra> extras;

    const Id& key() const { return link; }
    static void visit(auto& self, auto&& f) {
        f(self.link, self.agent, self.epoch, self.sender, self.senderEpoch, self.sequenceNumber,
          self.outcome, self.reason, self.why, self.latencyCycles, self.latency, self.response,
          self.extras);
    }
    bool operator==(const Answer&) const = default;
};

struct EventMessage {
    static constexpr const char* typeName = "cortex::EventMessage";
    Id agent{};
    std::string name;
    std::int64_t epoch = 0;
    std::uint64_t number = 0;
    std::int64_t cycle = 0, wallClock = 0;
    std::string severity, kind, path, text;
    std::vector<Extra> extras;

    const Id& key() const { return agent; }
    static void visit(auto& self, auto&& f) {
        f(self.agent, self.name, self.epoch, self.number, self.cycle, self.wallClock, self.severity,
          self.kind, self.path, self.text, self.extras);
    }
    bool operator==(const EventMessage&) const = default;
};

// An entry of the memory of an agent.
struct PastEventMessage {
    std::int64_t epoch = 0;
    std::uint64_t number = 0;
    std::int64_t cycle = 0, wallClock = 0;
    std::string severity, kind, path, text;

    static void visit(auto& self, auto&& f) {
        f(self.epoch, self.number, self.cycle, self.wallClock, self.severity, self.kind, self.path,
          self.text);
    }
    bool operator==(const PastEventMessage&) const = default;
};

struct KeptSinceMessage {
    std::string kind;
    std::int64_t since = 0;

    static void visit(auto& self, auto&& f) { f(self.kind, self.since); }
    bool operator==(const KeptSinceMessage&) const = default;
};

struct PastMessage {
    static constexpr const char* typeName = "cortex::Past";
    Id agent{};
    std::string name;
    std::int64_t epoch = 0;
    std::string tool;
    std::uint64_t ask = 0, after = 0, last = 0;
    bool more = false;
    std::vector<PastEventMessage> events;
    std::vector<KeptSinceMessage> kept;
    std::vector<Extra> extras;

    const Id& key() const { return agent; }
    static void visit(auto& self, auto&& f) {
        f(self.agent, self.name, self.epoch, self.tool, self.ask, self.after, self.last, self.more,
          self.events, self.kept, self.extras);
    }
    bool operator==(const PastMessage&) const = default;
};

}  // namespace cortex::comms
