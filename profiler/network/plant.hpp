// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/dds_interface.hpp"
#include "cortex/cs/cluster_cs.hpp"

#include "measure/comms_domain.hpp"
#include "timed_interface.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cortex::profiler {

inline constexpr int itemsPerSample = 10;

// An agent of this process: a worker, and samples of ten items `/<name>/n0`, …, the last of which
// the worker stamps with monotonicNow() in each cycle. With links it stamps nothing and observes.
struct Plant {
    struct Options {
        std::string name;
        int samples = 1;
        std::vector<std::string> links{};  // paths of samples of other agents
        std::optional<comms::NetworkOptions> network{};
        cs::ClusterOptions cluster{};
    };
    explicit Plant(const Options& options);

    void start();   // after setting its trigger; the worker too
    bool linked();  // values of all that it links are there

    std::vector<std::string> links;
    SimplexTree tree;
    cs::ClusterCS cluster;
    TimedInterface& network;
};

std::string samplePath(const std::string& agent, int number);
std::vector<std::string> samplePaths(const std::string& agent, int count);

}  // namespace cortex::profiler
