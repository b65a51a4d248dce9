// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/registry.hpp"
#include "cortex/cs/testing.hpp"

#include "world_plants.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace cortex::physics::test {

void addWorldClasses(ClassRegistry& classes);

// A plant with a world, at 1 kHz unless told otherwise. It has started.
class WorldRig : public cs::TestPlant {
public:
    explicit WorldRig(const Entries& entries,
                      std::chrono::microseconds cycle = std::chrono::milliseconds{1});

    double position(const std::string& axis) { return get<double>(axis, "position"); }
    std::vector<double> array(const std::string& path, const std::string& item);
    bool set(const std::string& path, const std::string& item, const Value& value);
    void send(const std::string& path, const std::string& command) {
        cluster().send(path, command);
    }
    // Steps until it is so; false: it never was, within so many cycles.
    template <class Condition>
    bool until(const Condition& condition, int cycles = 2000) {
        for (int i = 0; i < cycles && !condition(); ++i) step();
        return condition();
    }
    CallResult moveTo(const std::string& controller, const std::vector<double>& pose);
    std::string told();  // texts of warnings and errors so far, a line each

private:
    struct Told {
        std::mutex mutex;
        std::string text;
    };
    std::shared_ptr<Told> told_ = std::make_shared<Told>();
};

constexpr std::int64_t brakedStatus = 7;                  // of an axis
constexpr std::int64_t stoppedClosing = 2, atDemand = 3;  // of a gripper's object

}  // namespace cortex::physics::test
