// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/structure.hpp"

#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace cortex::test {

DataItem item(std::string name, Value initial);  // as long as its value

// A Structure laid out by hand, so that tables are tested without the model that makes them.
class SmallStructure {
public:
    Type& type(std::string name, Role role, std::vector<DataItem> data);
    Rule& rule(Type& owner, std::string name, Direction direction);

    std::uint32_t add(std::string path, const Type& type);  // in path order
    void relate(std::uint32_t owner, const Rule& rule, std::uint32_t target, bool delayed = false);
    void set(std::uint32_t simplex, std::string_view item, Value value);
    SimplexInfo& info(std::uint32_t simplex) { return structure_->simplexes[simplex]; }

    std::shared_ptr<const Structure> build();

private:
    struct Owning : Structure {
        std::deque<Type> ownTypes;
        std::deque<Rule> ownRules;
    };
    const TypeLayout* layoutFor(const Type& type);

    std::shared_ptr<Owning> structure_ = std::make_shared<Owning>();
};

// An axis with an item of each kind, arrays and a constant; a sensor writes it delayed, two
// controllers write a shared one, a reader reads them in every way.
struct Plant {
    std::shared_ptr<const Structure> structure;
    std::uint32_t axis, first, reader, remote, second, shared;
    // Edges by what they are.
    std::uint32_t axisWritten, firstShared, live, latched, held, heldDelayed, remoteRead,
        secondShared, activeLive, activeDelayed;
};
Plant makePlant();

}  // namespace cortex::test
