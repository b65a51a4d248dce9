// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace cortex::cs {

// Whose code an address is.
enum class Module : std::uint8_t { Other, Checker, System, Framework };

// Looks at what is loaded. Not in a tick.
void learnModules();
Module moduleOf(const void* address);

// The place among these, innermost first, that whoever wrote the hook looks for: his function, file
// and line, as far as they are known. Runs addr2line where there is one.
std::string placeOf(std::span<const void* const> frames);

std::string demangled(const char* name);

}  // namespace cortex::cs
