// SPDX-License-Identifier: Apache-2.0
#include "wire/ids.hpp"

#include "cortex/core/value.hpp"

#include <algorithm>
#include <cstdint>

namespace cortex::comms {
namespace {

void append(std::string& text, std::string_view word) { text.append(" ").append(word); }

// A free text may contain anything, so its length in octets precedes it.
std::string counted(const std::string& text) { return std::to_string(text.size()) + ":" + text; }

void append(std::string& text, const NamedValue& value) {
    text.append("constant ").append(value.name).append(" ").append(value.kind);
    for (const std::int64_t each : value.ints) append(text, toText(each));
    for (const double each : value.floats) append(text, toText(each));
    for (const bool each : value.bools) append(text, each ? "true" : "false");
    for (const std::string& each : value.strings) append(text, counted(each));
    text += '\n';
}

void append(std::string& text, const Relationship& relationship) {
    text.append("relate ").append(relationship.rule).append(" ").append(relationship.target);
    if (relationship.delayed) text += " delayed";
    if (relationship.remote) text += " remote";
    if (relationship.maxAge != 0) text.append(" maxAge ").append(toText(relationship.maxAge));
    text += '\n';
}

std::string canonicalText(const SimplexMessage& simplex) {
    std::string text = "simplex";
    for (const std::string& word :
         {simplex.path, std::to_string(simplex.index), simplex.type, toHex(simplex.typeHash),
          simplex.role, std::to_string(simplex.every), std::to_string(simplex.phase)}) {
        append(text, word);
    }
    text += '\n';
    for (const Relationship& each : simplex.relationships) append(text, each);
    for (const NamedValue& each : simplex.constants) append(text, each);
    return text;
}

}  // namespace

Id idOf(std::initializer_list<std::string_view> parts) {
    std::string text;
    for (const std::string_view part : parts) text.append(part).append("\n");
    if (!text.empty()) text.pop_back();
    return hashOf(text);
}

Id agentId(std::string_view agent) { return idOf({agent}); }

Id modelId(const Model& sample) {
    if (!sample.types.empty()) return idOf({sample.agent, "type", sample.types.front().name});
    if (sample.simplexes.empty()) return idOf({sample.agent});
    return idOf({sample.agent, "simplex", sample.simplexes.front().path});
}

Id linkId(std::string_view sender, std::string_view target) { return idOf({sender, target}); }

Id typesHash(const std::map<std::string, TypeHash>& types) {
    std::string text;
    for (const auto& [name, hash] : types) text += name + " " + toHex(hash) + "\n";
    return hashOf(text);
}

Id structureHash(const std::vector<SimplexMessage>& simplexes) {
    std::vector<const SimplexMessage*> sorted;
    for (const SimplexMessage& each : simplexes) sorted.push_back(&each);
    std::ranges::sort(sorted, {}, &SimplexMessage::path);
    std::string text;
    for (const SimplexMessage* each : sorted) text += canonicalText(*each);
    return hashOf(text);
}

}  // namespace cortex::comms
