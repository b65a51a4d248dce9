// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "record/clock_offset.hpp"
#include "record/pending.hpp"
#include "record/ring.hpp"
#include "record/time_table.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cortex::gui {

// Cycles of one start of an agent without a standstill, counted on from those before.
struct RecordedStretch {
    std::int64_t first = 0;   // index of its first sample
    std::int64_t offset = 0;  // from its cycles to indexes
    std::int64_t epoch = 0;
};

// The samples of one agent have common indexes and times.
struct AgentTime {
    TimeTable table;  // by its clock
    ClockOffset clock;
    std::vector<RecordedStretch> stretches;
    std::int64_t end = 0;  // behind the newest index
    std::int64_t lastCycle = 0, lastNominal = 0;
    std::uint64_t skipped = 0;  // cycles that did not come

    // UTC of our clock: where theirs differs, a sample is where it arrived at the quickest.
    double secondsAt(std::int64_t index) const;
    double indexAt(double seconds) const;
    std::int64_t cycleAt(std::int64_t index) const;
};

// What is recorded for all plots together. Only hear() and viewed() are called by other threads
// than that of the window.
class Recorder {
public:
    static constexpr std::size_t usualLimit = 1'000'000'000;  // bytes

    explicit Recorder(std::size_t capacity = Ring::full, std::size_t limit = usualLimit,
                      std::size_t pending = Pending::usual)
        : pending_{pending}, capacity_{capacity}, limit_{limit} {}

    void hear(const std::string& agent, const comms::AgentImage& image,
              std::optional<std::int64_t> came = {}) {
        pending_.hear(agent, image, came);
    }
    std::vector<std::string> viewed() const { return pending_.paths(); }

    // What this viewer shows from now on. What nobody shows any longer is forgotten.
    void record(const void* viewer, std::vector<RecordedItem> items);
    std::vector<RecordedItem> wanted() const;  // by all viewers, each once
    void take();                               // what came; once a frame
    // Null: nothing of it came yet.
    const Ring* ring(const RecordedItem& item) const;
    const AgentTime* time(const std::string& agent) const;
    std::string text(double number) const;  // of an item that is text
    // Samples of a line that are kept; fewer than were asked for where memory is short.
    std::size_t capacity() const { return allowed_ < capacity_ ? allowed_ : capacity_; }
    bool shortened() const { return allowed_ < capacity_; }
    std::uint64_t dropped() const { return pending_.dropped(); }
    std::size_t bytes() const;

private:
    void fit();
    void add(const PendingRows& rows);
    void put(Ring& ring, std::int64_t index, double value, std::uint8_t quality) const;
    void begin(AgentTime& time, const PendingRows& rows, std::size_t row);
    void forgetOld(AgentTime& time) const;

    Pending pending_;
    std::size_t capacity_, limit_, allowed_ = Ring::full;
    std::map<const void*, std::vector<RecordedItem>> wanted_;
    std::map<RecordedItem, Ring> rings_;
    std::map<std::string, AgentTime, std::less<>> times_;
    std::vector<std::string> texts_;
};

}  // namespace cortex::gui
