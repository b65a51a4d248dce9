// SPDX-License-Identifier: Apache-2.0
#include "hook_checker/places.hpp"

#include "cortex/cs/testing.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <sstream>
#include <string_view>
#include <vector>

#include <cxxabi.h>
#include <dlfcn.h>
#include <link.h>

namespace cortex::cs {

namespace {

struct Range {
    std::uintptr_t first, end;
    Module module;
};

constexpr std::size_t mostRanges = 1024;
std::array<Range, mostRanges> ranges;
std::atomic<std::size_t> rangeCount{0};
std::mutex learning;

Module moduleOfFile(std::string_view file, std::uintptr_t first, std::uintptr_t end) {
    const auto has = [&](auto* function) {
        const auto address = reinterpret_cast<std::uintptr_t>(function);
        return first <= address && address < end;
    };
    if (has(&learnModules)) return Module::Checker;
    if (has(&ClusterTesting::runningHook)) return Module::Framework;
    const std::string name = std::filesystem::path{file}.filename().string();
    constexpr std::array system{"libc.", "libc-",      "libstdc++",  "libm.", "libgcc_s",
                                "ld-",   "libpthread", "linux-vdso", "libc++"};
    const bool isSystem =
        std::ranges::any_of(system, [&](const char* each) { return name.starts_with(each); });
    return isSystem ? Module::System : Module::Other;
}

int learn(dl_phdr_info* info, std::size_t /*size*/, void* /*context*/) {
    std::size_t count = rangeCount.load();
    for (int i = 0; i < info->dlpi_phnum && count < mostRanges; ++i) {
        const auto& header = info->dlpi_phdr[i];
        if (header.p_type != PT_LOAD || (header.p_flags & PF_X) == 0) continue;
        const std::uintptr_t first = info->dlpi_addr + header.p_vaddr;
        const std::uintptr_t end = first + header.p_memsz;
        const auto known = std::span{ranges}.first(count);
        if (std::ranges::any_of(known, [&](const Range& each) { return each.first == first; }))
            continue;
        ranges[count++] = {first, end, moduleOfFile(info->dlpi_name, first, end)};
    }
    rangeCount.store(count);
    return 0;
}

std::string run(const std::string& command) {
    std::string output;
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe{popen(command.c_str(), "r"), pclose};
    std::array<char, 1024> text{};
    while (pipe != nullptr && fgets(text.data(), text.size(), pipe.get()) != nullptr)
        output += text.data();
    return output;
}

// Not "::(anonymous namespace)::Tank::stateActive(cortex::Tick const&)" but "Tank::stateActive".
std::string shortened(std::string name) {
    for (const std::string_view noise : {"(anonymous namespace)::", "virtual thunk to ", "non-"}) {
        for (std::size_t at = name.find(noise); at != std::string::npos; at = name.find(noise))
            name.erase(at, noise.size());
    }
    const std::size_t arguments = name.find('(');
    return arguments == std::string::npos || arguments == 0 ? name : name.substr(0, arguments);
}

struct Place {
    std::string function, line;  // empty: not known
};

// Nothing that whoever wrote a hook looks for: a header, or a function of the language's library.
bool isOfTheLanguage(const Place& place) {
    constexpr std::array names{"std::", "__gnu", "__gthread", "operator new", "operator delete"};
    return place.line.starts_with("/usr/include/") || place.line.starts_with("/usr/lib/") ||
           std::ranges::any_of(names,
                               [&](const char* each) { return place.function.starts_with(each); });
}

// Several where functions are inlined, innermost first.
std::vector<Place> placesAt(const std::string& file, std::uintptr_t offset) {
    std::vector<Place> places;
    if (file.find('\'') != std::string::npos) return places;
    std::ostringstream command;
    command << "addr2line -Cfie '" << file << "' 0x" << std::hex << offset << " 2>/dev/null";
    std::istringstream lines{run(command.str())};
    for (std::string function, line; std::getline(lines, function) && std::getline(lines, line);) {
        if (function.starts_with("??")) function.clear();
        line = line.substr(0, line.find(" ("));
        if (line.starts_with("??") || line.ends_with(":?") || line.ends_with(":0")) line.clear();
        places.push_back({shortened(function), line});
    }
    return places;
}

// "": it is the language's.
std::string textOf(const void* address) {
    Dl_info info{};
    if (dladdr(address, &info) == 0 || info.dli_fname == nullptr) return "code of no file";
    const auto offset = reinterpret_cast<std::uintptr_t>(address) -
                        reinterpret_cast<std::uintptr_t>(info.dli_fbase);
    const std::filesystem::path file = std::filesystem::exists(info.dli_fname)
                                           ? info.dli_fname
                                           : std::filesystem::read_symlink("/proc/self/exe");
    std::vector<Place> places = placesAt(file.string(), offset);
    if (places.empty()) places.emplace_back();
    if (places.back().function.empty() && info.dli_sname != nullptr)
        places.back().function = shortened(demangled(info.dli_sname));
    const auto found = std::ranges::find_if_not(places, isOfTheLanguage);
    if (found == places.end()) return "";
    if (!found->line.empty())
        return found->function + " at " + std::filesystem::path{found->line}.filename().string();
    std::ostringstream text;
    if (!found->function.empty()) text << found->function << " in ";
    text << file.filename().string() << "+0x" << std::hex << offset;
    return text.str();
}

}  // namespace

void learnModules() {
    const std::lock_guard lock{learning};
    dl_iterate_phdr(learn, nullptr);
}

Module moduleOf(const void* address) {
    const auto at = reinterpret_cast<std::uintptr_t>(address);
    for (const Range& range : std::span{ranges}.first(rangeCount.load())) {
        if (range.first <= at && at < range.end) return range.module;
    }
    return Module::Other;
}

std::string placeOf(std::span<const void* const> frames) {
    const auto known = frames.first(static_cast<std::size_t>(
        std::ranges::find(frames, static_cast<const void*>(nullptr)) - frames.begin()));
    for (const Module wanted : {Module::Other, Module::Framework, Module::System}) {
        for (const void* each : known) {
            if (moduleOf(each) != wanted) continue;
            std::string text = textOf(each);
            // Whoever calls hooks: the hook's own frame was given up for its last call.
            if (text.find("TaskRunner::") != std::string::npos)
                return "the last call of the hook (-fno-optimize-sibling-calls tells its line)";
            if (!text.empty()) return text;
        }
    }
    return "";
}

std::string demangled(const char* name) {
    int status = 0;
    const std::unique_ptr<char, void (*)(void*)> text{
        abi::__cxa_demangle(name, nullptr, nullptr, &status), std::free};
    return text == nullptr ? name : text.get();
}

}  // namespace cortex::cs
