// SPDX-License-Identifier: Apache-2.0
#include "roles.hpp"

#include "cortex/comms/mirror.hpp"
#include "cortex/core/error.hpp"

#include "../bare/stream.hpp"
#include "clocks.hpp"
#include "plant.hpp"
#include "statistics.hpp"

#include <chrono>
#include <cstring>
#include <iostream>
#include <optional>

namespace cortex::network {
namespace {

using namespace std::chrono_literals;
using Words = std::vector<std::string>;
using bare::Octets;
using bare::Stream;

int agent(const Words& words) {
    const AgentRole role{words[1], std::stoi(words[2]), std::stoi(words[3]), words[4],
                         std::stoi(words[5])};
    Plant::Options options{.name = role.name, .samples = role.samples};
    options.links = samplePaths(role.owner, role.links);
    if (role.domain >= 0) options.network = loopback(role.domain);
    Plant plant{options};
    plant.cluster.setTriggerSource<cs::InternalClock>(1ms);
    plant.start();
    std::cout << plant.network.announced() << std::endl;
    bool told = plant.links.empty();
    while (!inputEnds(told ? -1 : 10)) {
        if (told || !plant.linked()) continue;
        told = true;
        std::cout << "linked" << std::endl;
    }
    return 0;
}

int sender(const Words& words) {
    const OnCpu first{0};
    const int domain = std::stoi(words[1]);
    Octets::Data data(std::stoul(words[3]));
    Stream stream{domain + 1, Stream::Role::Writer};
    Plant plant{{.name = "sender",
                 .samples = std::stoi(words[2]),
                 .network = loopback(domain),
                 .cluster = {.watchdogPeriods = 1e6}}};
    plant.cluster.setTriggerSource<TakingTurns>([&] {
        const std::int64_t stamp = steadyNow();
        std::memcpy(data.data(), &stamp, sizeof stamp);
        stream.write(data);
    });
    plant.start();
    inputEnds(-1);
    return 0;
}

int viewer(const Words& words) {
    comms::Mirror mirror{words[1], loopback(std::stoi(words[2]))};
    mirror.view({"/"}, static_cast<std::uint32_t>(std::stoul(words[3])));
    if (!mirror.waitUntilComplete(20s) || !mirror.waitForValues(20s)) return 1;
    std::cout << "ready" << std::endl;
    inputEnds(-1);
    return 0;
}

int bareParticipant(const Words& words) {
    const std::int64_t began = steadyNow();
    const Stream stream{std::stoi(words[1]), Stream::Role::Writer};
    std::cout << began << std::endl;
    inputEnds(-1);
    return 0;
}

}  // namespace

std::vector<std::string> wordsOf(const AgentRole& role) {
    return {"--agent",
            role.name,
            std::to_string(role.domain),
            std::to_string(role.samples),
            role.owner,
            std::to_string(role.links)};
}

std::vector<std::string> senderWords(int domain, int samples, std::size_t octets) {
    return {"--sender", std::to_string(domain), std::to_string(samples), std::to_string(octets)};
}

std::vector<std::string> viewerWords(const std::string& name, int domain, int rate) {
    return {"--viewer", name, std::to_string(domain), std::to_string(rate)};
}

std::vector<std::string> bareWords(int domain) { return {"--bare", std::to_string(domain)}; }

int playRole(const std::vector<std::string>& words) {
    if (words[0] == "--agent" && words.size() == 6) return agent(words);
    if (words[0] == "--sender" && words.size() == 4) return sender(words);
    if (words[0] == "--viewer" && words.size() == 4) return viewer(words);
    if (words[0] == "--bare" && words.size() == 2) return bareParticipant(words);
    throw Error("unknown role " + words[0]);
}

}  // namespace cortex::network
