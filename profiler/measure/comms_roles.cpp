// SPDX-License-Identifier: Apache-2.0
#include "comms_roles.hpp"

#include "measure/endurance_role.hpp"
#include "measure/memory_roles.hpp"
#include "network/roles.hpp"
#include "observers/client.hpp"

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
int client(const Words& words) {
    return observers::runClient(std::stoi(words[1]),
                                static_cast<observers::Load>(std::stoi(words[2])),
                                std::stoi(words[3]));
}

constexpr Role roles[]{{"--memory", 5, playMemoryRole},    {"--size", 2, playSizeRole},
                       {"--endure", 5, playEnduranceRole}, {"--client", 4, client},
                       {"--agent", 6, network::playRole},  {"--sender", 4, network::playRole},
                       {"--viewer", 4, network::playRole}, {"--bare", 2, network::playRole}};

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
