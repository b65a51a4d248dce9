// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/header_hash.hpp"
#include "cortex/core/simplex.hpp"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cortex {

inline constexpr int pluginAbi = 4;

// C++ classes of active types, by type name; also from shared-object plug-ins. Setup phase.
class ClassRegistry {
public:
    using Factory = std::function<std::unique_ptr<Simplex>(Simplex::Identity)>;

    template <class T>
    void add(std::string_view type) {
        addFactory(type,
                   [](Simplex::Identity identity) { return makeSimplex<T>(std::move(identity)); });
    }
    void addFactory(std::string_view type, Factory factory);  // throws Error if the type has one
    const Factory* find(std::string_view type) const;
    // The types whose class a simplex of this type may run: itself, or else its nearest ancestors
    // with a class, none of which extends another. One: that class is used. Several: none is, as
    // only a class of its own can say how they go together.
    std::vector<std::string> classesFor(const Type& type, const TypeModel& types) const;
    std::vector<std::string> names() const;

    // Loads a plug-in for good and registers its classes. Throws Error in words when its ABI
    // number, compiler, standard library or headers differ, when it changed the floating-point
    // mode, when the hash of a type it implements differs from ours, or when what it registers is
    // not what it states.
    void loadPlugin(const std::filesystem::path& file, const TypeModel& types);

private:
    std::map<std::string, Factory, std::less<>> factories_;
};

// What a plug-in exports under the C symbol `cortexPlugin`; CORTEX_PLUGIN defines it.
struct PluginDescription {
    int abi;
    const char* compiler;         // __VERSION__
    const char* standardLibrary;  // name and version of the C++ library
    const char* headers;          // CORTEX_HEADER_HASH: of the public headers of cortex
    // Types implemented and their hashes (hex, as printed by `cortex types NAME`), "" where the
    // plug-in does not care; ended by a null name.
    struct ImplementedType {
        const char* name;
        const char* hash;
    };
    const ImplementedType* types;
    void (*registerClasses)(ClassRegistry& registry);
};

const char* compilerOfThisBuild();
const char* standardLibraryOfThisBuild();
const char* headersOfThisBuild();

}  // namespace cortex

// In one source file of a plug-in, at namespace scope:
//   void addClasses(cortex::ClassRegistry& registry) { registry.add<Pump>("Pump"); }
//   CORTEX_PLUGIN(addClasses, {"Pump", ""})
#define CORTEX_PLUGIN(registerFunction, ...)                                                    \
    extern "C" __attribute__((visibility("default"))) const cortex::PluginDescription*          \
    cortexPlugin() {                                                                            \
        static const cortex::PluginDescription::ImplementedType types[] = {__VA_ARGS__,         \
                                                                           {nullptr, nullptr}}; \
        static const cortex::PluginDescription description{                                     \
            cortex::pluginAbi,  __VERSION__, CORTEX_STANDARD_LIBRARY,                           \
            CORTEX_HEADER_HASH, types,       registerFunction};                                 \
        return &description;                                                                    \
    }

#if defined(_GLIBCXX_RELEASE)
#define CORTEX_STRINGIFY2(x) #x
#define CORTEX_STRINGIFY(x) CORTEX_STRINGIFY2(x)
#define CORTEX_STANDARD_LIBRARY "libstdc++ abi " CORTEX_STRINGIFY(_GLIBCXX_USE_CXX11_ABI)
#else
#define CORTEX_STANDARD_LIBRARY "libc++"
#endif
