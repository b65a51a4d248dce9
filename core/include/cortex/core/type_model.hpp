// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"
#include "cortex/core/state.hpp"
#include "cortex/core/value.hpp"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cortex {

// Active simplexes have a task; descriptive ones hold data. An observation is the plant as it is, a
// modification as we wish it. Descriptive: the instance decides (see Structure).
enum class Role : std::uint8_t { Descriptive, Observation, Modification, Active };
enum class Direction : std::uint8_t { Input, Output };
enum class OnLoss : std::uint8_t { Propagate, Hold, Safe, Fault };
enum class OnLimit : std::uint8_t { Clamp, Fault };
// Who decides on an item of a demand at rest: the framework, which writes its safe value, or hooks.
enum class AtRest : std::uint8_t { Safe, Writer };
enum class OnBusy : std::uint8_t { Reject, Replace };
enum class OnSenderLost : std::uint8_t { Continue, Cancel };
enum class OnInputLost : std::uint8_t { Fail, Continue };
enum class OnLeaseLost : std::uint8_t { Continue, Hold, Shutdown };

const char* name(Role role);  // each as written in XML
const char* name(Direction direction);
const char* name(OnLoss onLoss);
const char* name(OnLimit onLimit);
const char* name(AtRest atRest);
const char* name(OnBusy onBusy);
const char* name(OnSenderLost onSenderLost);
const char* name(OnInputLost onInputLost);
const char* name(OnLeaseLost onLeaseLost);
std::optional<Role> roleFromName(std::string_view text);

// What a modification item is set to when no writer is Active: a value, the last value (hold), or
// the item of the same name in the simplex that the writer's counterpart rule names (observed). An
// item and its derivative may stop: the derivative goes to 0 at its rate, the item with it (stop).
struct Safe {
    enum class Kind : std::uint8_t { None, Given, Hold, Observed, Stop };
    Kind kind = Kind::None;
    Value value;
    bool operator==(const Safe&) const = default;
};

// Attributes that a later version stated in a description, as they came: kept and handed on, and
// otherwise without effect. Files have none; there an unknown attribute is an error.
using UnknownAttributes = std::map<std::string, std::string>;

// One data item of a type, or one parameter of a command.
struct DataItem {
    std::string name;
    Kind kind = Kind::Float;
    std::uint32_t length = 1;     // elements; 1 is a scalar
    std::uint32_t capacity = 64;  // bytes of UTF-8 of a string element, without the terminator
    std::string unit;             // UCUM text, canonical; empty: no dimension stated
    std::optional<Number> min, max;
    std::optional<double> rate;  // largest change of a demand, unit per second
    std::string derivativeOf;    // the item of the type whose change per second this one is
    std::string above;           // the constant item of the type that this one must be greater than
    Value initial;               // the XML attribute `default`
    bool hasDefault = false;     // false: `initial` is zero, false or "" moved into the range
    std::map<std::int64_t, std::string> labels;
    std::string description;
    Safe safe;
    OnLimit onLimit = OnLimit::Clamp;
    AtRest atRest = AtRest::Safe;
    StateSet settable;
    bool constant = false;
    bool measured = false;
    bool retain = false;  // survives a restart
    double resolution = 0, deadband = 0;
    std::string format;
    UnknownAttributes unknown;
    std::string definedBy;  // the type that last stated it
    Place place;
    bool operator==(const DataItem&) const = default;
};

// Whether a demand of it takes the observed value on startup. A derivative that stops does not: it
// begins at 0.
bool latchesObservation(const DataItem& item);

// A command of a type, with its parameters.
struct Command {
    std::string name;
    std::string description;
    std::vector<DataItem> request, response;  // in the order written
    StateSet available = StateSet::of(State::Active);
    bool isLong = false;
    bool confirm = false;
    bool stops = false;     // needs no control where nobody else holds it (docs/leases.md)
    bool repeated = false;  // by a held button: events tell a second of it in one line
    double timeout = 0;     // s; 0: none
    OnBusy onBusy = OnBusy::Reject;
    OnSenderLost onSenderLost = OnSenderLost::Continue;
    OnInputLost onInputLost = OnInputLost::Fail;  // of a long one; an input with onLoss="safe"
    UnknownAttributes unknown;
    std::string definedBy;
    Place place;
    bool operator==(const Command&) const = default;
};

