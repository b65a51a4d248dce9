// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/structure.hpp"

#include "texts/random_values.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace cortex::test {

using Values = std::map<std::string, Value>;      // by item
using AllValues = std::map<std::string, Values>;  // by path

// A type with items of all kinds. For each item `a` there is an item `aCopy`, which has a random
// default in the first agent. In the second agent its class copies `a` of the first one to it.
struct RandomType {
    std::string name;
    std::vector<DataItem> items;

    const DataItem& item(const std::string& name) const;
};

struct RandomSimplex {
    std::string path, copyPath;
    const RandomType* type;
    Values values;  // as the system file sets them; the others have their defaults
};

// A model of two agents: `first` has the values, `second` copies them over links.
class RandomModel {
public:
    RandomModel(Chance& chance, std::size_t types, std::size_t simplexes);
    RandomModel(const RandomModel&) = delete;
    RandomModel& operator=(const RandomModel&) = delete;

    const std::string& ontology() const { return ontology_; }
    const std::string& firstSystem() const { return first_; }
    const std::string& secondSystem() const { return second_; }
    const std::vector<RandomSimplex>& simplexes() const { return simplexes_; }
    const DataItem& item(const std::string& path, const std::string& name) const;

    AllValues start() const;                         // of the first agent, after its start
    AllValues settable(Chance& chance) const;        // new values for what may be set
    AllValues copies(const AllValues& first) const;  // what the second agent makes of them

private:
    std::vector<RandomType> types_;
    std::vector<RandomSimplex> simplexes_;
    std::string ontology_, first_, second_;
};

}  // namespace cortex::test
