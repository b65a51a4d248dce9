// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

// The messages of comms/idl/cortex.idl as C++; `visit` names the fields in the order of the wire.
namespace cortex::comms {

using Id = std::array<std::uint8_t, 16>;

struct Extra {
    std::string name, value;

    template <class V>
    static void visit(auto& self, V&& field) {
        field(self.name);
        field(self.value);
    }
    bool operator==(const Extra&) const = default;
};

// An extra of Presence: how many agents its sender hears, itself included.
inline constexpr const char* agentsHeard = "agents";
// The number of the last event that it wrote.
inline constexpr const char* eventsWritten = "events";

struct NamedValue {
    std::string name, kind;
    std::vector<std::int64_t> ints;
    std::vector<double> floats;
    std::vector<bool> bools;
    std::vector<std::string> strings;

    template <class V>
    static void visit(auto& self, V&& field) {
        field(self.name);
        field(self.kind);
        field(self.ints);
        field(self.floats);
        field(self.bools);
        field(self.strings);
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
    template <class V>
    static void visit(auto& self, V&& field) {
        field(self.agent);
        field(self.name);
        field(self.host);
        field(self.epoch);
        field(self.role);
        field(self.state);
        field(self.majors);
        field(self.cycle);
        field(self.period);
        field(self.interval);
        field(self.types);
        field(self.typesHash);
        field(self.simplexes);
        field(self.structureHash);
        field(self.security);
        field(self.extras);
    }
    bool operator==(const Presence&) const = default;
};

struct Attribute {
    std::string name, value;

    template <class V>
    static void visit(auto& self, V&& field) {
        field(self.name);
        field(self.value);
    }
    bool operator==(const Attribute&) const = default;
};

struct Parameter {
    std::string name;
    std::vector<Attribute> attributes;

    template <class V>
    static void visit(auto& self, V&& field) {
        field(self.name);
        field(self.attributes);
    }
    bool operator==(const Parameter&) const = default;
};

struct DataItemModel {
    std::string name, kind;
    std::uint32_t length = 1, capacity = 64;
    std::string unit;
    bool constant = false;
    std::string description;
    std::vector<Attribute> attributes;

    template <class V>
    static void visit(auto& self, V&& field) {
        field(self.name);
        field(self.kind);
        field(self.length);
        field(self.capacity);
        field(self.unit);
        field(self.constant);
        field(self.description);
        field(self.attributes);
    }
    bool operator==(const DataItemModel&) const = default;
};

struct CommandModel {
    std::string name, description;
    std::vector<Attribute> attributes;
    std::vector<Parameter> request, response;

    template <class V>
    static void visit(auto& self, V&& field) {
        field(self.name);
        field(self.description);
        field(self.attributes);
        field(self.request);
        field(self.response);
    }
    bool operator==(const CommandModel&) const = default;
};

struct RuleModel {
    std::string name, direction, target, description;
    std::vector<Attribute> attributes;

    template <class V>
    static void visit(auto& self, V&& field) {
        field(self.name);
        field(self.direction);
        field(self.target);
        field(self.description);
        field(self.attributes);
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

    template <class V>
    static void visit(auto& self, V&& field) {
        field(self.name);
        field(self.hash);
        field(self.parents);
        field(self.description);
        field(self.attributes);
        field(self.data);
        field(self.commands);
        field(self.rules);
    }
    bool operator==(const TypeMessage&) const = default;
};

struct Relationship {
    std::string rule, target;
    bool delayed = false, remote = false;

    template <class V>
    static void visit(auto& self, V&& field) {
        field(self.rule);
        field(self.target);
        field(self.delayed);
        field(self.remote);
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

    template <class V>
    static void visit(auto& self, V&& field) {
        field(self.index);
        field(self.path);
        field(self.type);
        field(self.typeHash);
        field(self.role);
        field(self.every);
        field(self.phase);
        field(self.relationships);
        field(self.constants);
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
    template <class V>
    static void visit(auto& self, V&& field) {
        field(self.id);
        field(self.agent);
        field(self.epoch);
        field(self.types);
        field(self.simplexes);
        field(self.extras);
    }
    bool operator==(const Model&) const = default;
};

struct View {
    std::uint32_t rate = 30;
    std::vector<std::string> prefixes;

    template <class V>
    static void visit(auto& self, V&& field) {
        field(self.rate);
        field(self.prefixes);
    }
    bool operator==(const View&) const = default;
};

// What one participant wants of whoever has it.
struct Interest {
    static constexpr const char* typeName = "cortex::Interest";
    Id agent{};
    std::string name;
    std::int64_t epoch = 0;
    std::vector<std::string> links;
    std::vector<View> views;
    std::vector<Extra> extras;

    const Id& key() const { return agent; }
    template <class V>
    static void visit(auto& self, V&& field) {
        field(self.agent);
        field(self.name);
        field(self.epoch);
        field(self.links);
        field(self.views);
        field(self.extras);
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

    template <class V>
    static void visit(auto& self, V&& field) {
        field(self.index);
        field(self.quality);
        field(self.cause);
        field(self.cycle);
        field(self.time);
        field(self.ints);
        field(self.floats);
        field(self.bools);
        field(self.strings);
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

    template <class V>
    static void visit(auto& self, V&& field) {
        field(self.agent);
        field(self.epoch);
        field(self.structureHash);
        field(self.sequenceNumber);
        field(self.cycle);
        field(self.nominalTime);
        field(self.wallClock);
        field(self.keyFrame);
        field(self.simplexes);
        field(self.extras);
    }
    bool operator==(const Block&) const = default;
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
    template <class V>
    static void visit(auto& self, V&& field) {
        field(self.link);
        field(self.sender);
        field(self.host);
        field(self.senderEpoch);
        field(self.target);
        field(self.targetEpoch);
        field(self.sequenceNumber);
        field(self.answeredBelow);
        field(self.notAfter);
        field(self.path);
        field(self.command);
        field(self.arguments);
        field(self.extras);
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
    template <class V>
    static void visit(auto& self, V&& field) {
        field(self.link);
        field(self.agent);
        field(self.epoch);
        field(self.sender);
        field(self.senderEpoch);
        field(self.sequenceNumber);
        field(self.outcome);
        field(self.reason);
        field(self.why);
        field(self.latencyCycles);
        field(self.latency);
        field(self.response);
        field(self.extras);
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
    template <class V>
    static void visit(auto& self, V&& field) {
        field(self.agent);
        field(self.name);
        field(self.epoch);
        field(self.number);
        field(self.cycle);
        field(self.wallClock);
        field(self.severity);
        field(self.kind);
        field(self.path);
        field(self.text);
        field(self.extras);
    }
    bool operator==(const EventMessage&) const = default;
};

}  // namespace cortex::comms
