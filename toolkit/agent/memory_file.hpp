// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/event_memory.hpp"

#include "durable_file.hpp"
#include "repeating.hpp"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
#include <string>

namespace cortex::toolkit {

// Keeps what an agent remembers in a file, so that it is known after a restart. load() before the
// start of the agent, keep() after it, finish() after its end: the program's thread. A thread of
// its own appends five times a second; neither the loop nor who reports events waits for it.
// The file is locked, and at most about twice as large as the memory.
class MemoryFile {
public:
    MemoryFile(std::filesystem::path file, std::string agent, std::shared_ptr<EventMemory> memory);
    ~MemoryFile();
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    // The memory gets what the file holds, unless another process has it. Returns a line that tells
    // it. Throws Error where it is no file of what this agent remembers.
    std::string load();
    void keep();
    // Another start of the agent is there: the file is that one's meanwhile.
    void giveWay(bool away) { away_ = away; }
    void finish();

private:
    // How far the memory is written.
    struct End {
        std::uint64_t place = 0;
        std::size_t size = 0;  // of the file
        EventMemory::Times since{};
    };
    using Clock = std::chrono::steady_clock;

    bool step();          // whether nothing is wrong
    std::string write();  // this and the next: "" or why not
    std::string take(bool beforeStart);
    std::string append();
    std::string writeAnew();
    bool writePage(const OpenFile& file, End& end, bool& more);
    std::string wrongFile() const;
    void read(const OpenFile& file, bool beforeStart);
    void tellDropped(const OpenFile& file, const EventMemory::Times& before) const;
    void tellCrash(std::int64_t epoch, std::int64_t written);
    void markEnd();
    void leaveToOther();
    bool isIntact() const;
    bool isTooLarge(const End& end) const;
    std::string sync();

    std::filesystem::path path_;
    std::string agent_;
    std::shared_ptr<EventMemory> memory_;
    EventMemory::Times begin_;  // of what it keeps by itself
    WriteTrouble trouble_;

    OpenFile file_;  // locked, while this agent writes it
    End end_;
    std::size_t sizeAnew_ = 0;  // when it was written anew
    bool anew_ = false, isRead_ = false, isSynced_ = true;
    int refused_ = 0;  // by who has the file, one after the other
    Clock::time_point synced_{};
    std::set<std::int64_t> known_;  // epochs of which the memory has what the file had

    std::atomic<bool> away_{false};
    Repeating writing_;
};

}  // namespace cortex::toolkit
