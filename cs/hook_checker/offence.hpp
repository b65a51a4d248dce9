// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cortex::cs {

enum class Offence : std::uint8_t {
    Allocation,  // detail: bytes
    Release,
    Lock,        // name: of the function
    SystemCall,  // detail: its number
    PageFault,
    Throw,  // name: of the type, mangled
    Output  // name: of the function, detail: the descriptor, -1 for another file
};
inline constexpr std::size_t offenceKinds = 7;

// What happened at one place. Written by one thread, then only counted.
struct Record {
    static constexpr std::size_t mostFrames = 16;

    std::atomic<bool> isReady{false};
    Offence offence{};
    const char* name = nullptr;
    std::array<char, 129> path{};
    std::array<char, 65> type{}, hook{};
    std::array<const void*, mostFrames> frames{};  // innermost first; null: no more
    std::atomic<std::int64_t> least{0}, most{0};   // of the detail
    std::atomic<std::uint64_t> count{0};
};

// What this thread does counts from now on, where it runs a hook or is in a tick.
void watchHooksOfThisThread();
void setInTick(bool inTick);

// Nothing that this thread does while it lives is an offence: it belongs to one that is noted.
class Quiet {
public:
    Quiet();
    ~Quiet();
    Quiet(const Quiet&) = delete;
    Quiet& operator=(const Quiet&) = delete;
};

// Until a handler has the exception.
void setUnwinding(bool unwinding);

// `at`: the instruction, where it is not the caller.
void note(Offence offence, std::int64_t detail, const char* name, const void* at = nullptr);
// A futex call: an offence where no code of CorteX made it.
void noteFutex(std::int64_t number);

std::vector<const Record*> records();
std::uint64_t countOf(Offence offence);
std::uint64_t futexCount();
std::uint64_t unrecorded();  // for want of room
void forgetOffences();

}  // namespace cortex::cs
