// SPDX-License-Identifier: Apache-2.0
#include "measure/client.hpp"
#include "measure/memory_roles.hpp"
#include "network/roles.hpp"

#include <exception>
#include <iostream>
#include <string>
#include <vector>

namespace cortex::profiler {
namespace {

using Words = std::vector<std::string>;

struct Role {
    const char* word;
    std::size_t words;
    int (*play)(const Words& words);
};

constexpr Role roles[]{{"--memory", 5, playMemoryRole},
                       {"--client", 4, playClient},
                       {"--agent", 4, playAgent},
                       {"--sender", 4, playSender}};

}  // namespace

std::optional<int> playChildRole(int argc, char** argv) {
    const Words words{argv + 1, argv + argc};
    for (const Role& role : roles) {
        if (words.size() != role.words || words[0] != role.word) continue;
        try {
            return role.play(words);
        } catch (const std::exception& error) {
            std::cerr << "error in " << words[0] << ": " << error.what() << '\n';
            return 1;
        }
    }
    return std::nullopt;
}

}  // namespace cortex::profiler
