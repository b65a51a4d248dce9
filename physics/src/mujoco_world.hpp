// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include "model_text.hpp"
#include "physics.hpp"
#include "scene_reader.hpp"
#include "world_axis.hpp"
#include "world_gripper.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cortex::physics {

// Class of type MujocoWorld (ontology/physics.xml): docs/physics.md.
class MujocoWorld final : public cs::SimplexCS, public toolkit::HasModelText {
public:
    using SimplexCS::SimplexCS;

    std::string modelText() const override;  // as MJCF; "" before it is populated

private:
    static constexpr std::int64_t safetyStop = 40;  // fault code; those of Trouble are the others
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    struct Pose {  // of a body
        std::span<double> position, rotation, linearVelocity, angularVelocity;
    };

    void populate() override;
    void bindAxes(const SceneMap& map, const WorldRelations& relations);
    void noteLoose(const Scene& scene);
    void bindItems();
    bool stateStartingUp(const Tick& tick) CORTEX_REALTIME override;
    void stateActive(const Tick& tick) CORTEX_REALTIME override;
    bool stateFault(const Tick&) CORTEX_REALTIME override { return !stands_; }
    void loopEnd(const Tick& tick) CORTEX_REALTIME override;
    void keep(Archive& archive) CORTEX_REALTIME override;

    Outcome brake(Call& call) CORTEX_REALTIME;
    Outcome release(Call& call) CORTEX_REALTIME;
    Outcome reset(Call& call) CORTEX_REALTIME;

    bool isSafetyStop() const CORTEX_REALTIME;
    void faultBySafety() CORTEX_REALTIME;
    // The first axis that is away from its demand; none: all of them may be released.
    std::size_t firstAway() const CORTEX_REALTIME;
    EventText whyAway(std::size_t axis) const CORTEX_REALTIME;
    void brakeWhereNeeded() CORTEX_REALTIME;
    void lead() CORTEX_REALTIME;
    void step(const Tick& tick) CORTEX_REALTIME;
    void tellIfSlow(bool lacksSteps, const Tick& tick) CORTEX_REALTIME;
    void tellIfCarriedTwice() CORTEX_REALTIME;
    EventText textOf(Trouble trouble) const CORTEX_REALTIME;
    void fail(Trouble trouble, const EventText& text) CORTEX_REALTIME;
    AxisStatus statusOf(std::size_t axis) const CORTEX_REALTIME;
    void show(double seconds) CORTEX_REALTIME;

    std::optional<Physics> physics_;
    std::vector<WorldAxis> axes_;       // in the order of the scene's joints
    std::vector<WorldGripper> grips_;   // of the grippers that limit their force
    std::vector<std::size_t> gripOf_;   // of each axis: its place there, or none
    std::vector<Pose> poses_;           // of the bodies with a mass
    std::vector<JointDemand> demands_;  // of this cycle
    Data<const double> timeStep_, bandwidth_, dampingRatio_;
    Data<const bool> gravityCompensation_, emergencyStop_, protectiveStop_;
    Data<std::int64_t> contacts_;
    Data<double> energy_;
    Data<bool> braked_;

    EventText loose_;  // which gripper no arm carries; empty: none

    std::vector<double> held_;  // where each axis was when the brakes came on
    double waited_ = 0;         // s, in StartingUp
    std::int64_t slow_ = 0;     // cycles in a row that had more time than their steps
    bool toldTwice_ = false;    // that demands bring the weight, too
    bool isCommanded_ = false;  // the brakes are on by command
    bool isLost_ = false;       // they are on since an input was lost
    bool stands_ = false;       // in Fault: the physics failed again
};

}  // namespace cortex::physics
