// SPDX-License-Identifier: Apache-2.0
#include "comms/odd_model.hpp"

#include "cortex/core/labelled_value.hpp"
#include "cortex/core/xml_text.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace cortex::test {
namespace {

constexpr std::size_t seldom = 250;  // one attribute in so many makes a model invalid
constexpr std::uint32_t longLength = 30'000;

std::string boundText(Chance& chance, bool whole) {
    constexpr std::array wholes{"0", "-0", "+0", "-3", "+7", "-9223372036854775808"};
    constexpr std::array reals{"-0.0",
                               "0.0",
                               "-0",
                               "-0e5",
                               "1e-320",
                               "-1e22",
                               "9007199254740993",
                               "0.1",
                               "-5",
                               "18446744073709551616"};
    return whole ? chance.oneOf(wholes) : chance.oneOf(reals);
}

std::string labelsText(Chance& chance) {
    constexpr std::array words{"Off", "1e3", "1.0", "a:b", "-", "99999999999999999999", "0x1"};
    constexpr std::array numbers{"1", "-2", "+3", "007", "-0"};
    std::string text;
    std::int64_t number = -2;
    for (const char* word : words) {
        const bool isNumber = chance.oneIn(seldom);
        text += (text.empty() ? "" : " ") + std::to_string(number) + ":" +
                (isNumber ? chance.oneOf(numbers) : word);
        number += 1 + static_cast<std::int64_t>(chance.below(3));
        if (chance.oneIn(3)) break;
    }
    if (chance.oneIn(seldom)) text += " 70:" + std::string(70'000, 'x');
    return text;
}

DataItem shapeOf(Chance& chance) {
    constexpr std::array<std::uint32_t, 8> lengths{1, 1, 1, 1, 1, 3, 65, 200};
    constexpr std::array<std::uint32_t, 4> capacities{1, 4, 64, 4096};
    DataItem item;
    item.kind = static_cast<Kind>(chance.below(4));
    item.length = chance.oneOf(lengths);
    if (item.kind == Kind::String) {
        item.capacity = chance.oneOf(capacities);
        if (item.length > 65) item.length = 9;
    } else if (chance.oneIn(150)) {
        item.length = longLength + static_cast<std::uint32_t>(chance.below(5'000));
    }
    return item;
}

DataItem textItem() {
    DataItem item;
    item.kind = Kind::String;
    return item;
}

// A value of its kind in one of the forms that a file may have; of a long array a short one, which
// may be just longer than what can be sent.
std::string valueText(Chance& chance, const DataItem& item) {
    if (item.length < longLength) return writtenAs(chance, randomDefault(chance, item));
    const char* element = item.kind == Kind::Bool ? "true " : chance.oneIn(2) ? "1 " : "-0 ";
    std::string text;
    for (std::uint32_t i = 0; i < item.length; ++i) text += element;
    return text;
}

void addItem(Chance& chance, const std::string& kind, const std::string& name, bool isParameter,
             std::string& xml) {
    DataItem item = shapeOf(chance);
    if (isParameter) {
        item.length = 1;
        item.capacity = 64;
    }
    xml += "<" + kind + " name='" + name + "' kind='" + cortex::name(item.kind) + "' length='" +
           std::to_string(item.length) + "'";
    const auto add = [&](const char* what, const std::string& text) {
        xml += " " + attribute(chance, what, text);
    };
    const bool isInt = item.kind == Kind::Int, isFloat = item.kind == Kind::Float;
    if (item.kind == Kind::String) add("capacity", std::to_string(item.capacity));
    const bool hasLabels = isInt && chance.oneIn(2);
    const bool hasRange = !hasLabels && (isInt || isFloat) && chance.oneIn(3);
    if (hasLabels) add("labels", labelsText(chance));
    if (hasRange) add(chance.oneIn(2) ? "min" : "max", boundText(chance, isInt));
    const bool isFree = !hasLabels && !hasRange;
    if (isFree && (isParameter || chance.oneIn(2))) add("default", valueText(chance, item));
    if (chance.oneIn(4)) add("description", writtenAs(chance, randomDefault(chance, textItem())));
    if (isFloat && chance.oneIn(4)) add("resolution", "-0.0");
    if (isFloat && chance.oneIn(4)) add("unit", "m/s");
    if (!isParameter && chance.oneIn(3)) add("settable", "always");
    if (!isParameter && item.length == 1 && chance.oneIn(3)) add("retain", "true");
    xml += "/>\n";
}

std::string typeElement(Chance& chance, const std::string& name, const std::string& parent,
                        bool isActive) {
    std::string xml =
        "<type name='" + name + "' extends='" + parent + "' " +
        attribute(chance, "version", writtenAs(chance, randomDefault(chance, textItem()))) + ">\n";
    for (std::size_t i = 0; i < 6; ++i) {
        addItem(chance, "data", name + "Item" + std::to_string(i), false, xml);
    }
    if (isActive) {
        xml += "<command name='" + name + "Do' timeout='-0.0'>";
        addItem(chance, "request", "given", true, xml);
        addItem(chance, "response", "got", true, xml);
        xml += "</command>\n";
    }
    return xml + "</type>\n";
}

// Any octets.
std::string oddText(Chance& chance) {
    std::string text;
    const std::size_t size = chance.below(40);
    const bool isAscii = chance.oneIn(2);
    while (text.size() < size) text += static_cast<char>(chance.below(isAscii ? 128 : 256));
    return text;
}

}  // namespace

bool isOdd(const DataItem& item) { return item.name.find("Item") != std::string::npos; }

Value oddValue(Chance& chance, const DataItem& item) {
    DataItem free = item;
    if (item.length >= longLength) free.length = 1;
    const bool isWrong = chance.oneIn(4);
    if (isWrong && item.kind == Kind::String) {
        return std::vector<std::string>(item.length, oddText(chance));
    }
    if (isWrong) {
        free.min = free.max = std::nullopt;
        free.labels.clear();
    }
    Value value = randomValue(chance, free);
    std::visit([&](auto& elements) { elements.resize(item.length, elements.front()); }, value);
    return value;
}

std::string oddOntology(Chance& chance) {
    return "<ontology name='t'><include file='base.xml'/>\n" +
           typeElement(chance, "Plain", "Concept", false) +
           typeElement(chance, "Wide", "Plain", false) +
           typeElement(chance, "Busy", "Active", true) +
           typeElement(chance, "Busier", "Busy", true) + "</ontology>";
}

std::string oddMorphology() {
    return "<morphology name='m'><include file='base-morphology.xml'/><include file='t.xml'/>"
           "<rules type='Busy'><relationship name='seen' direction='input' target='Plain' "
           "maxAge='0.5'/></rules></morphology>";
}

std::string oddSystem(Chance& chance, const TypeModel& types) {
    std::string system = "<system name='s'><morphology file='m.xml'/>\n";
    const bool isValid = !chance.oneIn(4);
    for (const char* type : {"Plain", "Wide", "Busy", "Busier"}) {
        system += "<simplex path='/" + std::string{type} + "' type='" + type + "'>\n";
        for (const DataItem& item : types.at(type).data) {
            if (!isOdd(item) || chance.oneIn(2)) continue;
            const Value value = oddValue(chance, item);
            if (isValid && !valueError(item, value).empty()) continue;
            system += setElement(item.name, toText(value)) + "\n";
        }
        if (types.isA(type, "Busy")) system += "<relate rule='seen' to='/Wide'/>\n";
        system += "</simplex>\n";
    }
    return system + "</system>";
}

}  // namespace cortex::test
