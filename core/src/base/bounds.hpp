// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

// What a model may have at most (docs/ontology.md), so that hostile files cost bounded memory.
namespace cortex::bounds {

inline constexpr std::size_t fileSize = 16U << 20U;   // bytes
inline constexpr std::size_t totalSize = 64U << 20U;  // bytes of all files
inline constexpr std::size_t files = 256;
inline constexpr std::size_t nesting = 32;        // levels of elements
inline constexpr std::size_t elements = 250'000;  // in one file
inline constexpr std::size_t attributes = 64;     // of one element
inline constexpr std::size_t nameLength = 64;
inline constexpr std::size_t textLength = 4096;      // bytes of a description
inline constexpr std::size_t sentText = 64U << 10U;  // bytes of an attribute, as others get it
inline constexpr std::size_t types = 16'384;
inline constexpr std::size_t parents = 64;
inline constexpr std::size_t inheritance = 64;     // levels
inline constexpr std::size_t itemsPerType = 4096;  // data, commands, parameters and rules
inline constexpr std::size_t labels = 1024;        // of one item
inline constexpr std::uint32_t arrayLength = 65'536;
inline constexpr std::uint32_t stringCapacity = 4096;
inline constexpr std::size_t recordSize = 4096;       // bytes of a request or response
inline constexpr std::uint64_t dataSize = 1U << 30U;  // bytes of all simplexes
inline constexpr std::size_t suggestions = 100;      // unknown names for which near ones are sought
inline constexpr std::size_t modelCost = 4U << 20U;  // array elements, at least 16 an item

}  // namespace cortex::bounds
