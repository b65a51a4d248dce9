// SPDX-License-Identifier: Apache-2.0
#include "models/type_text.hpp"

#include "cortex/core/agreement.hpp"

#include "common/role_meaning.hpp"
#include "models/type_json.hpp"
#include "text/output.hpp"

#include <functional>
#include <set>
#include <utility>

namespace cortex::cli {
namespace {

using Words = std::vector<std::string>;

std::string range(const DataItem& item) {
    if (!item.min && !item.max) return {};
    if (!item.max) return "from " + toText(*item.min);
    if (!item.min) return "to " + toText(*item.max);
    return toText(*item.min) + " .. " + toText(*item.max);
}

std::string shape(const DataItem& item) {
    std::string text = name(item.kind);
    if (item.kind == Kind::String) text += "(" + toText(std::int64_t{item.capacity}) + ")";
    if (item.length > 1) text += "[" + toText(std::int64_t{item.length}) + "]";
    return text;
}

std::string initialOf(const DataItem& item) {
    const bool text = item.kind == Kind::String && !item.hasDefault;
    return text ? std::string{} : "default " + toText(item.initial);
}

std::string labelsOf(const DataItem& item) {
    Words words;
    for (const auto& [number, label] : item.labels) words.push_back(toText(number) + ":" + label);
    return joined(words, " ");
}

std::string safeOf(const DataItem& item) {
    switch (item.safe.kind) {
        case Safe::Kind::None:
            return {};
        case Safe::Kind::Hold:
            return "safe hold";
        case Safe::Kind::Observed:
            return "safe observed";
        case Safe::Kind::Stop:
            return "safe stop";
        case Safe::Kind::Given:
            break;
    }
    return "safe " + toText(item.safe.value);
}

// Where an inherited element comes from; nothing for the type's own.
void addOrigin(Words& words, const Type& type, const std::string& definedBy) {
    if (definedBy != type.name) words.push_back("from " + definedBy);
}

Words cellsOf(const DataItem& item, const Words& more) {
    return {item.name, shape(item), item.unit, range(item), initialOf(item), joined(more)};
}

void addNotes(Columns& columns, const DataItem& item) {
    if (!item.description.empty()) columns.addNote(item.description);
    if (!item.labels.empty()) columns.addNote("labels " + labelsOf(item));
}

void printData(std::ostream& stream, const Type& type) {
    Columns columns{2};
    for (const DataItem& item : type.data) {
        Words more;
        if (const std::string safe = safeOf(item); !safe.empty()) more.push_back(safe);
        if (item.onLimit != OnLimit::Clamp)
            more.push_back("on limit " + std::string{name(item.onLimit)});
        if (item.atRest != AtRest::Safe) more.emplace_back("at rest its writer's");
        if (item.rate) more.push_back("rate " + toText(*item.rate) + " per s");
        if (!item.derivativeOf.empty()) more.push_back("derivative of " + item.derivativeOf);
        if (!item.above.empty()) more.push_back("above " + item.above);
        if (!item.settable.empty()) more.push_back("settable: " + item.settable.text());
        if (item.constant) more.emplace_back("constant");
        if (item.measured) more.emplace_back("measured");
        if (item.retain) more.emplace_back("retained");
        if (item.resolution > 0) more.push_back("resolution " + toText(item.resolution));
        if (item.deadband > 0) more.push_back("deadband " + toText(item.deadband));
        addOrigin(more, type, item.definedBy);
        columns.add(cellsOf(item, more));
        addNotes(columns, item);
    }
    if (!type.data.empty()) stream << "\ndata\n";
    columns.print(stream);
}

void addParameters(Columns& columns, const std::vector<DataItem>& items, const char* label) {
    for (const DataItem& item : items) {
        Words words{label + item.name, shape(item)};
        if (!item.unit.empty()) words.push_back(item.unit);
        if (item.min || item.max) words.push_back(range(item));
        if (item.hasDefault) words.push_back("default " + toText(item.initial));
        std::string text = joined(words, " ");
        if (!item.labels.empty()) text += " labels " + labelsOf(item);
        if (!item.description.empty()) text += ": " + item.description;
        columns.addNote(text);
    }
}

void printCommands(std::ostream& stream, const Type& type) {
    Columns columns{2};
    for (const Command& command : type.commands) {
        Words more;
        if (command.isLong) more.emplace_back("long");
        if (command.timeout > 0) more.push_back("timeout " + toText(command.timeout) + " s");
        if (command.confirm) more.emplace_back("to be confirmed");
        if (command.stops) more.emplace_back("stops");
        if (command.repeated) more.emplace_back("repeated");
        if (command.isLong) more.push_back("on busy " + std::string{name(command.onBusy)});
        if (command.onInputLost != OnInputLost::Fail) {
            more.push_back("on input lost " + std::string{name(command.onInputLost)});
        }
        if (command.onSenderLost != OnSenderLost::Continue) {
            more.push_back("on sender lost " + std::string{name(command.onSenderLost)});
        }
        addOrigin(more, type, command.definedBy);
        const std::string available = command.available.text();
        columns.add({command.name, "available: " + (available.empty() ? "never" : available),
                     joined(more)});
        if (!command.description.empty()) columns.addNote(command.description);
        addParameters(columns, command.request, "request ");
        addParameters(columns, command.response, "response ");
    }
    if (!type.commands.empty()) stream << "\ncommands\n";
    columns.print(stream);
}

std::string countOf(const Rule& rule) {
    const std::string least = toText(std::int64_t{rule.min});
    if (rule.max == Rule::many) return least + "..*";
    return rule.min == rule.max ? least : least + ".." + toText(std::int64_t{rule.max});
}

void printRules(std::ostream& stream, const Type& type) {
    Columns columns{2};
    for (const Rule& rule : type.rules) {
        const bool input = rule.direction == Direction::Input;
        Words more;
        if (!rule.create.empty()) more.push_back("creates " + joined(rule.create, " "));
        if (rule.delayed) more.emplace_back("delayed");
        if (!rule.refines.empty()) more.push_back("refines " + rule.refines);
        if (!rule.counterpart.empty()) more.push_back("counterpart " + rule.counterpart);
        if (!rule.sameCount.empty()) more.push_back("as many as " + rule.sameCount);
        if (input && rule.onLoss != OnLoss::Propagate) {
            more.push_back("on loss " + std::string{name(rule.onLoss)});
        }
        if (input) more.push_back("max age " + toText(rule.maxAge) + " s");
        addOrigin(more, type, rule.definedBy);
        columns.add(
            {rule.name, name(rule.direction), countOf(rule) + " " + rule.target, joined(more)});
        if (!rule.description.empty()) columns.addNote(rule.description);
    }
    if (!type.rules.empty()) stream << "\nrelationships\n";
    columns.print(stream);
}

std::string roleText(const Type& type) {
    switch (type.role) {
        case Role::Active:
            return type.isA("Agent") ? "active: has commands and state items; its commands run in "
                                       "the loop itself, between cycles, without a task of its own"
                                     : "active: has a task in every cycle";
        case Role::Observation:
        case Role::Modification:
            return std::string{name(type.role)} + ": " +
                   std::string{common::roleMeaning(type.role)};
        case Role::Descriptive:
            break;
    }
    return "descriptive: data; the writer of an instance makes it an observation or a modification";
}

// Nearest first, each after what extends it.
Words ancestorsOf(const TypeModel& types, const Type& type) {
    std::set<std::pair<std::size_t, std::string>, std::greater<>> byDepth;
    for (const std::string& each : type.ancestors) {
        byDepth.emplace(types.at(each).ancestors.size(), each);
    }
    Words ancestors;
    for (const auto& [depth, ancestor] : byDepth) ancestors.push_back(ancestor);
    return ancestors;
}

class TreePrinter {
public:
    TreePrinter(std::ostream& stream, const TypeModel& types) : stream_{stream}, types_{types} {
        for (const auto& [childName, type] : types.types()) {
            for (const auto& parent : type.parents) children_[parent].push_back(&type);
        }
    }

