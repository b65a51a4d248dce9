// SPDX-License-Identifier: Apache-2.0
#include "hook_checker/offence.hpp"

#include "cortex/cs/testing.hpp"

#include "hook_checker/places.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <span>
#include <string_view>

#include <execinfo.h>

namespace cortex::cs {

namespace {

struct ThreadState {
    bool isWatched = false, inTick = false, unwinding = false;
    int quiet = 0;
};

// Initial-exec: reading it never allocates.
[[gnu::tls_model("initial-exec")]] thread_local ThreadState self;

constexpr std::size_t mostRecords = 512;
std::array<Record, mostRecords> table;
std::atomic<std::size_t> used{0};
std::atomic<std::uint64_t> withoutRoom{0}, futexCalls{0};
std::array<std::atomic<std::uint64_t>, offenceKinds> counts{};

template <std::size_t Size>
void copy(std::array<char, Size>& to, std::string_view from) {
    const std::size_t length = std::min(from.size(), Size - 1);
    std::copy_n(from.data(), length, to.data());
    to[length] = '\0';
}

using Frames = std::array<const void*, Record::mostFrames>;

// Of the caller's callers; a return address stands behind its call.
Frames framesHere(const void* at) {
    constexpr int ofThisLibrary = 8;  // at most
    std::array<void*, Record::mostFrames + ofThisLibrary> all{};
    const int count = backtrace(all.data(), static_cast<int>(all.size()));
    Frames frames{};
    std::size_t next = 0;
    if (at != nullptr) frames[next++] = at;
    // Of a fault only what stands outside of the instruction that met it.
    bool outside = at == nullptr;
    for (int i = 0; i < count && next < frames.size(); ++i) {
        const void* frame = static_cast<const char*>(all[static_cast<std::size_t>(i)]) - 1;
        if (!outside) {
            outside = static_cast<const char*>(frame) + 1 == at;
            continue;
        }
        if (moduleOf(frame) != Module::Checker) frames[next++] = frame;
    }
    return frames;
}

bool isSame(const Record& record, Offence offence, const char* name, const Frames& frames,
            const ClusterTesting::RunningHook& hook, std::int64_t detail) {
    return record.isReady.load(std::memory_order_acquire) && record.offence == offence &&
           record.name == name && record.frames == frames &&
           (offence != Offence::SystemCall || record.least == detail) &&
           hook.path == record.path.data() && hook.hook == record.hook.data();
}

void add(Record& record, std::int64_t detail) {
    for (std::int64_t least = record.least; detail < least;)
        if (record.least.compare_exchange_weak(least, detail)) break;
    for (std::int64_t most = record.most; detail > most;)
        if (record.most.compare_exchange_weak(most, detail)) break;
    record.count.fetch_add(1, std::memory_order_relaxed);
}

void keep(Offence offence, std::int64_t detail, const char* name, const Frames& frames,
          const ClusterTesting::RunningHook& hook) {
    counts[static_cast<std::size_t>(offence)].fetch_add(1, std::memory_order_relaxed);
    const std::size_t size = std::min(used.load(std::memory_order_acquire), mostRecords);
    for (Record& record : std::span{table}.first(size)) {
        if (isSame(record, offence, name, frames, hook, detail)) return add(record, detail);
    }
    const std::size_t place = used.fetch_add(1);
    if (place >= mostRecords) {
        used.store(mostRecords);
        withoutRoom.fetch_add(1, std::memory_order_relaxed);
        return;
    }
    Record& record = table[place];
    record.offence = offence;
    record.name = name;
    record.frames = frames;
    copy(record.path, hook.path);
    copy(record.type, hook.type);
    copy(record.hook, hook.hook);
    record.least = detail;
    record.most = detail;
    record.count = 1;
    record.isReady.store(true, std::memory_order_release);
}

}  // namespace

void watchHooksOfThisThread() {
    const Quiet quiet;
    learnModules();
    static_cast<void>(framesHere(nullptr));  // the first one loads a library
    self.isWatched = true;
}

void setInTick(bool inTick) { self.inTick = inTick; }
void setUnwinding(bool unwinding) { self.unwinding = unwinding && self.isWatched; }

Quiet::Quiet() { ++self.quiet; }
Quiet::~Quiet() { --self.quiet; }

void note(Offence offence, std::int64_t detail, const char* name, const void* at) {
    if (!self.isWatched || self.quiet != 0 || self.unwinding) return;
    const Quiet quiet;
    const int before = errno;
    const ClusterTesting::RunningHook hook = ClusterTesting::runningHook();
    if (!hook.path.empty() || self.inTick) keep(offence, detail, name, framesHere(at), hook);
    errno = before;
}

void noteFutex(std::int64_t number) {
    if (!self.isWatched || self.quiet != 0 || self.unwinding) return;
    const Quiet quiet;
    const ClusterTesting::RunningHook hook = ClusterTesting::runningHook();
    if (hook.path.empty() && !self.inTick) return;
    futexCalls.fetch_add(1, std::memory_order_relaxed);
    if (hook.path.empty()) return;
    const Frames frames = framesHere(nullptr);
    const auto owner = std::ranges::find_if(
        frames, [](const void* each) { return moduleOf(each) != Module::System; });
    if (owner == frames.end() || moduleOf(*owner) == Module::Framework) return;
    keep(Offence::SystemCall, number, nullptr, frames, hook);
}

std::vector<const Record*> records() {
    std::vector<const Record*> ready;
    const std::size_t size = std::min(used.load(std::memory_order_acquire), mostRecords);
    for (const Record& record : std::span{table}.first(size)) {
        if (!record.isReady.load(std::memory_order_acquire)) break;  // the order stays
        ready.push_back(&record);
    }
    return ready;
}

std::uint64_t countOf(Offence offence) { return counts[static_cast<std::size_t>(offence)]; }
std::uint64_t futexCount() { return futexCalls; }
std::uint64_t unrecorded() { return withoutRoom; }

void forgetOffences() {
    for (Record& record : table) record.isReady = false;
    used = 0;
    withoutRoom = 0;
    futexCalls = 0;
    for (auto& count : counts) count = 0;
}

}  // namespace cortex::cs
