// SPDX-License-Identifier: Apache-2.0
#include "texts/random_model.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace cortex::test {
namespace {

constexpr const char* copyEnd = "Copy";

// What an item is for besides being shown: may be set, is constant, or only has its value.
enum class Use { Settable, Constant, Plain };

std::uint32_t randomLength(Chance& chance, bool array) {
    constexpr std::array<std::uint32_t, 6> lengths{2, 3, 7, 64, 65, 600};
    return array ? chance.oneOf(lengths) : 1;
}

void giveRange(Chance& chance, DataItem& item) {
    DataItem free = item;
    const auto bound = [&]() -> Number {
        const Value value = randomDefault(chance, free);
        if (item.kind == Kind::Int) return std::get<std::vector<std::int64_t>>(value).front();
        return std::get<std::vector<double>>(value).front();
    };
    item.min = bound();
    item.max = bound();
    if (*item.max < *item.min) std::swap(item.min, item.max);
    if (chance.oneIn(4)) item.max.reset();
}

void giveLabels(Chance& chance, DataItem& item) {
    std::vector<std::string> words{"Off", "On", "1e3", "-", "0x1", "a:b", "<é&\">", "]]>", "1.0"};
    const auto count = 2 + chance.below(6);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t place = chance.below(words.size());
        const std::int64_t number = static_cast<std::int64_t>(chance.below(17)) - 8;
        if (item.labels.emplace(number, words[place]).second) {
            words.erase(words.begin() + static_cast<std::ptrdiff_t>(place));
        }
    }
}

DataItem randomItem(Chance& chance, const std::string& name, Kind kind, Use use, bool array) {
    DataItem item;
    item.name = name;
    item.kind = kind;
    item.length = randomLength(chance, array);
    if (kind == Kind::String) {
        constexpr std::array<std::uint32_t, 5> capacities{1, 4, 63, 64, 500};
        item.capacity = array                  ? 1 + static_cast<std::uint32_t>(chance.below(80))
                        : use == Use::Settable ? chance.oneOf(capacities)
                                               : 4096U;
        if (array) item.length = use == Use::Settable ? 65 : std::min(item.length, 7U);
    }
    if (kind == Kind::Int && chance.oneIn(3))
        giveLabels(chance, item);
    else if ((kind == Kind::Int || kind == Kind::Float) && !array && chance.oneIn(3))
        giveRange(chance, item);
    if (use == Use::Settable) item.settable = StateSet::always();
    item.constant = use == Use::Constant;
    item.retain = !item.constant && (kind != Kind::String || !array) && chance.oneIn(2);
    item.hasDefault = !item.labels.empty() || chance.oneIn(2);
    item.initial = randomDefault(chance, item);
    return item;
}

RandomType randomType(Chance& chance, const std::string& name) {
    RandomType type{name, {}};
    for (const Kind kind : {Kind::Int, Kind::Float, Kind::Bool, Kind::String}) {
        for (const Use use : {Use::Settable, Use::Constant, Use::Plain}) {
            for (const bool array : {false, false, true}) {
                const std::string number = std::to_string(type.items.size());
                DataItem item = randomItem(chance, "a" + number, kind, use, array);
                DataItem copy = item;
                copy.name += copyEnd;
                copy.settable = StateSet::none();
                copy.constant = copy.retain = false;
                copy.hasDefault = true;
                copy.initial = randomDefault(chance, copy);
                type.items.push_back(std::move(item));
                type.items.push_back(std::move(copy));
            }
        }
    }
    return type;
}

bool isCopy(const DataItem& item) { return item.name.ends_with(copyEnd); }

std::string numberText(Chance& chance, const Number& number) {
    const Value value = std::holds_alternative<double>(number)
                            ? Value{std::vector{std::get<double>(number)}}
                            : Value{std::vector{std::get<std::int64_t>(number)}};
    return writtenAs(chance, value);
}

std::string itemElement(Chance& chance, const DataItem& item) {
    std::string text = "<data name='" + item.name + "' kind='" + name(item.kind) + "' length='" +
                       std::to_string(item.length) + "'";
    const auto add = [&](const char* what, const std::string& value) {
        text += " " + attribute(chance, what, value);
    };
    if (item.kind == Kind::String) add("capacity", std::to_string(item.capacity));
    if (item.min) add("min", numberText(chance, *item.min));
    if (item.max) add("max", numberText(chance, *item.max));
    std::string labels;
    for (const auto& [number, label] : item.labels) {
        labels += (labels.empty() ? "" : " ") + std::to_string(number) + ":" + label;
    }
    if (!labels.empty()) add("labels", labels);
    if (item.hasDefault) add("default", writtenAs(chance, item.initial));
    if (!item.settable.empty()) add("settable", "always");
    if (item.constant) add("constant", "true");
    if (item.retain) add("retain", "true");
    return text + "/>\n";
}

