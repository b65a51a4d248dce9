// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/quality.hpp"
#include "cortex/core/realtime.hpp"
#include "cortex/core/type_model.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cortex {

// Elements per value kind; strings are counted in bytes of their cells.
struct BlockSizes {
    std::uint32_t ints = 0, floats = 0, bools = 0, strings = 0;

    BlockSizes& operator+=(const BlockSizes& other);
};

// Where an item lies in the slice of its simplex, in units of BlockSizes.
struct ItemLayout {
    const DataItem* item = nullptr;
    std::uint32_t offset = 0;
    bool constant = false;  // in the table of constants
};

// The slice of every simplex of one type. Constant items lie in a table of their own, which is not
// copied into images; those of another agent's simplexes arrive at run time and lie with the rest.
struct TypeLayout {
    const Type* type = nullptr;
    std::vector<ItemLayout> items;  // sorted by name
    BlockSizes cyclic, constant;
    bool remote = false;  // of another agent's simplexes

    const ItemLayout* find(std::string_view item) const;
};

TypeLayout typeLayout(const Type& type, bool remote = false);

// Parameters of a command as one flat record: byte offsets, each multiple of 8.
struct RecordLayout {
    std::vector<ItemLayout> items;  // in the order of the type
    std::uint32_t size = 0;         // bytes

    const ItemLayout* find(std::string_view parameter) const;
};

RecordLayout recordLayout(const std::vector<DataItem>& parameters);

// One relationship: the n-th under a rule of its owner.
struct Edge {
    std::uint32_t owner = noSimplex;
    std::uint32_t target = noSimplex;
    const Rule* rule = nullptr;
    bool delayed = false;
    double maxAge = Rule{}.maxAge;  // s, above which an input is lost: its own, or the rule's
};

// One simplex of an agent, as others see it.
struct SimplexInfo {
    std::string path;
    const TypeLayout* layout = nullptr;
    Role role = Role::Descriptive;  // decided: Active, Observation or Modification
    bool remote = false;            // belongs to another agent; a link
    BlockSizes base, constantBase;  // start of its slices
    std::uint32_t firstEdge = 0, edgeCount = 0;
    std::uint32_t every = 1;
    std::int32_t phase = -1;
    std::vector<std::uint32_t> writers;  // active owners of output edges here, by path
    bool delayedOutput = false;          // its writer's output is delayed: a device's observation
};

// What the tree sets over the default of a type's item.
struct InitialValue {
    std::uint32_t simplex = noSimplex;
    const ItemLayout* item = nullptr;
    Value value;
};

// One simplex's part of a table: live, latched for delayed readers, held, or a writer's candidate.
struct Slice {
    std::int64_t* ints = nullptr;
    double* floats = nullptr;
    bool* bools = nullptr;
    std::byte* strings = nullptr;
    SlotState* state = nullptr;

    // First element of an item that lies at `offset` of its kind's block.
    void* at(Kind kind, std::uint32_t offset) const CORTEX_REALTIME;
};

// What an agent consists of: simplexes by path, their types, relationships and table layout.
// Immutable after start(); shared with images and interfaces; any thread may read.
class Structure {
public:
    std::string agent;
    std::int64_t epoch = 0;  // UTC microseconds at start
    std::shared_ptr<const TypeModel> types;
    std::vector<SimplexInfo> simplexes;  // sorted by path, then remote ones
    std::vector<Edge> edges;             // by owner, then rule, in the order related
    std::vector<std::unique_ptr<TypeLayout>> layouts;
    std::vector<InitialValue> initial;     // settings of the tree; a later one outranks
    BlockSizes cyclic, constant;           // totals
    std::vector<std::uint32_t> pathTable;  // indexes into `simplexes` at the hash of their paths

    void indexPaths();  // fills pathTable, once all simplexes are there
    std::uint32_t find(std::string_view path) const;          // noSimplex if there is none
    std::uint32_t writtenEvery(std::uint32_t simplex) const;  // cycles between two writings
};

}  // namespace cortex
