// SPDX-License-Identifier: Apache-2.0
#include "scenarios.hpp"

#include "subject/subject.hpp"

#include <array>
#include <string>
#include <vector>

namespace cortex::profiler {

namespace {

constexpr int tasks = 1024;
constexpr int chain = 4;
constexpr int axes = 256;
constexpr int concepts = 1000;
constexpr int sources = 10;
constexpr std::uint32_t manyCommands = 200;

// Follows its own demand, so that what it measures moves in every cycle.
class Drive final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override {
        demanded_ = input("demanded").data<double>("position");
        position_ = output("measured").data<double>("position");
        velocity_ = output("measured").data<double>("velocity");
    }
    void stateActive(const Tick&) override {
        velocity_ = demanded_ - position_;
        position_ = demanded_;
    }
    Data<const double> demanded_;
    Data<double> position_, velocity_;
};

// Demands what lies within the limits, so that none of them acts: that is what a cycle is like.
class Servo final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override {
        measured_ = input("measured").data<double>("position");
        position_ = output("demanded").data<double>("position");
        velocity_ = output("demanded").data<double>("velocity");
    }
    void stateActive(const Tick&) override {
        position_ = measured_ + (1 - measured_) * 1e-4;
        velocity_ = (1 - measured_) * 0.1;
    }
    Data<const double> measured_;
    Data<double> position_, velocity_;
};

// Writes every item of its concepts.
class Source final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override {
        for (const OutputSimplex& each : outputs("items")) {
            for (int i = 0; i < 10; ++i) {
                items_.push_back(each.data<double>("f" + std::to_string(i)));
            }
        }
    }
    void stateActive(const Tick& tick) override {
        for (Data<double>& item : items_) item = static_cast<double>(tick.cycle);
    }
    std::vector<Data<double>> items_;
};

struct Sink final : cs::SimplexCS {
    using SimplexCS::SimplexCS;
};

std::string path(const char* name, int number) {
    return "/" + std::string{name} + std::to_string(number);
}

SimplexTree newTree() {
    const std::string folder = std::string{CORTEX_SOURCE_DIR} + "/profiler/instructions/";
    return SimplexTree{TypeModel::load(folder + "hot-path-rules.xml")};
}

SimplexTree idle() { return emptySimplexes(1, 1); }

SimplexTree emptyTasks() { return emptySimplexes(tasks, chain); }

SimplexTree oneCommand() {
    Partner::commandsPerCycle = 1;
    return partners(tasks);
}

SimplexTree commandBurst() {
    Partner::commandsPerCycle = manyCommands;
    return partners(10);
}

SimplexTree controlLoops() {
    SimplexTree tree = newTree();
    for (int i = 0; i < axes; ++i) {
        Simplex& servo = tree.add<Servo>(path("servo", i), "Servo");
        Simplex& drive = tree.add<Drive>(path("drive", i), "Drive");
        Simplex& measured = tree.add(path("measured", i), "Measured");
        Simplex& demanded = tree.add(path("demanded", i), "Demanded");
        tree.relate(servo, "measured", measured);
        tree.relate(servo, "demanded", demanded);
        tree.relate(drive, "demanded", demanded);
        tree.relate(drive, "measured", measured);
    }
    return tree;
}

SimplexTree imageAndLatch() {
    SimplexTree tree = newTree();
    for (int i = 0; i < sources; ++i) {
        Simplex& source = tree.add<Source>(path("source", i), "Source");
        Simplex& sink = tree.add<Sink>(path("sink", i), "Sink");
        for (int k = i; k < concepts; k += sources) {
            Simplex& items = tree.add(path("items", k), "TenItems");
            tree.relate(source, "items", items);
            tree.relate(sink, "items", items);
        }
    }
    return tree;
}

constexpr std::array all{
    Scenario{"idle", idle, 0},
    Scenario{"empty-tasks", emptyTasks, 0},
    Scenario{"one-command", oneCommand, tasks},
    Scenario{"command-burst", commandBurst, 10 * manyCommands},
    Scenario{"control-loops", controlLoops, 0},
    Scenario{"image-and-latch", imageAndLatch, 0},
};

}  // namespace

std::span<const Scenario> scenarios() { return all; }

}  // namespace cortex::profiler
