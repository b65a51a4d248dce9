// SPDX-License-Identifier: Apache-2.0
#include "client.hpp"

#include "cortex/comms/mirror.hpp"
#include "cortex/core/error.hpp"

#include "measure/comms_domain.hpp"

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace cortex::observers {
namespace {

using namespace std::chrono_literals;
using profiler::inputEnds;

std::uint64_t look(comms::Mirror& mirror) {
    const std::uint64_t first = mirror.waitForImage(0, 0ms);
    std::uint64_t last = first;
    while (!inputEnds(0)) last = mirror.waitForImage(last, 100ms);
    return last - first;
}

// Whenever the answers come: the loop may rest every other second. Spread over the second.
std::uint64_t command(comms::Mirror& mirror, int number, int period) {
    std::uint64_t done = 0;
    std::vector<std::uint64_t> sent;
    if (inputEnds(number * 20 % 1000)) return done;
    do {
        sent.push_back(mirror.send("/echo", "ping", {{"number", static_cast<double>(number)}}, 5s));
        std::erase_if(sent, [&](std::uint64_t each) {
            comms::CommandAnswer answer;
            if (!mirror.poll(each, answer)) return false;
            if (answer.outcome == Outcome::Done) ++done;
            return true;
        });
    } while (!inputEnds(period));
    return done;
}

}  // namespace

int runClient(int number, Load load, int domain) {
    comms::Mirror mirror{"observer" + std::to_string(number), profiler::loopback(domain)};
    if (!mirror.waitForOwner("/echo", 60s) || !mirror.waitUntilComplete(60s)) return 1;
    const bool commands = load == Load::Command || load == Load::CommandOften;
    if (!commands) {
        mirror.view({"/"}, load == Load::ViewEvery ? 0 : 30);
        if (!mirror.waitForValues(60s)) return 1;
    }
    std::cout << "ready" << std::endl;
    const std::uint64_t count =
        commands ? command(mirror, number, load == Load::Command ? 1000 : 20) : look(mirror);
    std::cout << count << std::endl;
    return 0;
}

void Clients::start(int number, Load load, int domain) {
    clients_.push_back(std::make_unique<profiler::Child>(
        std::vector{std::string{"--client"}, std::to_string(number),
                    std::to_string(static_cast<int>(load)), std::to_string(domain)}));
}

void Clients::waitUntilReady() {
    for (const auto& each : clients_) {
        if (each->line(150s) != "ready") throw Error("a client found nothing to look at");
    }
}

std::vector<std::uint64_t> Clients::stop() {
    std::vector<std::uint64_t> counts;
    for (const auto& each : clients_) each->end();
    for (const auto& each : clients_) {
        counts.push_back(std::strtoull(each->line().c_str(), nullptr, 10));
    }
    clients_.clear();
    return counts;
}

}  // namespace cortex::observers
