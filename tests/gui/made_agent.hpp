// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/image_pool.hpp"
#include "cortex/core/make_structure.hpp"
#include "cortex/core/simplex_tree.hpp"
#include "cortex/core/tables.hpp"

#include "session/frame.hpp"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cortex::test {

// An agent made by hand with types of the control system's tests, as a frame of the window has it.
class MadeAgent {
public:
    using Fill = std::function<void(SimplexTree&)>;

    MadeAgent(std::string agent, const Fill& fill, const std::string& types = "cs-rules.xml")
        : MadeAgent{std::move(agent), fill,
                    TypeModel::load(CORTEX_SOURCE_DIR "/tests/data/" + types)} {}
    MadeAgent(std::string agent, const Fill& fill, TypeModel types)
        : agent_{std::move(agent)}, tree_{std::move(types)} {
        fill(tree_);
        structure = makeStructure(agent_, tree_);
        tables = std::make_shared<Tables>(structure);
        images_ = std::make_shared<ImagePool>(*tables, 8);
    }

    std::uint32_t at(std::string_view path) const { return structure->find(path); }
    void put(std::string_view path, std::string_view item, std::int64_t value) {
        *static_cast<std::int64_t*>(cell(path, item, Kind::Int)) = value;
    }
    void put(std::string_view path, std::string_view item, double value) {
        *static_cast<double*>(cell(path, item, Kind::Float)) = value;
    }
    void put(std::string_view path, std::string_view item, const std::string& text) {
        const std::uint32_t simplex = at(path);
        const ItemLayout* layout = structure->simplexes[simplex].layout->find(item);
        storeValue(*layout->item, Value{std::vector<std::string>{text}},
                   tables->live(simplex).at(Kind::String, layout->offset));
    }
    void degrade(std::string_view path, Quality quality) {
        tables->live(at(path)).state->quality = quality;
    }
    void degrade(std::string_view path, Quality quality, std::string_view cause) {
        degrade(path, quality);
        tables->live(at(path)).state->cause = at(cause);
    }
    // "running" or "lost", with all values as they are now, also when this agent is gone.
    gui::AgentFrame now(const std::string& state = "running") {
        gui::AgentFrame frame;
        frame.status.name = agent_;
        frame.status.state = state;
        frame.status.simplexes = static_cast<std::uint32_t>(structure->simplexes.size());
        frame.status.period = 1'000'000;
        frame.status.epoch = structure->epoch;
        frame.structure = structure;
        ++cycle_;
        const std::int64_t time = (cycle_ + waited_) * period;
        images_->publish(cycle_, time, start + time);
        const auto kept =
            std::make_shared<std::pair<std::shared_ptr<Tables>, std::shared_ptr<ImagePool>>>(
                tables, images_);
        std::vector<bool> came;  // what other agents have does not
        for (const SimplexInfo& each : structure->simplexes)
            came.push_back(!each.remote && each.path != unasked);
        frame.image = std::make_shared<comms::AgentImage>(kept, images_->newest(), std::move(came),
                                                          state == "lost", behind);
        frame.ages.assign(structure->simplexes.size(), 0.1F);
        return frame;
    }

    void skip(std::int64_t cycles) { cycle_ += cycles; }
    void wait(std::int64_t periods) { waited_ += periods; }  // in which no cycle runs
    double seconds() const {                                 // of the next cycle
        return static_cast<double>((cycle_ + 1 + waited_) * period) * 1e-9;
    }
    std::int64_t cycle() const { return cycle_; }

    static constexpr std::int64_t period = 1'000'000;                 // ns
    static constexpr std::int64_t start = 1'700'000'000'000'000'000;  // UTC ns

    std::shared_ptr<const Structure> structure;
    std::shared_ptr<Tables> tables;
    std::vector<bool> behind;  // the cycle, by simplex
    std::string unasked;       // path whose values do not come

private:
    void* cell(std::string_view path, std::string_view item, Kind kind) {
        const std::uint32_t simplex = at(path);
        const ItemLayout* layout = structure->simplexes[simplex].layout->find(item);
        return tables->live(simplex).at(kind, layout->offset);
    }

    std::string agent_;
    SimplexTree tree_;
    std::shared_ptr<ImagePool> images_;
    std::int64_t cycle_ = 0, waited_ = 0;
};

// As the agent itself shows who holds what of it.
inline void giveLease(MadeAgent& agent, const std::string& own, const std::string& prefix,
                      const std::string& holder, std::int64_t cycle = 0) {
    const std::uint32_t simplex = agent.at(own);
    for (const auto& [item, text] : {std::pair{"leasePrefix", prefix}, {"leaseHolder", holder}}) {
        const ItemLayout* layout = agent.structure->simplexes[simplex].layout->find(item);
        std::vector<std::string> texts(layout->item->length);
        texts.front() = text;
        storeValue(*layout->item, Value{texts},
                   agent.tables->live(simplex).at(Kind::String, layout->offset));
    }
    const ItemLayout* since = agent.structure->simplexes[simplex].layout->find("leaseSince");
    std::vector<std::int64_t> cycles(since->item->length);
    cycles.front() = cycle;
    storeValue(*since->item, Value{cycles},
               agent.tables->live(simplex).at(Kind::Int, since->offset));
}

// A frame of these agents, with a number and structures of its own.
inline std::shared_ptr<gui::Frame> frameOf(std::vector<gui::AgentFrame> agents) {
    static std::uint64_t count = 0;
    auto frame = std::make_shared<gui::Frame>();
    frame->joined = true;
    frame->number = ++count * 15;  // filters look at conditions anew
    frame->structures = count;
    frame->agents = std::move(agents);
    return frame;
}

}  // namespace cortex::test
