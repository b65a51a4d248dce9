// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include "types/type_graph.hpp"
#include "types/type_merge.hpp"

#include <map>
#include <string>
#include <vector>

namespace cortex {

// Turns declarations into types with everything that they inherit. Setup only.
class TypeResolver {
public:
    using Declarations = std::map<std::string, TypeDeclaration, std::less<>>;
    using Types = std::map<std::string, Type, std::less<>>;

    TypeResolver(const Declarations& declarations, const std::vector<std::string>& order,
                 Report& report);
    Types run();

private:
    // Of what a type says only if it wants to, who said it: parents that say nothing have no say.
    struct Said {
        bool role = false, writers = false;
    };

    Type resolve(const TypeDeclaration& declaration);
    void resolveRole(Type& type, const TypeDeclaration& declaration);
    void inheritRole(Type& type, const TypeDeclaration& declaration, Said& said);
    void resolveFlags(Type& type, const TypeDeclaration& declaration);
    void inheritFlags(Type& type);
    template <class Item, class Merge>
    std::vector<Item> mergeItems(std::vector<Item> Type::* list, const std::vector<Item>& own,
                                 const TypeDeclaration& declaration, const char* what,
                                 std::string (*prefix)(std::string_view), const char* duplicate,
                                 Merge merge);
    bool affordable(const TypeDeclaration& declaration, std::size_t cost);
    void checkRules(const Type& type);
    void checkCreate(const Type& type, const Rule& rule);
    void checkRefines(const Type& type, const Rule& rule);
    void checkCounterpart(const Type& type, const Rule& rule);
    void checkUnits(const Type& type);
    void checkItems(const Type& type);
    void checkSameCount(const Type& type, const Rule& rule);
    void checkBehaviour(const Type& type);

    const Declarations& declarations_;
    Report& report_;
    TypeGraph graph_;
    Types types_;
    std::map<std::string, Said, std::less<>> said_;
    std::size_t cost_ = 0;
    bool tooLarge_ = false;
};

}  // namespace cortex
