// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/registry.hpp"

#include "cortex/core/agreement.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/plugin_places.hpp"

#include "model/remedies.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>

#include <dlfcn.h>
#include <link.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace cortex {
namespace {

using Library = std::unique_ptr<void, int (*)(void*)>;
using PluginEntry = const PluginDescription* (*)();

// Rounding, flush-to-zero and exception masks; not the flags of what has happened.
unsigned floatingPointMode() {
#if defined(__x86_64__)
    return _mm_getcsr() & 0xffc0U;
#else
    return 0;
#endif
}

void setFloatingPointMode([[maybe_unused]] unsigned mode) {
#if defined(__x86_64__)
    _mm_setcsr((_mm_getcsr() & ~0xffc0U) | mode);
#endif
}

// What the loader would map of a file that was cut off ends the process by a signal. "": all is
// there, or dlopen() says better what it is.
std::string cutOff(const std::filesystem::path& file) {
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(file, error);
    std::ifstream in{file, std::ios::binary};
    ElfW(Ehdr) header{};
    const auto read = [&in](auto& to) {
        return static_cast<bool>(in.read(reinterpret_cast<char*>(&to), sizeof to));
    };
    if (error || !read(header) || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) return {};
    std::uint64_t end = header.e_phoff + std::uint64_t{header.e_phnum} * header.e_phentsize;
    in.seekg(static_cast<std::streamoff>(header.e_phoff));
    ElfW(Phdr) part{};
    for (unsigned i = 0; i < header.e_phnum && read(part); ++i) {
        if (part.p_type == PT_LOAD)
            end = std::max<std::uint64_t>(end, part.p_offset + part.p_filesz);
    }
    if (size >= end) return {};
    return "is cut off: it has " + std::to_string(size) + " octets of at least " +
           std::to_string(end) + "; copy or build it again";
}

// Loading runs the constructors of the plug-in and of what it links. To open a pipe would wait for
// a writer.
Library open(const std::filesystem::path& file, const std::string& who) {
    std::error_code error;
    if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error))
        throw Error{who + "cannot be loaded: it is no file; name the shared object itself"};
    if (const std::string cut = cutOff(file); !cut.empty()) throw Error{who + cut};
    const unsigned before = floatingPointMode();
    Library library{dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL),
                    &dlclose};
    const unsigned after = floatingPointMode();
    setFloatingPointMode(before);
    if (library == nullptr) {
        const char* why = dlerror();
        throw Error{who + "cannot be loaded: " + (why != nullptr ? why : "no reason given")};
    }
    if (after != before) {
        throw Error{who +
                    "changes the floating-point mode when it is loaded, and with it the "
                    "results of every other simplex; build it without -ffast-math, "
                    "-funsafe-math-optimizations and -mdaz-ftz"};
    }
    return library;
}

const PluginDescription& describe(void* library, const std::string& who) {
    const auto entry = reinterpret_cast<PluginEntry>(dlsym(library, "cortexPlugin"));
    const PluginDescription* plugin = entry != nullptr ? entry() : nullptr;
    if (plugin == nullptr) {
        throw Error{who + "exports no cortexPlugin(); add CORTEX_PLUGIN(…) to one source file"};
    }
    return *plugin;
}

void checkBuild(const PluginDescription& plugin, const std::string& who) {
    if (plugin.abi != pluginAbi) {  // what follows the number may lie elsewhere
        throw Error{who + "has plug-in ABI " + std::to_string(plugin.abi) + ", this program has " +
                    std::to_string(pluginAbi) + "; build it against this version of cortex"};
    }
    const std::array<const char*, 3> texts{plugin.compiler, plugin.standardLibrary, plugin.headers};
    if (std::ranges::find(texts, nullptr) != texts.end() || plugin.types == nullptr ||
        plugin.registerClasses == nullptr) {
        throw Error{who +
                    "describes itself with null pointers; let CORTEX_PLUGIN(…) make its "
                    "cortexPlugin()"};
    }
    const std::string compiler = plugin.compiler, library = plugin.standardLibrary;
    if (compiler != compilerOfThisBuild()) {
        throw Error{who + "was built with compiler '" + compiler + "', this program with '" +
                    compilerOfThisBuild() + "'; build it with the same compiler"};
    }
    if (library != standardLibraryOfThisBuild()) {
        throw Error{who + "was built with '" + library + "', this program with '" +
                    standardLibraryOfThisBuild() + "'; build it with the same standard library"};
    }
    if (std::string_view{plugin.headers} != headersOfThisBuild()) {
        throw Error{who + "was built against other headers of cortex (" + plugin.headers +
                    ") than this program (" + headersOfThisBuild() +
                    "); build it anew against the installed headers"};
    }
}