    void run() {
        Columns columns{0};
        for (const auto& [typeName, type] : types_.types()) {
            if (type.parents.empty()) add(columns, type, "", 0);
        }
        columns.print(stream_);
    }

private:
    void add(Columns& columns, const Type& type, const std::string& under, std::size_t depth) {
        const bool again = !known_.insert(type.name).second;
        std::string text = std::string(2 * depth, ' ') + type.name;
        Words more;
        if (type.isAbstract) more.emplace_back("abstract");
        const bool newRole = depth == 0 || types_.at(under).role != type.role;
        if (newRole && type.role != Role::Descriptive) more.emplace_back(name(type.role));
        for (const auto& parent : type.parents) {
            if (parent != under) more.push_back("also " + parent);
        }
        if (!more.empty()) text += " (" + joined(more) + ")";
        columns.add({text, again ? "as above" : firstSentence(type.description)});
        if (again) return;
        for (const Type* child : children_[type.name]) add(columns, *child, type.name, depth + 1);
    }

    static std::string firstSentence(const std::string& text) {
        const std::size_t end = std::min(text.find(". "), text.find(": "));
        std::string sentence = text.substr(0, end);
        if (sentence.ends_with('.')) sentence.pop_back();
        return sentence;
    }

    std::ostream& stream_;
    const TypeModel& types_;
    std::map<std::string, std::vector<const Type*>> children_;
    std::set<std::string> known_;
};

}  // namespace

void printTypeTree(std::ostream& stream, const TypeModel& types) {
    TreePrinter{stream, types}.run();
}

void printType(std::ostream& stream, const TypeModel& types, const Type& type) {
    stream << printable(type.name) << (type.isAbstract ? " (abstract)" : "") << '\n';
    if (!type.description.empty()) stream << printable(type.description) << '\n';
    stream << '\n';
    Columns columns{2};
    const auto add = [&](const char* label, const std::string& text) {
        if (!text.empty()) columns.add({label, text});
    };
    add("version", type.version);
    add("role", roleText(type));
    add("extends", joined(type.parents));
    add("ancestors", joined(ancestorsOf(types, type)));
    add("extended by", joined(childrenOf(types, type)));
    add("writers", type.manyWriters ? "many: several simplexes may write one" : "");
    add("measures", type.measures ? "its outputs keep their quality in every state" : "");
    if (type.onLeaseLost != OnLeaseLost::Continue) add("on lease lost", name(type.onLeaseLost));
    if (type.active() && !type.isA("Agent"))
        add("transitions", "within " + toText(type.transitionTimeout) + " s");
    add("icon", type.icon);
    add("since", type.since);
    add("replaces", type.replaces);
    add("defined in", type.place.text());
    add("hash", toHex(typeHash(type)));
    columns.print(stream);
    printData(stream, type);
    printCommands(stream, type);
    printRules(stream, type);
}

}  // namespace cortex::cli
