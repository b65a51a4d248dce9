// SPDX-License-Identifier: Apache-2.0
// The behaviour of the active types of water-types.xml, as a plug-in for cortex-agent.
#include "cortex/core/archive.hpp"
#include "cortex/core/registry.hpp"
#include "cortex/cs/simplex_cs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace {

using cortex::Data;
using cortex::Tick;

class LevelController final : public cortex::cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override {
        level_ = input("tank").data<double>("level", "m");
        flow_ = output("pump").data<double>("flow", "m3/s");
        wanted_ = data<double>("wanted", "m");
        gain_ = data<double>("gain", "m2/s");
        resetTime_ = data<double>("resetTime", "s");
    }

    bool stateStartingUp(const Tick&) CORTEX_REALTIME override {
        integral_ = 0;
        return true;
    }

    void stateActive(const Tick& tick) CORTEX_REALTIME override {
        const double missing = wanted_ - level_;
        const double change = missing * tick.elapsedSeconds() / resetTime_;
        const double flow = gain_ * (missing + integral_ + change);
        // At its limit the pump gives no more, so the integral part must not grow either.
        if (std::abs(flow) < mostFlow || flow * missing < 0) integral_ += change;
        flow_ = std::clamp(flow, -mostFlow, mostFlow);
    }

    void keep(cortex::Archive& archive) override {
        archive.version("LevelController", 1);
        archive & integral_;
    }

    static constexpr double mostFlow = 0.01;  // m3/s, as PumpFlow has it

    Data<const double> level_;
    Data<double> flow_, wanted_;
    Data<double> gain_, resetTime_;
    double integral_ = 0;
};

// Active itself, it keeps the controllers Active; otherwise, or above `highest`, in Standby.
class LevelSupervisor final : public cortex::cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override {
        highest_ = data<double>("highest");
        for (const auto& tank : inputs("tanks")) levels_.push_back(tank.data<double>("level"));
        for (const auto& controller : outputs("controllers"))
            controllers_.push_back(lifeCycle(controller, true));
    }

    void stateActive(const Tick&) CORTEX_REALTIME override {
        for (const auto& level : levels_)
            if (level > highest_) return fault(1, "a tank is too full");
        for (auto& controller : controllers_)
            if (controller.state() == cortex::State::Standby) controller.startup();
    }

    bool stateShuttingDown(const Tick&) CORTEX_REALTIME override {
        stopAll();
        return std::ranges::all_of(controllers_, rests);
    }

    bool stateFault(const Tick&) CORTEX_REALTIME override {
        stopAll();
        return std::ranges::none_of(levels_,
                                    [this](const auto& level) { return level > highest_; });
    }

    static bool rests(const LifeCycleSender& controller) {
        const cortex::State state = controller.state();
        return state == cortex::State::Standby || state == cortex::State::Fault;
    }

    void stopAll() CORTEX_REALTIME {
        for (auto& controller : controllers_)
            if (!rests(controller)) controller.shutdown();
    }

    Data<double> highest_;
    std::vector<Data<const double>> levels_;
    std::vector<LifeCycleSender> controllers_;
};

class PumpDrive final : public cortex::cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override {
        wish_ = input("wish").data<double>("flow");
        flow_ = output("pump").data<double>("flow");
    }

    void stateActive(const Tick&) CORTEX_REALTIME override { flow_ = wish_; }

    Data<const double> wish_;
    Data<double> flow_;
};

// Whatever leaves a tank enters its neighbour, so the volume stays.
class WaterRing final : public cortex::cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    static constexpr std::size_t tanks = 3;
    static constexpr double valveFlow = 0.004;  // m3/s at one metre of difference, open

    void populate() override {
        for (std::size_t i = 0; i < tanks; ++i) {
            pumps_[i] = inputs("pumps")[i].data<double>("flow");
            levels_[i] = outputs("tanks")[i].data<double>("level");
        }
        opening_ = array<double>("opening");
        area_ = data<double>("area");
        volume_ = data<double>("volume");
    }

    // A device measures in every state.
    void loopEnd(const Tick& tick) CORTEX_REALTIME override {
        std::array<double, tanks> change{};  // m3
        for (std::size_t i = 0; i < tanks; ++i) {
            const std::size_t before = (i + tanks - 1) % tanks;
            const double higher = levels_[before] - levels_[i];
            const double byValve =
                opening_[i] * valveFlow * std::copysign(std::sqrt(std::abs(higher)), higher);
            const double moved = possible(before, i, (pumps_[i] + byValve) * tick.elapsedSeconds());
            change[i] += moved;
            change[before] -= moved;
        }
        double sum = 0;
        for (std::size_t i = 0; i < tanks; ++i) sum += levels_[i] += change[i] / area_;
        volume_ = sum * area_;
    }

    // A tank gives at most half of its water in one step: it has two neighbours.
    double possible(std::size_t from, std::size_t to, double wish) const CORTEX_REALTIME {
        return std::clamp(wish, -levels_[to] * area_ / 2, levels_[from] * area_ / 2);
    }

    std::array<Data<const double>, tanks> pumps_;
    std::array<Data<double>, tanks> levels_;
    std::span<double> opening_;
    Data<double> area_, volume_;
};

void addClasses(cortex::ClassRegistry& registry) {
    registry.add<LevelController>("LevelController");
    registry.add<LevelSupervisor>("LevelSupervisor");
    registry.add<PumpDrive>("PumpDrive");
    registry.add<WaterRing>("WaterRing");
}

}  // namespace

CORTEX_PLUGIN(addClasses, {"LevelController", ""}, {"LevelSupervisor", ""}, {"PumpDrive", ""},
              {"WaterRing", ""})
