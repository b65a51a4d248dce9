// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/testing.hpp"
#include "cortex/toolkit/fieldbus_link.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace cortex::modbus::test {

// A plant with one FieldbusDevice before a real simulator. The loop is stepped at a nominal 10 kHz,
// a cycle in a millisecond or more, so that its time goes by slower than the device's. No time
// decides anything: with the link of linkSettings() an answer may take half a second, and what came
// last is present for 7,000 cycles.
class LinkPlant : public cs::TestPlant {
public:
    static constexpr std::int64_t lossCycles = 7000;

    // `observation`: one of what the device measures.
    LinkPlant(const std::vector<std::filesystem::path>& files, std::string device,
              std::string observation);

    // Settings of the device: these, and `given` in place of them or beside them.
    static Pairs linkSettings(const std::string& address, const Pairs& given);
    static void replace(Pairs& all, const Pairs& given);

    void start();
    // One cycle after another until it holds, or patience ends. The cycles that it took.
    std::int64_t stepUntil(const std::string& what, const std::function<bool()>& condition);
    void stepWithExchanges(std::int64_t count);
    void open();  // until the first whole answer

    toolkit::Link link() { return static_cast<toolkit::Link>(count("link")); }
    std::int64_t count(const std::string& item) { return get<std::int64_t>(device_, item); }
    Quality quality();
    std::string events();
    bool hasTold(const std::string& words) { return events().find(words) != std::string::npos; }

private:
    struct Told {
        std::mutex mutex;
        std::string text;
    };
    std::string device_, observation_;
    std::shared_ptr<Told> told_ = std::make_shared<Told>();  // outlives the plant's end
};

}  // namespace cortex::modbus::test
