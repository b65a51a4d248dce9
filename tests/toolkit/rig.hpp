// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/error.hpp"
#include "cortex/core/registry.hpp"
#include "cortex/cs/cluster_cs.hpp"
#include "cortex/toolkit/classes.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {

// A few simplexes of the shipped types on a manual trigger of 1 kHz. Concepts without a writer are
// written by the test between cycles.
class Rig {
public:
    using Pairs = std::vector<std::pair<std::string, std::string>>;

    explicit Rig(std::string agent = "rig") : name{std::move(agent)} { addClasses(registry); }

    void add(const std::string& path, const std::string& type, const Pairs& relates = {},
             const Pairs& settings = {}) {
        SystemDescription::SimplexEntry entry;
        entry.path = path;
        entry.type = type;
        for (const auto& [rule, to] : relates)
            entry.relates.push_back({rule, to, false, false, {}});
        for (const auto& [item, value] : settings) entry.settings.push_back({item, value, {}});
        system.simplexes.push_back(entry);
    }

    void start() {
        Report report;
        tree.add(system, &registry, report);
        ASSERT_TRUE(report.ok()) << report.text();
        cluster.addSimplexTree(tree);
        cluster.useClasses(registry);
        trigger = &cluster.setTriggerSource<cs::ManualTrigger>(std::chrono::milliseconds{1});
        ASSERT_NO_THROW(cluster.start());
        step();
    }
    void startUp() {
        const CallResult answer =
            call("/" + name, "startup", {{"prefix", Value{std::vector<std::string>{"/"}}}});
        ASSERT_TRUE(answer.done()) << answer.text();
    }
    CallResult call(const std::string& path, const std::string& command,
                    const ProgramInterface::Arguments& arguments = {}) {
        const std::uint64_t sent = cluster.send(path, command, arguments);
        CallResult answer;
        for (int i = 0; i < 20'000 && !cluster.program().poll(sent, answer); ++i) step();
        return answer;
    }
    void step(std::int64_t cycles = 1) { trigger->step(cycles); }

    template <class T>
    T get(const std::string& path, const std::string& item) {
        return cluster.image().get<T>(path, item);
    }
    std::vector<double> array(const std::string& path, const std::string& item) {
        return std::get<std::vector<double>>(cluster.image().value(path, item));
    }
    State state(const std::string& path) {
        return static_cast<State>(get<std::int64_t>(path, "state"));
    }

    std::string name;
    ClassRegistry registry;
    SystemDescription system;
    SimplexTree tree{TypeModel::load(CORTEX_SOURCE_DIR "/ontology/robotics-morphology.xml")};
    cs::ClusterCS cluster{name};
    cs::ManualTrigger* trigger = nullptr;
};

}  // namespace cortex::toolkit::test
