// SPDX-License-Identifier: Apache-2.0
#include "memory_probe.hpp"

#include <array>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include <fcntl.h>
#include <malloc.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace cortex::profiler {
namespace {

using Text = std::array<char, 4096>;

std::string_view contents(const char* file, Text& text) {
    const int from = open(file, O_RDONLY | O_CLOEXEC);
    std::size_t size = 0;
    while (from >= 0 && size < text.size() - 1) {
        const ssize_t part = read(from, text.data() + size, text.size() - 1 - size);
        if (part <= 0) break;
        size += static_cast<std::size_t>(part);
    }
    if (from >= 0) close(from);
    text[size] = '\0';
    return {text.data(), size};
}

double numberAfter(std::string_view text, std::string_view word) {
    const std::size_t at = text.find(word);
    return at == std::string_view::npos ? 0 : std::strtod(text.data() + at + word.size(), nullptr);
}

}  // namespace

MemoryUse memoryUse() {
    const struct mallinfo2 info = mallinfo2();
    Text text;
    const std::string_view rollup = contents("/proc/self/smaps_rollup", text);
    constexpr double kibi = 1024;
    return {static_cast<double>(info.uordblks + info.hblkhd), kibi * numberAfter(rollup, "\nRss:"),
            kibi * numberAfter(rollup, "\nPss:"), kibi * numberAfter(rollup, "\nPrivate_Dirty:")};
}

int openHandles() {
    const int folder = open("/proc/self/fd", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return 0;
    alignas(8) std::array<char, 4096> entries;
    int count = -3;  // itself, "." and ".."
    for (;;) {
        const long size = syscall(SYS_getdents64, folder, entries.data(), entries.size());
        if (size <= 0) break;
        for (long at = 0; at < size; ++count) {
            std::uint16_t length = 0;  // linux_dirent64: inode and offset before it, 8 each
            std::memcpy(&length, entries.data() + at + 16, sizeof length);
            at += length;
        }
    }
    close(folder);
    return count;
}

int runningThreads() {
    Text text;
    return static_cast<int>(numberAfter(contents("/proc/self/status", text), "\nThreads:"));
}

}  // namespace cortex::profiler
