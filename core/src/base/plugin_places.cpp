// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/plugin_places.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <dlfcn.h>
#include <link.h>

namespace cortex {
namespace {

struct PluginPlace {
    std::uintptr_t begin = UINTPTR_MAX, end = 0, base = 0;
    const char* file = nullptr;  // never freed
};

constexpr std::size_t mostPlugins = 64;  // those after them are not named
std::array<PluginPlace, mostPlugins> places;
std::atomic<std::size_t> count{0};

// All segments of the library that the place has the base of.
int addSegments(dl_phdr_info* info, std::size_t /*size*/, void* data) {
    auto& place = *static_cast<PluginPlace*>(data);
    if (info->dlpi_addr != place.base) return 0;
    for (std::size_t i = 0; i < info->dlpi_phnum; ++i) {
        const ElfW(Phdr)& segment = info->dlpi_phdr[i];
        if (segment.p_type != PT_LOAD) continue;
        const std::uintptr_t begin = place.base + segment.p_vaddr;
        place.begin = std::min(place.begin, begin);
        place.end = std::max(place.end, begin + segment.p_memsz);
    }
    return 1;
}

}  // namespace

void notePlugin(void* library, const std::string& file) {
    link_map* map = nullptr;
    const std::size_t next = count.load();
    if (next == mostPlugins || dlinfo(library, RTLD_DI_LINKMAP, static_cast<void*>(&map)) != 0)
        return;
    PluginPlace& place = places[next];
    place.base = map->l_addr;
    dl_iterate_phdr(addSegments, &place);
    place.file = strdup(file.c_str());
    count.store(next + 1);
}

const char* pluginAt(const void* address) {
    const auto at = reinterpret_cast<std::uintptr_t>(address);
    const std::size_t known = count.load();
    for (std::size_t i = 0; i < known; ++i) {
        if (at >= places[i].begin && at < places[i].end) return places[i].file;
    }
    return nullptr;
}

}  // namespace cortex
