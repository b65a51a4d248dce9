// SPDX-License-Identifier: Apache-2.0
#include "cortex/cs/hook_checker.hpp"

#include "cortex/core/error.hpp"
#include "cortex/cs/testing.hpp"

#include "hook_checker/offence.hpp"
#include "hook_checker/page_faults.hpp"
#include "hook_checker/places.hpp"
#include "hook_checker/system_calls.hpp"

#include <algorithm>
#include <map>
#include <mutex>
#include <string_view>
#include <utility>

#include <dlfcn.h>

namespace cortex::cs {

namespace {

std::mutex reasonMutex;
std::string reasonWithoutPageFaults;

// "of 24 bytes", or "of 16 to 64 bytes".
std::string bytes(const Record& record) {
    const std::int64_t least = record.least, most = record.most;
    std::string text = "of " + std::to_string(least);
    if (most != least) text += " to " + std::to_string(most);
    return text + (most == 1 ? " byte" : " bytes");
}

std::string whatOf(const Record& record) {
    switch (record.offence) {
        case Offence::Allocation:
            return "allocation " + bytes(record);
        case Offence::Release:
            return "memory given back";
        case Offence::Lock:
            return std::string{"lock by "} + record.name;
        case Offence::SystemCall:
            return "system call " + nameOfSystemCall(static_cast<long>(record.most.load()));
        case Offence::PageFault:
            return "page fault";
        case Offence::Throw:
            return "throw of " + demangled(record.name);
        case Offence::Output:
            break;
    }
    constexpr std::string_view files[] = {"a file", "", "standard output", "standard error"};
    return "output to " + std::string{files[record.most + 1]} + " by " + record.name;
}

// An address says the same as long as its file is loaded, and asking takes a process.
std::string knownPlaceOf(const Record& record) {
    static std::mutex mutex;
    static std::map<decltype(Record::frames), std::string> known;
    const std::lock_guard lock{mutex};
    const auto found = known.find(record.frames);
    if (found != known.end()) return found->second;
    return known.emplace(record.frames, placeOf(record.frames)).first->second;
}

HookViolation violationOf(const Record& record) {
    return {record.path.data(), record.type.data(),   record.hook.data(),
            whatOf(record),     knownPlaceOf(record), record.count.load()};
}

bool isSame(const HookViolation& a, const HookViolation& b) {
    return a.path == b.path && a.hook == b.hook && a.what == b.what && a.where == b.where;
}

std::vector<HookViolation> merged(const std::vector<const Record*>& all) {
    std::vector<HookViolation> result;
    for (const Record* record : all) {
        HookViolation violation = violationOf(*record);
        const auto same = std::find_if(result.begin(), result.end(),
                                       [&](const auto& each) { return isSame(each, violation); });
        if (same == result.end())
            result.push_back(std::move(violation));
        else
            same->count += violation.count;
    }
    if (unrecorded() > 0) {
        result.push_back({"", "", "", "more than there is room for", "", unrecorded()});
    }
    return result;
}

class TheHookChecker final : public HookChecker {};

// Whoever comes first in the process is asked.
void requireOwnMalloc() {
    Dl_info found{}, own{};
    dladdr(dlsym(RTLD_DEFAULT, "malloc"), &found);
    dladdr(reinterpret_cast<void*>(&cortexHookChecker), &own);
    if (found.dli_fbase == own.dli_fbase) return;
    throw Error(std::string{"hooks cannot be checked: malloc is that of "} +
                (found.dli_fname == nullptr ? "another file" : found.dli_fname) +
                "; link cortex::hook_checker before it, and leave sanitizers out");
}

}  // namespace

bool HookCounts::none() const {
    return allocations + locks + systemCalls + pageFaults + throws + outputs == 0;
}

std::string HookCounts::text() const {
    const std::pair<std::uint64_t, const char*> all[] = {{allocations, " allocations, "},
                                                         {locks, " locks, "},
                                                         {systemCalls, " system calls, "},
                                                         {futexCalls, " futex calls, "},
                                                         {throws, " throws, "},
                                                         {pageFaults, " page faults, "},
                                                         {outputs, " outputs"}};
    std::string text;
    for (const auto& [count, name] : all) text += std::to_string(count) + name;
    return text;
}

HookChecker& HookChecker::ofProcess() {
    static TheHookChecker checker;
    return checker;
}

void HookChecker::watch(ClusterCS& cluster) {
    requireOwnMalloc();
    ClusterTesting::onThreadStart(cluster, [this] { watchThisThread(); });
}

void HookChecker::watchThisThread() {
    const std::string reason = trapPageFaultsOfThisThread();
    {
        const std::lock_guard lock{reasonMutex};
        reasonWithoutPageFaults = reason;
    }
    watchHooksOfThisThread();
    trapSystemCallsOfThisThread();
}

void HookChecker::enterTick() { setInTick(true); }
void HookChecker::leaveTick() { setInTick(false); }

std::vector<HookViolation> HookChecker::violations() const {
    learnModules();
    return merged(records());
}

std::vector<HookViolation> HookChecker::newViolations() {
    std::vector<const Record*> all = records();
    if (all.size() == given_) return {};
    learnModules();
    const std::size_t before = std::exchange(given_, all.size());
    return merged({all.begin() + static_cast<std::ptrdiff_t>(before), all.end()});
}

HookCounts HookChecker::counts() const {
    return {countOf(Offence::Allocation) + countOf(Offence::Release),
            countOf(Offence::Lock),
            countOf(Offence::SystemCall),
            futexCount(),
            countOf(Offence::PageFault),
            countOf(Offence::Throw),
            countOf(Offence::Output)};
}

std::string HookChecker::withoutPageFaults() const {
    const std::lock_guard lock{reasonMutex};
    return reasonWithoutPageFaults;
}

void HookChecker::reset() {
    given_ = 0;
    forgetOffences();
}

}  // namespace cortex::cs

extern "C" cortex::cs::HookChecker* cortexHookChecker() {
    return &cortex::cs::HookChecker::ofProcess();
}
