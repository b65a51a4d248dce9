// SPDX-License-Identifier: Apache-2.0
#include "client.hpp"

#include "cortex/comms/mirror.hpp"

#include "measure/comms_domain.hpp"

#include <iostream>
#include <sstream>

namespace cortex::profiler {
namespace {

using namespace std::chrono_literals;

// Every simplex is there, and the first and the last fed one are of the same cycle.
bool isWhole(const Image& image) {
    const auto& all = image.structure().simplexes;
    for (std::uint32_t i = 0; i < all.size(); ++i) {
        if (image.state(i).quality == Quality::Lost) return false;
    }
    return image.get<double>("/items/n0", "f0") == image.get<double>("/items/n999", "f0");
}

}  // namespace

std::vector<std::string> clientWords(int number, int rate, int domain) {
    return {"--client", std::to_string(number), std::to_string(rate), std::to_string(domain)};
}

ClientSample sampleOf(Child& client) {
    std::istringstream line{client.line()};
    ClientSample sample;
    line >> sample.images >> sample.whole;
    return sample;
}

int playClient(const std::vector<std::string>& words) {
    comms::Mirror mirror{"observer" + words.at(1), loopback(std::stoi(words.at(3)))};
    if (!mirror.waitUntilComplete(60s)) return 1;
    mirror.view({"/"}, static_cast<std::uint32_t>(std::stoul(words.at(2))));
    if (!mirror.waitForValues(60s)) return 1;
    std::cout << "ready" << std::endl;
    std::string begin;
    std::getline(std::cin, begin);
    const std::uint64_t first = mirror.waitForImage(0, 0ms);
    std::uint64_t last = first;
    std::int64_t looked = 0, whole = 0;
    while (!inputEnds(0)) {
        const std::uint64_t now = mirror.waitForImage(last, 100ms);
        if (now == last) continue;
        last = now;
        const comms::AgentImage image = mirror.image("subject");
        ++looked;
        if (image && isWhole(*image)) ++whole;
    }
    // Of those that came between two looks the newest stands for all.
    const double part = looked == 0 ? 0 : static_cast<double>(whole) / static_cast<double>(looked);
    const auto images = static_cast<double>(last - first);
    std::cout << last - first << ' ' << static_cast<std::int64_t>(images * part) << std::endl;
    return 0;
}

}  // namespace cortex::profiler