// The types that the plug-in states. One that this model lacks is not used by it either.
std::set<std::string> checkTypes(const PluginDescription& plugin, const TypeModel& types,
                                 const std::string& who) {
    std::set<std::string> stated;
    for (const auto* each = plugin.types; each->name != nullptr; ++each) {
        stated.insert(each->name);
        const Type* type = types.find(each->name);
        const std::string hash = each->hash != nullptr ? each->hash : "";
        if (type == nullptr || hash.empty()) continue;
        const std::string ours = toHex(typeHash(*type));
        if (hash == ours) continue;
        throw Error{who + "implements type " + type->name + " with hash " + hash +
                    ", this model has it with " + ours + " (" + type->place.text() +
                    "); adapt the plug-in to the type, or load the ontology that it was made for"};
    }
    return stated;
}

}  // namespace

void ClassRegistry::addFactory(std::string_view type, Factory factory) {
    if (find(type) != nullptr) {
        throw Error{"type " + std::string{type} + " has a class already; register it once"};
    }
    factories_.emplace(type, std::move(factory));
}

const ClassRegistry::Factory* ClassRegistry::find(std::string_view type) const {
    const auto found = factories_.find(type);
    return found != factories_.end() ? &found->second : nullptr;
}

std::vector<std::string> ClassRegistry::classesFor(const Type& type, const TypeModel& types) const {
    if (find(type.name) != nullptr) return {type.name};
    std::vector<std::string> nearest;
    for (const std::string& ancestor : type.ancestors) {
        if (find(ancestor) != nullptr) nearest.push_back(ancestor);
    }
    const std::vector<std::string> all = nearest;
    std::erase_if(nearest, [&](const std::string& one) {
        return std::ranges::any_of(
            all, [&](const std::string& other) { return other != one && types.isA(other, one); });
    });
    return nearest;
}

std::vector<std::string> ClassRegistry::names() const {
    std::vector<std::string> names;
    for (const auto& [name, factory] : factories_) names.push_back(name);
    return names;
}

void ClassRegistry::loadPlugin(const std::filesystem::path& file, const TypeModel& types) {
    const std::string who = "plug-in " + file.string() + " ";
    Library library = open(file, who);
    const PluginDescription& plugin = describe(library.get(), who);
    checkBuild(plugin, who);
    const std::set<std::string> stated = checkTypes(plugin, types, who);
    void* const forGood = library.release();  // code of it may be in use from here on
    notePlugin(forGood, file.string());
    ClassRegistry added;
    plugin.registerClasses(added);
    for (const auto& name : added.names()) {
        if (!stated.contains(name)) {
            throw Error{who + "registers a class for type " + name +
                        ", but does not state it; add {\"" + name + "\", \"\"} to CORTEX_PLUGIN"};
        }
        if (find(name) != nullptr) throw Error{who + "brings a second class for type " + name};
    }
    for (const std::string& type : stated) {
        if (added.find(type) != nullptr) continue;
        throw Error{who + "states type " + type +
                    " in CORTEX_PLUGIN, but registers no class for it; register one "
                    "(registry.add<…>(\"" +
                    type + "\")), or take it out"};
    }
    factories_.merge(added.factories_);
}

const char* compilerOfThisBuild() { return __VERSION__; }

const char* standardLibraryOfThisBuild() { return CORTEX_STANDARD_LIBRARY; }

const char* headersOfThisBuild() { return CORTEX_HEADER_HASH; }

}  // namespace cortex
