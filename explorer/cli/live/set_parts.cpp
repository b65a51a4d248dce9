// SPDX-License-Identifier: Apache-2.0
#include "live/set_parts.hpp"

#include <cstddef>
#include <string>
#include <variant>

namespace cortex::cli {
namespace {

// Of the 64,000 octets of a command; the rest is for its head, with its path and its names.
constexpr std::size_t mostOctets = 60'000;

// At most so many on their way (docs/protocol.md): lists are counted and aligned.
std::size_t octetsOf(const std::string& name, const Value& value) {
    constexpr std::size_t around = 64, ofElement = 8, aroundText = 8;
    std::size_t octets = around + name.size();
    if (const auto* texts = std::get_if<std::vector<std::string>>(&value)) {
        for (const std::string& each : *texts) octets += aroundText + each.size();
        return octets;
    }
    return octets + ofElement * lengthOf(value);
}

}  // namespace

std::vector<ProgramInterface::Arguments> setParts(const ProgramInterface::Arguments& items) {
    std::vector<ProgramInterface::Arguments> parts;
    std::size_t octets = mostOctets;  // of the last part: there is none
    for (const auto& [name, value] : items) {
        const std::size_t more = octetsOf(name, value);
        if (parts.empty() || octets + more > mostOctets) {
            parts.emplace_back();
            octets = 0;
        }
        parts.back().emplace(name, value);
        octets += more;
    }
    return parts;
}

}  // namespace cortex::cli