// How simplexes of the owner's type are joined to others.
struct Rule {
    static constexpr std::uint32_t many = std::numeric_limits<std::uint32_t>::max();

    std::string name;
    Direction direction = Direction::Input;
    std::string target;  // type that the related simplex must be
    std::uint32_t min = 0, max = many;
    std::vector<std::string> create;  // types of related simplexes made up to min; last repeats
    bool delayed = false;
    std::string refines;      // inherited rule for which these relationships count too
    std::string counterpart;  // on an output: the input rule that observes what it demands
    std::string sameCount;    // rule of the owner that has as many relationships as this one
    OnLoss onLoss = OnLoss::Propagate;
    double maxAge = 0.05;  // s
    std::string description;
    UnknownAttributes unknown;
    std::string definedBy;
    Place place;
    bool operator==(const Rule&) const = default;
};

// A type as written in one file; its rules may come from several morphologies.
struct TypeDeclaration {
    std::string name;
    std::string version;
    std::string description;
    std::vector<std::string> parents;
    bool isAbstract = false;
    std::optional<Role> role;  // none: inherited
    std::vector<DataItem> data;
    std::vector<Command> commands;
    std::vector<Rule> rules;
    // Attributes written explicitly, as "item.attribute"; what is absent is inherited.
    std::set<std::string> stated;
    std::optional<bool> manyWriters;
    std::optional<bool> measures;  // a device: its outputs stay good in every state
    std::optional<OnLeaseLost> onLeaseLost;
    std::optional<double> transitionTimeout;  // s that StartingUp, ShuttingDown may take
    std::string icon, since, replaces;
    UnknownAttributes unknown;
    Place place;
};

// A type with everything it inherits, each list sorted by name (parameters stay in order).
struct Type {
    std::string name;
    std::string version;
    std::string description;
    std::vector<std::string> parents;
    std::set<std::string, std::less<>> ancestors;  // transitive, without itself
    bool isAbstract = false;
    Role role = Role::Descriptive;
    std::vector<DataItem> data;
    std::vector<Command> commands;
    std::vector<Rule> rules;
    bool manyWriters = false;
    bool measures = false;
    OnLeaseLost onLeaseLost = OnLeaseLost::Continue;
    double transitionTimeout = 10;
    std::string icon, since, replaces;
    UnknownAttributes unknown;
    Place place;

    bool active() const { return role == Role::Active; }
    bool isA(std::string_view base) const { return name == base || ancestors.contains(base); }
    const DataItem* findData(std::string_view item) const;
    const Command* findCommand(std::string_view command) const;
    const Rule* findRule(std::string_view rule) const;
};

// The types of an ontology and the rules of its morphology, checked and closed under inheritance.
// Immutable; any thread may read. A descriptive child fixes what its parents leave open: it may add
// and narrow, never widen (docs/ontology.md).
class TypeModel {
public:
    TypeModel() = default;

    // Reads ontology and morphology files with what they include. Throws ModelError with every
    // finding. Look-up order of files: as given, $CORTEX_PATH, the installed share/cortex.
    static TypeModel load(std::span<const std::filesystem::path> files);
    static TypeModel load(const std::filesystem::path& file);

    // Resolves declarations; what is wrong goes to the report, and the types that can be resolved
    // are in the model all the same.
    static TypeModel build(std::vector<TypeDeclaration> declarations, Report& report);

    const Type* find(std::string_view type) const;
    const Type& at(std::string_view type) const;  // throws Error naming the nearest type names
    bool isA(std::string_view type, std::string_view base) const;
    const std::map<std::string, Type, std::less<>>& types() const { return types_; }
    // Declarations as written, by name: for tools that show what a type itself states.
    const std::map<std::string, TypeDeclaration, std::less<>>& declarations() const {
        return declarations_;
    }

private:
    std::map<std::string, Type, std::less<>> types_;
    std::map<std::string, TypeDeclaration, std::less<>> declarations_;
};

}  // namespace cortex
