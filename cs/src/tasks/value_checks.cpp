// SPDX-License-Identifier: Apache-2.0
#include "tasks/value_checks.hpp"

#include "cortex/core/cell.hpp"
#include "cortex/core/labelled_value.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <variant>

namespace cortex::cs {

namespace {

template <class T>
T boundOf(const std::optional<Number>& bound, T otherwise) {
    if (!bound) return otherwise;
    return std::visit([](auto number) { return static_cast<T>(number); }, *bound);
}

// What the framework writes into every active simplex; the progress of a long command is its own.
bool writtenByFramework(const TypeModel& types, const Type& type, const DataItem& item) {
    if (item.name == "progress") return false;
    constexpr std::array<std::string_view, 2> bases{"Active", "Activity"};
    return std::ranges::any_of(bases, [&](std::string_view name) {
        const Type* base = types.find(name);
        return base != nullptr && type.isA(name) && base->findData(item.name) != nullptr;
    });
}

// Neighbours with one range become one.
template <class T>
void join(std::vector<ValueRun<T>> found, std::vector<ValueRun<T>>& runs) {
    std::ranges::sort(found, {}, &ValueRun<T>::first);
    const std::size_t begin = runs.size();
    for (const ValueRun<T>& each : found) {
        const bool joins = runs.size() > begin && runs.back().end == each.first &&
                           runs.back().min == each.min && runs.back().max == each.max;
        if (joins)
            runs.back().end = each.end;
        else
            runs.push_back(each);
    }
}

}  // namespace

ValueChecks::ValueChecks(const TypeModel& types, const TypeLayout& layout, const Slice& values,
                         std::uint32_t simplex, ValueRuns& runs)
    : simplex_{simplex} {
    ValueRuns found;
    for (const ItemLayout& entry : layout.items) {
        const DataItem& item = *entry.item;
        if (entry.constant || item.measured) continue;
        if (writtenByFramework(types, *layout.type, item)) continue;
        add(item, values.at(item.kind, entry.offset), found);
    }
    join(std::move(found.floats), runs.floats);
    join(std::move(found.ints), runs.ints);
    runs.labels.insert(runs.labels.end(), found.labels.begin(), found.labels.end());
    if (!texts_.empty()) runs.texts.push_back({&faultsSeen_});
    changes_.reserve(2 * items_.size() + texts_.size());
}

void ValueChecks::add(const DataItem& item, const void* cells, ValueRuns& runs) {
    if (item.kind == Kind::String) {
        texts_.push_back({&item, static_cast<const std::byte*>(cells)});
        return;
    }
    constexpr double greatest = std::numeric_limits<double>::max();
    const bool ranged = item.min || item.max || isClosed(item);
    if (item.kind != Kind::Float && !(item.kind == Kind::Int && ranged)) return;
    Item added{&item, cells, boundOf(item.min, -greatest), boundOf(item.max, greatest), 0, 0};
    if (item.kind == Kind::Int) {
        addInts(added, runs);
    } else {
        const auto* first = static_cast<const double*>(cells);
        runs.floats.push_back({first, first + item.length, added.min, added.max});
    }
    items_.push_back(added);
}

// Labels without gaps are a range like any other.
void ValueChecks::addInts(Item& item, ValueRuns& runs) {
    using Int = std::numeric_limits<std::int64_t>;
    const DataItem& type = *item.item;
    const auto* first = static_cast<const std::int64_t*>(item.cells);
    item.minInt = boundOf(type.min, Int::min());
    item.maxInt = boundOf(type.max, Int::max());
    if (isClosed(type)) {
        item.minInt = type.labels.begin()->first;
        item.maxInt = type.labels.rbegin()->first;
        item.gaps =
            static_cast<std::uint64_t>(item.maxInt) - static_cast<std::uint64_t>(item.minInt) >=
            type.labels.size();
    }
    if (item.gaps)
        runs.labels.push_back({first, first + type.length, &type.labels});
    else
        runs.ints.push_back({first, first + type.length, item.minInt, item.maxInt});
}

// True: one of its values is wrong; the first of them, or the first that is not finite, is found.
bool ValueChecks::judge(const Item& item, Change& found) {
    bool wrong = false;
    for (std::uint32_t i = 0; i < item.item->length; ++i) {
        if (item.item->kind == Kind::Int) {
            const std::int64_t value = static_cast<const std::int64_t*>(item.cells)[i];
            const bool inRange = value >= item.minInt && value <= item.maxInt;
            if (inRange && (!item.gaps || item.item->labels.contains(value))) continue;
            found = {Change::Of::OutOfRange, item.item, static_cast<double>(value)};
            return true;
        }
        const double value = static_cast<const double*>(item.cells)[i];
        if (value >= item.min && value <= item.max) continue;
        const bool notFinite = !std::isfinite(value);
        if (!wrong || notFinite)
            found = {notFinite ? Change::Of::NotFinite : Change::Of::OutOfRange, item.item, value};
        wrong = true;
        if (notFinite) return true;
    }
    return wrong;
}

ValueChecks::Result ValueChecks::examine() {
    Result result;
    changes_.clear();
    for (Item& item : items_) {
        Change found{};
        const bool wrong = judge(item, found);
        const bool notFinite = wrong && found.of == Change::Of::NotFinite;
        if (item.notFinite && !notFinite) changes_.push_back({Change::Of::FiniteAgain, item.item});
        if (wrong && (!item.inEpisode || notFinite != item.notFinite)) changes_.push_back(found);
        item.inEpisode = wrong;
        item.notFinite = notFinite;
        result.any = result.any || wrong;
        result.notFinite = result.notFinite || notFinite;
        result.outOfRange = result.outOfRange || (wrong && !notFinite);
    }
    examineTexts();
    return result;
}

// A text stays as it is: a hook may want it so, and only others cannot read it.
void ValueChecks::examineTexts() {
    const std::uint64_t faults = textFaults();
    if (texts_.empty() || faultsSeen_ == faults) return;
    faultsSeen_ = faults;
    for (Text& text : texts_) {
        for (std::uint32_t i = 0; i < text.item->length && !text.told; ++i) {
            const auto* cell = reinterpret_cast<const StringCell*>(
                text.cells + i * StringCell::size(text.item->capacity));
            const char* fault = textFault(cell->view());
            if (fault == nullptr) continue;
            text.told = true;
            changes_.push_back({Change::Of::Text, text.item, 0, fault});
        }
    }
}

}  // namespace cortex::cs
