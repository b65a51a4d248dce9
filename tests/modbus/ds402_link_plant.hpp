// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/testing.hpp"
#include "cortex/toolkit/fieldbus_link.hpp"

#include "modbus/sim_process.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

namespace cortex::modbus::test {

struct LinkPlantOptions {
    cs::TestPlant::Pairs device{};       // settings of /drive
    cs::TestPlant::Pairs observation{};  // of both observations
    bool hasProcessor = true;
};

// Two axes, their processor and a Ds402ModbusDrive before a real cortex-ds402-sim. The loop is
// stepped at a nominal 10 kHz, a cycle in a millisecond or more, so that its time goes by slower
// than the drive's. No time decides anything: an answer may take half a second, and what came last
// is present for 7,000 cycles.
class Ds402LinkPlant : public cs::TestPlant {
public:
    static constexpr std::int64_t lossCycles = 7000;

    explicit Ds402LinkPlant(const SimProcess& sim, const LinkPlantOptions& options = {});

    void start();
    // One cycle after another until it holds, or patience ends. The cycles that it took.
    std::int64_t stepUntil(const std::string& what, const std::function<bool()>& condition);
    void stepWithExchanges(std::int64_t count);
    void open();        // until the first whole answer
    void makeActive();  // the processor, again after each fault: a busy machine may cause some
    // Moves the demand of axis 1, with an active processor.
    void moveTo(double position);

    toolkit::Link link() { return static_cast<toolkit::Link>(count("link")); }
    std::int64_t count(const std::string& item) { return get<std::int64_t>("/drive", item); }
    double position() { return get<double>("/drive/a", "position"); }
    std::int64_t driveState() { return get<std::int64_t>("/drive/a", "driveState"); }
    Quality quality();
    std::string events();
    bool hasTold(const std::string& words) { return events().find(words) != std::string::npos; }

private:
    struct Told {
        std::mutex mutex;
        std::string text;
    };
    std::shared_ptr<Told> told_ = std::make_shared<Told>();  // outlives the plant's end
};

}  // namespace cortex::modbus::test
