// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/simplex_tree.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/nearest_names.hpp"
#include "cortex/core/registry.hpp"

#include <algorithm>

namespace cortex {
namespace {

constexpr std::size_t maxPathLength = 128;
constexpr std::size_t maxPathLevels = 8;

bool isPathCharacter(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
}

std::string near(std::string_view wrong, const std::vector<std::string>& valid) {
    const std::string names = nearestNames(wrong, valid);
    return names.empty() ? names : "; " + names;
}

template <class Map>
std::vector<std::string> keysOf(const Map& map) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : map) keys.push_back(key);
    return keys;
}

}  // namespace

SimplexTree::SimplexTree(TypeModel types)
    : types_{std::make_shared<const TypeModel>(std::move(types))} {}

std::string SimplexTree::pathError(std::string_view path) {
    if (path.empty() || path.front() != '/') return "a path begins with '/'";
    if (path.size() > maxPathLength) {
        return "a path has at most 128 characters, this has " + std::to_string(path.size());
    }
    const auto levels = static_cast<std::size_t>(std::ranges::count(path, '/'));
    if (levels > maxPathLevels) {
        return "a path has at most 8 levels, this has " + std::to_string(levels);
    }
    for (std::size_t i = 1; i < path.size(); ++i) {
        if (path[i] == '/' && path[i - 1] == '/') return "a level of the path is empty";
        if (path[i] != '/' && !isPathCharacter(path[i])) {
            return std::string{"'"} + path[i] + "' is not allowed: use A-Z a-z 0-9 _ - in a path";
        }
    }
    return path.back() == '/' ? "the path ends with '/'" : "";
}

void SimplexTree::requireNotFixed(std::string_view what) const {
    if (agent_.empty()) return;
    throw Error{std::string{what} + ": agent /" + agent_ +
                " runs with this tree, whose layout start() has fixed: add and relate before it"};
}

Simplex::Identity SimplexTree::identity(std::string_view path, std::string_view type) const {
    requireNotFixed(path);
    if (const std::string wrong = pathError(path); !wrong.empty()) {
        throw Error{"'" + std::string{path} + "': " + wrong};
    }
    if (find(path) != nullptr) {
        throw Error{std::string{path} + ": there is a simplex with this path already"};
    }
    const Type& found = types_->at(type);
    if (found.isAbstract) {
        throw Error{std::string{path} + ": type " + found.name +
                    " is abstract; use a type that extends it"};
    }
    return {std::string{path}, &found};
}

Simplex& SimplexTree::insert(std::unique_ptr<Simplex> simplex) {
    Simplex& reference = *simplex;
    simplexes_.emplace(reference.path(), std::move(simplex));
    return reference;
}

std::unique_ptr<Simplex> SimplexTree::make(std::string_view path, const Type& type,
                                           const ClassRegistry* registry) const {
    Simplex::Identity identity{std::string{path}, &type};
    const std::vector<std::string> classes =
        registry != nullptr ? registry->classesFor(type, *types_) : std::vector<std::string>{};
    if (classes.size() != 1) return std::make_unique<Simplex>(std::move(identity));
    return (*registry->find(classes.front()))(std::move(identity));
}

Simplex& SimplexTree::add(std::string_view path, std::string_view type) {
    return insert(std::make_unique<Simplex>(identity(path, type)));
}

void SimplexTree::relate(Simplex& owner, std::string_view rule, const Simplex& target, bool delayed,
                         double maxAge) {
    requireNotFixed(owner.path());
    Simplex::Relation& relation = owner.description_->relations.emplace_back();
    relation.rule = rule;
    relation.target = target.path();
    relation.delayed = delayed;
    relation.maxAge = maxAge;
}

void SimplexTree::relateRemote(Simplex& owner, std::string_view rule, std::string_view path,
                               std::string_view type, bool delayed, double maxAge) {
    requireNotFixed(owner.path());
    Simplex::Relation& relation = owner.description_->relations.emplace_back();
    relation.rule = rule;
    relation.target = path;
    relation.delayed = delayed;
    relation.remote = true;
    relation.maxAge = maxAge;
    relation.type = type;
}

const Simplex* SimplexTree::find(std::string_view path) const {
    const auto found = simplexes_.find(path);
    return found != simplexes_.end() ? found->second.get() : nullptr;
}

Simplex* SimplexTree::find(std::string_view path) {
    const auto found = simplexes_.find(path);
    return found != simplexes_.end() ? found->second.get() : nullptr;
}

Simplex& SimplexTree::at(std::string_view path) {
    if (Simplex* found = find(path)) return *found;
    throw Error{"there is no simplex '" + std::string{path} + "'" + near(path, keysOf(simplexes_))};
}

}  // namespace cortex