// Where the type states none, as docs/ontology.md has it: zero, moved into the range.
template <class T>
T movedZero(const DataItem& item) {
    T number{};
    if (item.min) number = std::max(number, std::get<T>(*item.min));
    if (item.max) number = std::min(number, std::get<T>(*item.max));
    return number;
}

Value defaultOf(const DataItem& item) {
    if (item.hasDefault) return item.initial;
    if (item.kind == Kind::Int)
        return std::vector<std::int64_t>(item.length, movedZero<std::int64_t>(item));
    if (item.kind == Kind::Float) return std::vector<double>(item.length, movedZero<double>(item));
    if (item.kind == Kind::Bool) return std::vector<bool>(item.length);
    return std::vector<std::string>(item.length);
}

std::string simplexElement(const std::string& path, const RandomType& type,
                           const std::string& inside) {
    return "<simplex path='" + path + "' type='" + type.name + "'>\n" + inside + "</simplex>\n";
}

std::string systemText(const std::string& name, const std::string& simplexes) {
    return "<system name='texts'><morphology file='rules.xml'/>\n<cluster name='" + name +
           "' frequency='50'/>\n" + simplexes + "</system>\n";
}

}  // namespace

const DataItem& RandomType::item(const std::string& wanted) const {
    const auto found = std::ranges::find(items, wanted, &DataItem::name);
    if (found == items.end()) throw std::runtime_error{"no item " + wanted};
    return *found;
}

RandomModel::RandomModel(Chance& chance, std::size_t types, std::size_t simplexes) {
    for (std::size_t i = 0; i < types; ++i) {
        types_.push_back(randomType(chance, "Random" + std::to_string(i)));
        ontology_ += "<type name='" + types_.back().name + "' extends='Carrier'>\n";
        for (const DataItem& item : types_.back().items) ontology_ += itemElement(chance, item);
        ontology_ += "</type>\n";
    }
    for (std::size_t i = 0; i < simplexes; ++i) {
        const RandomType& type = types_[i % types_.size()];
        const std::string number = std::to_string(i);
        RandomSimplex simplex{"/first/part/" + number, "/second/part/" + number, &type, {}};
        std::string settings;
        for (const DataItem& item : type.items) {
            if (isCopy(item) || chance.oneIn(5)) continue;
            const Value value = randomValue(chance, item);
            settings += setting(chance, item.name, writtenAs(chance, value));
            simplex.values[item.name] = value;
        }
        first_ += simplexElement(simplex.path, type, settings);
        second_ += simplexElement(simplex.copyPath, type,
                                  "<relate rule='source' to='" + simplex.path + "' type='" +
                                      type.name + "' remote='true'/>\n");
        simplexes_.push_back(std::move(simplex));
    }
    first_ = systemText("first", first_);
    second_ = systemText("second", second_);
}

const DataItem& RandomModel::item(const std::string& path, const std::string& name) const {
    const auto found = std::ranges::find_if(simplexes_, [&](const RandomSimplex& each) {
        return each.path == path || each.copyPath == path;
    });
    if (found == simplexes_.end()) throw std::runtime_error{"no simplex " + path};
    return found->type->item(name);
}

AllValues RandomModel::start() const {
    AllValues all;
    for (const RandomSimplex& simplex : simplexes_) {
        Values& values = all[simplex.path] = simplex.values;
        for (const DataItem& item : simplex.type->items) {
            values.try_emplace(item.name, defaultOf(item));
        }
    }
    return all;
}

AllValues RandomModel::settable(Chance& chance) const {
    AllValues all;
    for (const RandomSimplex& simplex : simplexes_) {
        for (const DataItem& item : simplex.type->items) {
            if (!item.settable.empty()) all[simplex.path][item.name] = randomValue(chance, item);
        }
    }
    return all;
}

AllValues RandomModel::copies(const AllValues& first) const {
    AllValues all;
    for (const RandomSimplex& simplex : simplexes_) {
        for (const auto& [name, value] : first.at(simplex.path)) {
            if (!name.ends_with(copyEnd)) all[simplex.copyPath][name + copyEnd] = value;
        }
    }
    return all;
}

}  // namespace cortex::test
