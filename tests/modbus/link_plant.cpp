// SPDX-License-Identifier: Apache-2.0
#include "modbus/link_plant.hpp"

#include "cortex/core/agent.hpp"

#include "support/waiting.hpp"

#include <utility>

namespace cortex::modbus::test {

LinkPlant::LinkPlant(const std::vector<std::filesystem::path>& files, std::string device,
                     std::string observation)
    : TestPlant{files, std::chrono::microseconds{100}},
      device_{std::move(device)},
      observation_{std::move(observation)} {}

LinkPlant::Pairs LinkPlant::linkSettings(const std::string& address, const Pairs& given) {
    Pairs all{{"address", address},
              {"exchangePeriod", "0.001"},
              {"responseTimeout", "0.6"},
              {"lossTime", "0.7"},
              {"reconnectTime", "0.01"}};
    replace(all, given);
    return all;
}

void LinkPlant::replace(Pairs& all, const Pairs& given) {
    for (const auto& each : given) {
        std::erase_if(all, [&](const auto& one) { return one.first == each.first; });
        all.push_back(each);
    }
}

void LinkPlant::start() {
    cluster().addEventSink([told = told_](const Event& event, const Structure&) {
        const std::lock_guard lock{told->mutex};
        told->text += std::string{event.text.view()} + "\n";
    });
    TestPlant::start();
}

std::int64_t LinkPlant::stepUntil(const std::string& what, const std::function<bool()>& condition) {
    const std::int64_t before = cycle();
    cortex::test::waitUntil(
        what,
        [&] {
            if (condition()) return true;
            step();
            return false;
        },
        [this] { return events(); });
    return cycle() - before;
}

void LinkPlant::stepWithExchanges(std::int64_t more) {
    const std::int64_t before = count("exchangeCount");
    stepUntil("exchanges", [&] { return count("exchangeCount") >= before + more; });
}

void LinkPlant::open() {
    start();
    stepUntil("a present answer", [&] { return quality() == Quality::Good; });
}

Quality LinkPlant::quality() {
    const Image image = cluster().image();
    return image.state(image.structure().find(observation_)).quality;
}

std::string LinkPlant::events() {
    cluster().agent().events().flush();
    const std::lock_guard lock{told_->mutex};
    return told_->text;
}

}  // namespace cortex::modbus::test
