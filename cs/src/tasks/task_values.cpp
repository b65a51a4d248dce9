// SPDX-License-Identifier: Apache-2.0
#include "tasks/task_values.hpp"

#include "cortex/core/labelled_value.hpp"

#include <optional>
#include <variant>

namespace cortex::cs {

namespace {

EventText& operator<<(EventText& text, const Number& number) {
    if (const auto* whole = std::get_if<std::int64_t>(&number)) return text << *whole;
    return text << std::get<double>(number);
}

// The bound that a value is beyond; itself where there is none.
double boundBeyond(const DataItem& item, double value) {
    const auto number = [value](const std::optional<Number>& bound) {
        if (!bound) return value;
        return std::visit([](auto each) { return static_cast<double>(each); }, *bound);
    };
    return value > number(item.max) ? number(item.max) : number(item.min);
}

// The labels are the range of an item that has no other.
void describeRange(const DataItem& item, EventText& text) {
    if (isClosed(item)) {
        text << ", none of its labels";
        for (const auto& [number, label] : item.labels) text << " " << number << ":" << label;
        return;
    }
    text << ", out of its range ";
    if (item.min) text << *item.min;
    text << " .. ";
    if (item.max) text << *item.max;
}

}  // namespace

bool TaskValues::examine(const Task& task) {
    bool any = false;
    for (const TaskOutput& output : set_.outputsOf(task)) {
        if (output.checks != nullptr) any = examine(task, *output.checks, *output.state) || any;
    }
    ValueChecks* own = set_.detailsOf(task).checks;
    if (own != nullptr) any = examine(task, *own, set_.states[task.index]) || any;
    return any;
}

bool TaskValues::examine(const Task& task, ValueChecks& checks, SlotState& state) {
    const ValueChecks::Result result = checks.examine();
    for (const ValueChecks::Change& each : checks.changes()) report(checks, each, task);
    if (!result.any) return false;
    if (result.outOfRange) ++task.simplex->thread_->limits;
    if (result.notFinite && state.quality < Quality::Bad) {
        state.quality = Quality::Bad;
        state.cause = checks.simplex();
    }
    return true;
}

// One event for each item whose episode begins. That a value is no number has an end, too.
void TaskValues::report(const ValueChecks& checks, const ValueChecks::Change& each,
                        const Task& task) {
    using Of = ValueChecks::Change::Of;
    const DataItem& item = *each.item;
    EventText text{item.name};
    text << " of " << set_.structure.simplexes[checks.simplex()].path;
    switch (each.of) {
        case Of::Text:
            text << " " << each.text << ": other agents and tools "
                 << (each.text == std::string_view{"is not UTF-8"} ? "may not show it"
                                                                   : "get what is in front of it")
                 << (item.retain ? ", and its last good value is retained" : "");
            break;
        case Of::NotFinite:
            text << " is not a number: its quality is bad";
            break;
        case Of::FiniteAgain:
            text << " is a number again";
            break;
        case Of::OutOfRange:
            text << " is ";
            text.apart(each.value, boundBeyond(item, each.value));
            if (!item.unit.empty()) text << " " << item.unit;
            describeRange(item, text);
    }
    const Severity severity = each.of == Of::FiniteAgain ? Severity::Info : Severity::Warning;
    set_.agent.post(*task.simplex->thread_->loop, severity, EventKind::Limit, task.index, text);
}

}  // namespace cortex::cs
