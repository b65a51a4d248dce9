// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/structure.hpp"
#include "cortex/core/text_faults.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace cortex::cs {

// Neighbours in a table that have one range.
template <class T>
struct ValueRun {
    const T *first, *end;
    T min, max;

    bool passes() const CORTEX_REALTIME {
        const T* value = first;
        do {
            if (!(*value >= min && *value <= max)) return false;
        } while (++value != end);
        return true;
    }
};
// An item whose labels are its range, and leave gaps.
struct LabelRun {
    const std::int64_t *first, *end;
    const std::map<std::int64_t, std::string>* labels;

    bool passes() const CORTEX_REALTIME {
        return std::all_of(first, end,
                           [this](std::int64_t each) { return labels->contains(each); });
    }
};
// The texts of one simplex, which are looked at again after any text has got a fault.
struct TextRun {
    const std::uint64_t* seen;

    bool passes() const CORTEX_REALTIME { return *seen == textFaults(); }
};
struct ValueRuns {
    std::vector<ValueRun<double>> floats;
    std::vector<ValueRun<std::int64_t>> ints;
    std::vector<LabelRun> labels;
    std::vector<TextRun> texts;
};

// Looks at what a task has written where nothing limits it: an observation, or its own items. Not
// finite, or out of the range of the type, which labels are where there is no other; of a text,
// whether others can read it. Built by start(); used by the task that writes, where the runs that
// it gave the task do not pass.
class ValueChecks {
public:
    // The first cycle of an episode of one item, or after one in which it was no number.
    struct Change {
        enum class Of : std::uint8_t { OutOfRange, NotFinite, FiniteAgain, Text } of;
        const DataItem* item;
        double value = 0;
        const char* text = nullptr;  // the fault of a text, which is told once
    };
    struct Result {
        bool any = false;
        bool notFinite = false;
        bool outOfRange = false;
    };

    // `simplex`: that has the values. Items of the framework and measured ones are not looked at.
    // Adds to the runs what is to pass.
    ValueChecks(const TypeModel& types, const TypeLayout& layout, const Slice& values,
                std::uint32_t simplex, ValueRuns& runs);

    ValueChecks(const ValueChecks&) = delete;
    ValueChecks& operator=(const ValueChecks&) = delete;

    bool empty() const { return items_.empty() && texts_.empty(); }
    std::uint32_t simplex() const { return simplex_; }
    // What is wrong, item by item.
    Result examine() CORTEX_REALTIME;
    std::span<const Change> changes() const { return changes_; }  // of the last examine()

private:
    struct Item {
        const DataItem* item;
        const void* cells;
        double min, max;
        std::int64_t minInt, maxInt;
        bool inEpisode = false, notFinite = false;
        bool gaps = false;  // only labelled numbers are right, and some between them have none
    };
    struct Text {
        const DataItem* item;
        const std::byte* cells;
        bool told = false;
    };
    void add(const DataItem& item, const void* cells, ValueRuns& runs);
    void examineTexts() CORTEX_REALTIME;
    void addInts(Item& item, ValueRuns& runs);
    static bool judge(const Item& item, Change& found) CORTEX_REALTIME;

    std::uint32_t simplex_;
    std::vector<Item> items_;
    std::vector<Text> texts_;
    std::uint64_t faultsSeen_ = 0;
    std::vector<Change> changes_;
};

}  // namespace cortex::cs
