// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/structure.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::test {

// One stream of random choices; the same for the same seed, whatever the C++ library.
class Chance {
public:
    explicit Chance(std::uint64_t seed) : engine_{seed} {}

    std::uint64_t bits() { return engine_(); }
    std::size_t below(std::size_t count) { return engine_() % count; }
    bool oneIn(std::size_t count) { return below(count) == 0; }
    template <class List>
    auto oneOf(const List& list) {
        return list[below(list.size())];
    }
    // Each in turn, so that a few choices have them all.
    template <class List>
    auto nextOf(const List& list) {
        return list[turns_[list.data()]++ % list.size()];
    }

private:
    std::mt19937_64 engine_;
    std::map<const void*, std::size_t> turns_;
};

// A value that the item may have: often one at which texts and numbers go wrong.
Value randomValue(Chance& chance, const DataItem& item);
// The same for a file that cannot escape control characters.
Value randomDefault(Chance& chance, const DataItem& item);

// One of the texts that stand for this value in a file or on a command line.
std::string writtenAs(Chance& chance, const Value& value);
// One of the ways in which that text is an attribute: value="…", with its quotation marks.
std::string attribute(Chance& chance, std::string_view name, const std::string& text);
// <set data="…" …/> in the same way, or with escaped="true".
std::string setting(Chance& chance, const std::string& item, const std::string& text);

// "" where both are the same bit by bit, or the first place where they differ.
std::string difference(const Value& expected, const Value& found);

}  // namespace cortex::test
