// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/model_files.hpp"
#include "cortex/core/simplex.hpp"

#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace cortex {

class ClassRegistry;

// Owns the simplexes of a system by path, with the types they are made of. Built in code, from a
// system file, or both. Setup phase, one thread. While an agent runs with it, its layout is fixed:
// add() and relate() throw Error.
class SimplexTree {
public:
    explicit SimplexTree(TypeModel types);

    // Reads files of any kind and adds the simplexes of their system. `registry` makes the objects
    // of active types; without it (or the class) they stay plain, which start() refuses.
    static SimplexTree load(std::span<const std::filesystem::path> files,
                            const ClassRegistry* registry = nullptr);  // throws ModelError
    static SimplexTree load(const std::filesystem::path& file,
                            const ClassRegistry* registry = nullptr) {
        return load(std::span{&file, 1}, registry);
    }
    // What cannot be added (unknown type, bad path, bad value) goes to the report.
    void add(const SystemDescription& system, const ClassRegistry* registry, Report& report);

    // Throws Error for a path that is taken or malformed, or an unknown or abstract type.
    Simplex& add(std::string_view path, std::string_view type);
    template <class T, class... Arguments>
    T& add(std::string_view path, std::string_view type, Arguments&&... arguments) {
        auto simplex = makeSimplex<T>(identity(path, type), std::forward<Arguments>(arguments)...);
        T& reference = *simplex;
        insert(std::move(simplex));
        return reference;
    }
    // `maxAge`: s after which this input is lost; 0: as its rule says.
    void relate(Simplex& owner, std::string_view rule, const Simplex& target, bool delayed = false,
                double maxAge = 0);
    // To a simplex of another agent, bound when that agent appears; inputs only. `type`: that it
    // has there, or a parent of it, where the items of the rule's target are too few.
    void relateRemote(Simplex& owner, std::string_view rule, std::string_view path,
                      std::string_view type = {}, bool delayed = false, double maxAge = 0);

    // Fills rules with `create` up to their minimum; idempotent. start() calls it. A simplex that
    // stands at a created path already, of the type or a child, is related in its place.
    void createRelated(const ClassRegistry* registry = nullptr);

    Simplex* find(std::string_view path);
    const Simplex* find(std::string_view path) const;
    Simplex& at(std::string_view path);  // throws Error naming the nearest paths
    const std::map<std::string, std::unique_ptr<Simplex>, std::less<>>& simplexes() const {
        return simplexes_;
    }
    const TypeModel& types() const { return *types_; }
    std::shared_ptr<const TypeModel> sharedTypes() const { return types_; }
    const SystemDescription& description() const { return description_; }

    // A path: 1 to 8 levels of [A-Za-z0-9_-]+, at most 128 characters. "" or what is wrong.
    static std::string pathError(std::string_view path);

private:
    friend class AgentRuntime;
    void requireNotFixed(std::string_view what) const;
    Simplex::Identity identity(std::string_view path, std::string_view type) const;
    Simplex& insert(std::unique_ptr<Simplex> simplex);
    std::unique_ptr<Simplex> make(std::string_view path, const Type& type,
                                  const ClassRegistry* registry) const;
    Simplex* createOne(const Simplex& owner, const Rule& rule, std::uint32_t n,
                       const ClassRegistry* registry);

    std::shared_ptr<const TypeModel> types_;
    std::map<std::string, std::unique_ptr<Simplex>, std::less<>> simplexes_;
    SystemDescription description_;
    std::string agent_;  // that runs with it; empty: none
};

}  // namespace cortex
