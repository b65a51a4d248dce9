// SPDX-License-Identifier: Apache-2.0
#include "models/new_type_text.hpp"

#include "cortex/core/xml_text.hpp"

#include "text/new_files.hpp"

namespace cortex::cli {
namespace {

// Examples stand alone in a comment: without its two lines they are valid.
constexpr std::string_view ontologySkeleton = R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- The type {name}: what it is, has and does. How it is joined to others: {rulesFile}
     Check both:       cortex validate {rulesFile}
     Look at it whole: cortex types {name} -f {rulesFile} -->
<ontology name="{name}" version="1.0">
{includes}
  <!-- extends: one or more types whose data, commands and rules it has too. It may add and narrow,
       never widen. version: count it up when something changes. -->
  <type name="{name}" extends="{parents}" version="1.0"{abstract}
        description="Say in one sentence what a {name} is.">

    <!-- Inherited data: {data}.
         To narrow an inherited item, write it again with its name and only what is narrower.
         A new item: kind is int, float, bool or string, with a unit, a range and a default.
{dataHint}{openUnits} -->
    <!--
    <data name="{item}" kind="float" unit="m" min="0" max="10" default="0" {itemAttribute}
          description="Say what it means."/>
    -->
{commands}  </type>
</ontology>
)";

constexpr std::string_view commandSkeleton = R"(
    <!-- Inherited commands: {inherited}.
         available: the states in which it is accepted. Arguments are checked before the class of
         the type sees them. -->
    <!--
    <command name="{command}" available="Active" description="Say what it does.">
      <request name="amount" kind="float" unit="m" min="0" max="1" description="Say what it means."/>
    </command>
    -->
)";

constexpr std::string_view morphologySkeleton = R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- The rules of {name}: how one is joined to others. With what it includes, this file is the whole
     model:  cortex validate {rulesFile} -->
<morphology name="{name}" version="1.0">
  <include file="{file}"/>
  <include file="{model}"/>

  <rules type="{name}">
    <!-- Inherited rules: {rules}.
         To narrow one, write it again with its name and only what is narrower. A new rule:
         direction="input" takes from simplexes of the target type, "output" gives to them; min and
         max count them, and create="TYPE" makes those that are missing. -->
    <!--
    <relationship name="{rule}" direction="input" target="{target}" min="0" max="1"
                  description="Say what it is for."/>
    -->
  </rules>
</morphology>
)";

template <class Element>
std::string namesOf(const std::vector<Element>& elements) {
    std::vector<std::string> names;
    for (const Element& element : elements) names.push_back(element.name);
    return names.empty() ? "none" : xmlComment(joined(names));
}

// One line for each rule that an instance meets.
std::string rulesOf(const Type& type) {
    std::vector<std::string> lines;
    for (const Rule& rule : type.rules) {
        const std::string least = std::to_string(rule.min);
        const std::string count = rule.max == Rule::many ? least + " or more "
                                  : rule.max == rule.min
                                      ? least + " "
                                      : least + " to " + std::to_string(rule.max) + " ";
        lines.push_back(rule.name + " (" + name(rule.direction) + ", " + count + rule.target + ")");
    }
    return lines.empty() ? "none" : xmlComment(joined(lines, ",\n         "));
}

// Items whose unit is for the new type to state.
std::string openUnitsOf(const Type& type) {
    std::vector<std::string> names;
    for (const DataItem& item : type.data) {
        if (item.unit == "*") names.push_back(item.name);
    }
    if (names.empty()) return {};
    return "\n         Units still open: " + xmlComment(joined(names)) +
           ". State each, as in <data name=\"" + xmlComment(names.front()) +
           "\" unit=\"m\"/>,\n         and remove abstract.";
}

std::string freeName(std::string name, const Type& type) {
    while (type.findData(name) != nullptr || type.findCommand(name) != nullptr ||
           type.findRule(name) != nullptr) {
        name += "2";
    }
    return name;
}

std::string commandsText(const Type& type) {
    if (!type.active()) return {};
    return filledIn(commandSkeleton, {{"inherited", namesOf(type.commands)},
                                      {"command", freeName("exampleCommand", type)}});
}

}  // namespace

std::string ontologyText(const NewTypeText& text) {
    const bool active = text.type.active();
    std::string includes;
    for (const std::string& file : text.ontologies) {
        includes += "  <include file=\"" + xmlAttribute(file) + "\"/>\n";
    }
    return filledIn(
        ontologySkeleton,
        {{"name", text.type.name},
         {"rulesFile", xmlComment(text.morphologyFile)},
         {"includes", includes},
         {"parents", joined(text.parents, " ")},
         {"abstract", text.type.isAbstract ? " abstract=\"true\"" : ""},
         {"openUnits", openUnitsOf(text.type)},
         {"data", namesOf(text.type.data)},
         {"dataHint",
          active ? "         settable: the states in which the command `set` may change it."
                 : "         safe: what it becomes when nobody writes it: a value, hold or "
                   "observed."},
         {"item", freeName("exampleItem", text.type)},
         {"itemAttribute", active ? "settable=\"Standby\"" : "safe=\"0\""},
         {"commands", commandsText(text.type)}});
}

std::string morphologyText(const NewTypeText& text) {
    return filledIn(morphologySkeleton, {{"name", text.type.name},
                                         {"rulesFile", xmlComment(text.morphologyFile)},
                                         {"file", xmlAttribute(text.ontologyFile)},
                                         {"model", xmlAttribute(text.model)},
                                         {"rules", rulesOf(text.type)},
                                         {"rule", freeName("exampleInput", text.type)},
                                         {"target", text.target}});
}

}  // namespace cortex::cli
