// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "texts/random_values.hpp"

#include <string>

namespace cortex::test {

// Types at which texts and numbers go wrong: labels that are numbers, bounds of +-0, attributes of
// more than 64 KiB. Most are valid. File t.xml, and that of their rules, m.xml.
std::string oddOntology(Chance& chance);
std::string oddMorphology();

// A system of these types, which sets some of their items; most to a value that they may have.
std::string oddSystem(Chance& chance, const TypeModel& types);
bool isOdd(const DataItem& item);  // of oddOntology()

// One of its own, or what it cannot have: out of its range, too long, or no UTF-8.
Value oddValue(Chance& chance, const DataItem& item);

}  // namespace cortex::test
