// SPDX-License-Identifier: Apache-2.0
#include "teleop.hpp"

#include "cortex/toolkit/classes.hpp"

#include "mechanics/lbr_chain.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using mechanics::Pose;

void replace(std::string& text, const std::string& from, const std::string& to) {
    std::size_t place = text.find(from);
    if (place == std::string::npos) throw std::runtime_error("the system file has no " + from);
    for (; place != std::string::npos; place = text.find(from, place + to.size())) {
        text.replace(place, from.size(), to);
    }
}

SimplexTree read(const std::filesystem::path& file, const ClassRegistry& registry) {
    const std::array files{file};
    return SimplexTree::load(files, &registry);
}

ClassRegistry classes(const std::function<void(ClassRegistry&)>& more) {
    ClassRegistry registry;
    toolkit::addClasses(registry);
    if (more) more(registry);
    return registry;
}

}  // namespace

TeleopFile::TeleopFile(const Replacements& replacements, const std::string& ontology) {
    const std::filesystem::path source{CORTEX_SOURCE_DIR};
    std::string text = caseStudy();
    for (const auto& [from, to] : replacements) replace(text, from, to);
    replace(text, "synthetic_hand_path.csv",
            (source / "examples/lbr_teleop/synthetic_hand_path.csv").string());
    if (!ontology.empty()) {
        replace(text, "<morphology", "<ontology file=\"test.xml\"/>\n  <morphology");
        folder_.write("test.xml", "<ontology name=\"test\"><include file=\"robotics.xml\"/>" +
                                      ontology + "</ontology>");
    }
    folder_.write("system.xml", text);
}

Teleop::Teleop(Set set)
    : registry{classes(set.classes)},
      file{set.replacements, set.ontology},
      tree{read(file.path(), registry)} {
    tree.createRelated(&registry);
    if (set.change) set.change(tree);
    cluster = std::make_unique<cs::ClusterCS>("teleop", set.options);
    cluster->addSimplexTree(tree);
    cluster->useClasses(registry);
    trigger = &cluster->setTriggerSource<cs::ManualTrigger>(std::chrono::milliseconds{1});
    if (set.watch) {
        cluster->addHeartbeat([this, watch = set.watch](const cs::Heartbeat& beat) {
            if (beat.alive) watch(cluster->image());
        });
    }
    cluster->start();
}

CallResult Teleop::call(const std::string& path, const std::string& command,
                        const std::string& prefix) {
    ProgramInterface::Arguments arguments;
    if (!prefix.empty()) arguments["prefix"] = Value{std::vector<std::string>{prefix}};
    const std::uint64_t sent = cluster->send(path, command, arguments);
    CallResult answer;
    for (int i = 0; i < 20'000; ++i) {
        step();
        if (cluster->program().poll(sent, answer)) return answer;
    }
    ADD_FAILURE() << path << " " << command << ": no answer within 20 s";
    return answer;
}

void Teleop::startUp() {
    const CallResult answer = call("/teleop", "startup", "/");
    ASSERT_TRUE(answer.done()) << answer.text();
}

void Teleop::runUntil(double time) {
    for (int i = 0; i < 60'000 && pathTime() < time; ++i) step();
}

Axes positionsOf(const Image& image, const std::string& group) {
    Axes positions{};
    for (std::size_t i = 0; i < lbrAxes; ++i) {
        positions[i] =
            image.get<double>("/arm/lbr/" + group + "/" + std::to_string(i + 1), "position");
    }
    return positions;
}

Pose handOf(const Image& image) {
    const auto p = std::get<std::vector<double>>(image.value("/handset/pose", "position"));
    const auto q = std::get<std::vector<double>>(image.value("/handset/pose", "rotation"));
    return {{p[0], p[1], p[2]}, {q[3], q[0], q[1], q[2]}};
}

State stateOf(const Image& image, const std::string& path) {
    return static_cast<State>(image.get<std::int64_t>(path, "state"));
}

bool pressed(const Image& image) { return image.get<bool>("/handset/trigger", "value"); }

Tracking track(Teleop& teleop, double until) {
    const mechanics::SerialChain chain = mechanics::test::lbrChain();
    const auto tipOf = [&](const Image& image) {
        const Axes axes = positionsOf(image, "axes");
        mechanics::SerialChain::JointVector joints(lbrAxes);
        for (std::size_t i = 0; i < lbrAxes; ++i) joints[static_cast<Eigen::Index>(i)] = axes[i];
        return chain.forward(joints);
    };
    const auto motion = [](const Pose& from, const Pose& to) {
        return Pose{to.position - from.position, to.rotation * from.rotation.conjugate()};
    };
    Tracking result;
    Pose handThen, tipThen, lastHand;
    bool held = false;
    int count = 0;
    double way = 0;
    while (teleop.pathTime() < until) {
        teleop.step();
        const Image image = teleop.image();
        const Pose hand = handOf(image);
        const Pose tip = tipOf(image);
        if (pressed(image) && !held) {
            handThen = hand;
            tipThen = tip;
        }
        held = pressed(image);
        if (held && stateOf(image, "/control/follow") == State::Active) {
            const mechanics::Twist error =
                mechanics::difference(motion(handThen, hand), motion(tipThen, tip));
            result.rmsPosition += error.head<3>().squaredNorm();
            result.rmsRotation += error.tail<3>().squaredNorm();
            way += (hand.position - lastHand.position).squaredNorm();
            ++count;
        }
        lastHand = hand;
    }
    if (count == 0) return result;
    result.rmsPosition = std::sqrt(result.rmsPosition / count) * 1e3;
    result.rmsRotation = std::sqrt(result.rmsRotation / count) * 180 / std::numbers::pi;
    result.rmsSpeed = std::sqrt(way / count) * 1e3;
    result.seconds = count * 1e-3;
    return result;
}

}  // namespace cortex::test
