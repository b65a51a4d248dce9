// SPDX-License-Identifier: Apache-2.0
#include "files/ontology_reader.hpp"

#include "base/bounds.hpp"
#include "files/element_reader.hpp"
#include "types/stated.hpp"

#include <array>
#include <utility>

namespace cortex {

namespace {

using Child = ElementReader::Child;

Value rawValue(std::string_view text) { return std::vector<std::string>{std::string{text}}; }

// Kinds are known only when the types are resolved: until then defaults stay text.
std::string readBound(std::optional<Number>& target, std::string_view text) {
    if (const auto whole = toInt(text)) {
        target = *whole;
    } else if (const auto real = toFloat(text)) {
        target = *real;
    } else {
        return "a finite number";
    }
    return {};
}

std::string readSafe(Safe& target, std::string_view text) {
    using enum Safe::Kind;
    target.kind = text == "hold"       ? Hold
                  : text == "observed" ? Observed
                  : text == "stop"     ? Stop
                                       : Given;
    if (target.kind == Given) target.value = rawValue(text);
    return {};
}

std::string readLabels(std::map<std::int64_t, std::string>& target, std::string_view text) {
    constexpr const char* expected =
        "number:Label pairs separated by blanks, each number and each label once, such as "
        "\"0:Idle 1:Jog\"";
    std::set<std::string_view> used;
    for (const std::string_view word : splitBlanks(text)) {
        const std::size_t colon = word.find(':');
        if (colon == std::string_view::npos || colon + 1 == word.size()) return expected;
        const auto number = toInt(word.substr(0, colon));
        const std::string_view label = word.substr(colon + 1);
        if (!number || !used.insert(label).second) return expected;
        if (!target.emplace(*number, label).second) return expected;
        if (used.size() > bounds::labels) return "at most 1024 labels";
    }
    return target.empty() ? expected : "";
}

std::string readStates(StateSet& target, std::string_view text) {
    const auto states = stateSetFromText(text);
    if (!states)
        return "always, or one or more of Standby, StartingUp, Active, ShuttingDown, Fault";
    target = *states;
    return {};
}

template <auto Member>
constexpr auto textInto =
    [](auto& target, std::string_view text) { return readText(target.*Member, text); };
template <auto Member>
constexpr auto boolInto =
    [](auto& target, std::string_view text) { return readBool(target.*Member, text); };
template <auto Member>
constexpr auto floatInto =
    [](auto& target, std::string_view text) { return readFloat(target.*Member, text); };
template <auto Member>
constexpr auto countInto =
    [](auto& target, std::string_view text) { return readCount(target.*Member, text); };
template <auto Member>
constexpr auto enumInto =
    [](auto& target, std::string_view text) { return readEnum(target.*Member, text); };
template <auto Member>
constexpr auto namesInto =
    [](auto& target, std::string_view text) { return readNames(target.*Member, text); };
template <auto Member>
constexpr auto boundInto =
    [](auto& target, std::string_view text) { return readBound(target.*Member, text); };
template <auto Member>
constexpr auto statesInto =
    [](auto& target, std::string_view text) { return readStates(target.*Member, text); };

using D = DataItem;
constexpr std::array dataAttributes{
    AttributeReader<D>{"name", textInto<&D::name>, true},
    AttributeReader<D>{"kind", enumInto<&D::kind>},
    AttributeReader<D>{"length", countInto<&D::length>},
    AttributeReader<D>{"capacity", countInto<&D::capacity>},
    AttributeReader<D>{"unit", textInto<&D::unit>},
    AttributeReader<D>{"min", boundInto<&D::min>},
    AttributeReader<D>{"max", boundInto<&D::max>},
    AttributeReader<D>{"default",
                       [](D& item, std::string_view text) {
                           item.initial = rawValue(text);
                           item.hasDefault = true;
                           return std::string{};
                       }},
    AttributeReader<D>{
        "labels", [](D& item, std::string_view text) { return readLabels(item.labels, text); }},
    AttributeReader<D>{"description", textInto<&D::description>},
    AttributeReader<D>{"resolution", floatInto<&D::resolution>},
    AttributeReader<D>{"deadband", floatInto<&D::deadband>},
    AttributeReader<D>{"format", textInto<&D::format>},
    // Not of parameters, from here on.
    AttributeReader<D>{
        "rate",
        [](D& item, std::string_view text) { return readFloat(item.rate.emplace(), text); }},
    AttributeReader<D>{"derivativeOf", textInto<&D::derivativeOf>},
    AttributeReader<D>{"above", textInto<&D::above>},
    AttributeReader<D>{"safe",
                       [](D& item, std::string_view text) { return readSafe(item.safe, text); }},
    AttributeReader<D>{"onLimit", enumInto<&D::onLimit>},
    AttributeReader<D>{"atRest", enumInto<&D::atRest>},
    AttributeReader<D>{"settable", statesInto<&D::settable>},
    AttributeReader<D>{"constant", boolInto<&D::constant>},
    AttributeReader<D>{"measured", boolInto<&D::measured>},
    AttributeReader<D>{"retain", boolInto<&D::retain>},
};
constexpr std::size_t parameterAttributes = 13;

using C = Command;
constexpr std::array commandAttributes{
    AttributeReader<C>{"name", textInto<&C::name>, true},
    AttributeReader<C>{"available", statesInto<&C::available>},
    AttributeReader<C>{"long", boolInto<&C::isLong>},
    AttributeReader<C>{"timeout", floatInto<&C::timeout>},
    AttributeReader<C>{"confirm", boolInto<&C::confirm>},
    AttributeReader<C>{"stops", boolInto<&C::stops>},
    AttributeReader<C>{"repeated", boolInto<&C::repeated>},
    AttributeReader<C>{"onBusy", enumInto<&C::onBusy>},
    AttributeReader<C>{"onInputLost", enumInto<&C::onInputLost>},
    AttributeReader<C>{"onSenderLost", enumInto<&C::onSenderLost>},
    AttributeReader<C>{"description", textInto<&C::description>},
};

using R = Rule;
constexpr std::array ruleAttributes{
    AttributeReader<R>{"name", textInto<&R::name>, true},
    AttributeReader<R>{"direction", enumInto<&R::direction>},
    AttributeReader<R>{"target", textInto<&R::target>},
    AttributeReader<R>{"min", countInto<&R::min>},
    AttributeReader<R>{"max",
                       [](R& rule, std::string_view text) {
                           if (text != "*") {
                               const std::string expected = readCount(rule.max, text);
                               return expected.empty() ? expected : expected + ", or *";
                           }
                           rule.max = R::many;
                           return std::string{};
                       }},
    AttributeReader<R>{"create", namesInto<&R::create>},
    AttributeReader<R>{"delayed", boolInto<&R::delayed>},
    AttributeReader<R>{"refines", textInto<&R::refines>},
    AttributeReader<R>{"counterpart", textInto<&R::counterpart>},
    AttributeReader<R>{"sameCount", textInto<&R::sameCount>},
    AttributeReader<R>{"onLoss", enumInto<&R::onLoss>},
    AttributeReader<R>{"maxAge", floatInto<&R::maxAge>},
    AttributeReader<R>{"description", textInto<&R::description>},
};

using T = TypeDeclaration;
constexpr std::array typeAttributes{
    AttributeReader<T>{"name", textInto<&T::name>, true},
    AttributeReader<T>{"extends", namesInto<&T::parents>},
    AttributeReader<T>{"abstract", boolInto<&T::isAbstract>},
    AttributeReader<T>{
        "role", [](T& type, std::string_view text) { return readEnum(type.role.emplace(), text); }},
    AttributeReader<T>{"version", textInto<&T::version>},
    AttributeReader<T>{"description", textInto<&T::description>},
    AttributeReader<T>{"writers",
                       [](T& type, std::string_view text) {
                           type.manyWriters = text == "many";
                           return std::string{text == "many" || text == "one" ? "" : "one or many"};
                       }},
    AttributeReader<T>{
        "measures",
        [](T& type, std::string_view text) { return readBool(type.measures.emplace(), text); }},
    AttributeReader<T>{
        "onLeaseLost",
        [](T& type, std::string_view text) { return readEnum(type.onLeaseLost.emplace(), text); }},
    AttributeReader<T>{"transitionTimeout",
                       [](T& type, std::string_view text) {
                           return readFloat(type.transitionTimeout.emplace(), text);
                       }},
    AttributeReader<T>{"icon", textInto<&T::icon>},
    AttributeReader<T>{"since", textInto<&T::since>},
    AttributeReader<T>{"replaces", textInto<&T::replaces>},
};

// <description>, allowed once in everything that has the attribute of that name.
Child descriptionInto(const ElementReader& reader, std::string& target) {
    return {"description", [&reader, &target](const XmlElement& element) {
                reader.attributes(element, std::span<const AttributeReader<std::string>>{}, target);
                if (!target.empty()) {
                    reader.error(finding::repeatedElement, element.line,
                                 "the description is given twice", "keep one of them");
                }
                target = element.text;
                for (const XmlElement& child : element.children) {
                    reader.error(finding::unknownElement, child.line,
                                 "<description> has no elements", "write plain text");
                }
            }};
}

// Collects in `stated` what is written, each with the prefix of its item.
std::function<void(const std::string&)> into(std::set<std::string>& stated, std::string prefix) {
    return [&stated, prefix = std::move(prefix)](const std::string& attribute) {
        stated.insert(prefix + attribute);
    };
}

template <class Item>
Item start(const ElementReader& reader, const XmlElement& element) {
    Item item;
    item.place = reader.place(element.line);
    return item;
}

std::string nameOf(const XmlElement& element) {
    const XmlAttribute* attribute = element.find("name");
    return attribute ? attribute->value : "";
}

void readData(const ElementReader& reader, const XmlElement& element, bool parameter,
              const std::string& prefix, std::set<std::string>& stated,
              std::vector<DataItem>& items) {
    auto item = start<DataItem>(reader, element);
    std::span<const AttributeReader<D>> known = dataAttributes;
    // Of parameters, the others are found wrong when their command is merged.
    if (parameter && !reader.keepsUnknown) known = known.first(parameterAttributes);
    const bool named =
        reader.attributes(element, known, item, into(stated, dataPrefix(prefix, nameOf(element))));
    const Child children[] = {descriptionInto(reader, item.description)};
    reader.children(element, children);
    if (named) items.push_back(std::move(item));
}

void readCommand(const ElementReader& reader, const XmlElement& element, TypeDeclaration& type) {
    auto command = start<Command>(reader, element);
    const std::string prefix = commandPrefix(nameOf(element));
    const bool named =
        reader.attributes(element, std::span<const AttributeReader<C>>{commandAttributes}, command,
                          into(type.stated, prefix));
    const auto parameterInto = [&](const char* kind, std::vector<DataItem>& list) {
        return Child{kind, [&, kind](const XmlElement& child) {
                         readData(reader, child, true, parameterPrefix(prefix, kind), type.stated,
                                  list);
                     }};
    };
    const Child children[] = {descriptionInto(reader, command.description),
                              parameterInto("request", command.request),
                              parameterInto("response", command.response)};
    reader.children(element, children);
    if (named) type.commands.push_back(std::move(command));
}

}  // namespace

TypeDeclaration readType(const XmlElement& element, const std::string& file, Report& report,
                         Unknown unknown) {
    const ElementReader reader{file, report, nameOf(element), unknown == Unknown::Kept};
    auto type = start<TypeDeclaration>(reader, element);
    reader.attributes(element, std::span<const AttributeReader<T>>{typeAttributes}, type);
    const Child children[] = {
        descriptionInto(reader, type.description),
        {"data",
         [&](const XmlElement& child) {
             readData(reader, child, false, "", type.stated, type.data);
         }},
        {"command", [&](const XmlElement& child) { readCommand(reader, child, type); }}};
    reader.children(element, children);
    return type;
}

RuleBlock readRules(const XmlElement& element, const std::string& file, Report& report,
                    Unknown unknown) {
    const XmlAttribute* name = element.find("type");
    const ElementReader reader{file, report, name ? name->value : "", unknown == Unknown::Kept};
    auto block = start<RuleBlock>(reader, element);
    constexpr std::array attributes{
        AttributeReader<RuleBlock>{"type", textInto<&RuleBlock::type>, true}};
    reader.attributes(element, std::span<const AttributeReader<RuleBlock>>{attributes}, block);
    const Child children[] = {
        {"relationship", [&](const XmlElement& child) {
             auto rule = start<Rule>(reader, child);
             const bool named =
                 reader.attributes(child, std::span<const AttributeReader<R>>{ruleAttributes}, rule,
                                   into(block.stated, rulePrefix(nameOf(child))));
             const Child inner[] = {descriptionInto(reader, rule.description)};
             reader.children(child, inner);
             if (named) block.rules.push_back(std::move(rule));
         }}};
    reader.children(element, children);
    return block;
}

}  // namespace cortex
