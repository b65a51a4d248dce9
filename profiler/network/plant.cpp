// SPDX-License-Identifier: Apache-2.0
#include "plant.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/clock.hpp"

#include <algorithm>
#include <memory>

namespace cortex::profiler {
namespace {

class Worker final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override {
        for (OutputSimplex& each : outputs("stamped")) {
            stamps_.push_back(each.data<std::int64_t>("stamp"));
        }
    }
    void stateActive(const Tick& /*tick*/) override {
        for (Data<std::int64_t>& stamp : stamps_) stamp = monotonicNow();
    }
    std::vector<Data<std::int64_t>> stamps_;
};

SimplexTree treeOf(const Plant::Options& options) {
    SimplexTree tree{TypeModel::load(CORTEX_SOURCE_DIR "/profiler/network/network-rules.xml")};
    auto& worker = tree.add<Worker>("/" + options.name + "/worker", "Worker");
    for (int i = 0; i < options.samples; ++i) tree.add(samplePath(options.name, i), "Sampled");
    for (const std::string& path : options.links) tree.relateRemote(worker, "observed", path);
    if (options.links.empty() && options.samples > 0) {
        tree.relate(worker, "stamped", tree.at(samplePath(options.name, options.samples - 1)));
    }
    return tree;
}

std::unique_ptr<CommunicationInterface> interfaceOf(const Plant::Options& options) {
    if (options.network) return std::make_unique<comms::DdsInterface>(*options.network);
    return nullptr;
}

}  // namespace

Plant::Plant(const Options& options)
    : links{options.links},
      tree{treeOf(options)},
      cluster{options.name, options.cluster},
      network{cluster.addInterface<TimedInterface>(interfaceOf(options))} {
    cluster.addSimplexTree(tree);
}

void Plant::start() {
    cluster.start();
    if (links.empty()) cluster.call("/" + cluster.agent().name() + "/worker", "startup");
}

bool Plant::linked() {
    const Image image = cluster.image();
    return std::ranges::all_of(
        links, [&](const std::string& path) { return image.quality(path) != Quality::Lost; });
}

std::string samplePath(const std::string& agent, int number) {
    return "/" + agent + "/n" + std::to_string(number);
}

std::vector<std::string> samplePaths(const std::string& agent, int count) {
    std::vector<std::string> paths;
    for (int i = 0; i < count; ++i) paths.push_back(samplePath(agent, i));
    return paths;
}

}  // namespace cortex::profiler
