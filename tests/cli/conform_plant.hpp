// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/testing.hpp"

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

namespace cortex::test {

// The agent "bench" of this process on the network of the test, with the shipped types and those of
// tests/data/conform-types.xml. From start() on a thread steps it: 100 cycles are one second of it.
class ConformPlant {
public:
    ConformPlant();
    ~ConformPlant();
    ConformPlant(const ConformPlant&) = delete;
    ConformPlant& operator=(const ConformPlant&) = delete;

    void add(const std::string& path, const std::string& type,
             const cs::TestPlant::Pairs& relates = {}, const cs::TestPlant::Pairs& settings = {}) {
        plant_.add(path, type, relates, settings);
    }
    // PATH, PATH/is, PATH/wish and a controller PATH/move of these types.
    void addAxis(const std::string& path, const std::string& device,
                 const std::string& mistake = "",
                 const std::string& controller = "AxisPoseController");
    void addBus(const std::string& path, const std::string& mistake);
    // PATH is a drive of one axis, with PATH/is, PATH/set, PATH/wish and the processor PATH/lead.
    void addDrive(const std::string& path, const std::string& type, bool needsHoming = false);
    // PATH is a drive of two jaws, half open, with PATH/is, PATH/set, PATH/wish, the processor
    // PATH/lead and the controller PATH/move.
    void addGripper(const std::string& path);
    // It rests so long between two cycles. By itself it runs a good deal faster than its own time.
    void start(std::chrono::microseconds rest = std::chrono::microseconds{200});
    // What the mechanics of a simulated drive allow.
    void setStops(const std::string& path, double least, double most);

    State state(const std::string& path) { return static_cast<State>(integer(path, "state")); }
    std::int64_t integer(const std::string& path, const std::string& item) {
        return plant_.cluster().image().get<std::int64_t>(path, item);
    }
    double number(const std::string& path, const std::string& item) {
        return plant_.cluster().image().get<double>(path, item);
    }
    Value value(const std::string& path, const std::string& item) {
        return plant_.cluster().image().value(path, item);
    }

private:
    cs::TestPlant plant_;
    std::atomic<bool> ends_{false};
    std::thread steps_;
};

}  // namespace cortex::test
