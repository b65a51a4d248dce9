// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/event_memory.hpp"

#include "durable_file.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <string_view>

namespace cortex::toolkit {

// The file of what an agent remembers. Its first line has the form's version and the agent; each
// further one an entry, or from when on everything of a kind is kept. Fields are apart by tabs, and
// octets that would end a field or a line stand as \xNN.
std::string memoryHeader(const std::string& agent);
std::string lineOf(const KeptEvent& event);
std::string sinceLine(EventKind kind, std::int64_t since);
std::string endLine();  // the last one of a start that ended in order

// Why the file may not be written, by its first line without the end; "" where it is this agent's.
std::string otherThanMemory(const std::filesystem::path& file, std::string_view firstLine,
                            const std::string& agent);
std::string firstLineOf(const OpenFile& file);  // without its end; empty: there is none

struct MemoryRead {
    static constexpr std::int64_t unsaid = std::numeric_limits<std::int64_t>::min();

    std::size_t bytes = 0;
    std::size_t unreadable = 0;  // lines
    bool torn = false;           // its last line has no end, as after a crash
    bool ended = false;          // its last line says that the agent ended in order
    std::int64_t epoch = 0;      // of its last entry
    // By kind; what may have stood in lines that cannot be read is not known.
    EventMemory::Times since{};
};
// All of it, with bounded memory. `begin`: what is lost behind the last entry was before it.
MemoryRead readMemory(const OpenFile& file, std::int64_t begin,
                      const std::function<void(KeptEvent)>& take);

}  // namespace cortex::toolkit
