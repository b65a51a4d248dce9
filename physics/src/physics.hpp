// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/archive.hpp"
#include "cortex/core/realtime.hpp"

#include "scene.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace cortex::physics {

// What the drive of a joint is to do in a cycle.
struct JointDemand {
    double position = 0, velocity = 0;
    // In addition to what the drive applies itself. Of a gripper that limits its force: the
    // greatest force of its jaws.
    double effort = 0;
    bool braked = true;  // holds `position`, at rest; a gripper that limits its force holds on
};

struct JointState {
    double position = 0, velocity = 0, acceleration = 0, effort = 0;
    bool strains = false;  // its drive wants more than its greatest effort could give
};

struct BodyState {
    Triple position{}, linearVelocity{}, angularVelocity{};  // in the base frame
    std::array<double, 4> rotation{0, 0, 0, 1};              // unit quaternion x y z w
};

struct ServoOptions {
    double bandwidth = 12;  // Hz; at most 0.08 / step, which is less from steps of 7 ms on
    double dampingRatio = 0.9;
    bool gravityCompensation = true;  // weight, Coriolis and damping come from the drive itself
};

// Numbers of faults of a MujocoWorld.
enum class Trouble : std::uint8_t { None = 0, Diverged = 50, TooManyContacts = 51, Error = 52 };

// MuJoCo with one scene. Made in the setup phase, which allocates and throws; then step() and all
// that reads or writes its state may be called in a tick. One thread at a time.
class Physics {
public:
    // Throws Error with every finding (path, rule, remedy), or with what MuJoCo says.
    explicit Physics(const Scene& scene);
    ~Physics();
    Physics(Physics&&) noexcept;
    Physics& operator=(Physics&&) noexcept;

    // What MuJoCo was given.
    const std::string& mjcf() const;

    std::size_t joints() const;  // in the order of Scene
    std::size_t movingBodies() const;
    JointState joint(std::size_t place) const CORTEX_REALTIME;
    // What weight, Coriolis forces and damping take of the drive of a joint.
    double load(std::size_t place) const CORTEX_REALTIME;
    BodyState body(std::size_t place) const CORTEX_REALTIME;
    int contacts() const CORTEX_REALTIME;
    double energy() const CORTEX_REALTIME;  // J, kinetic and potential

    // Goes on by `seconds` in `steps` equal steps; demands move on at their velocity meanwhile.
    // Trouble: the state is as it was before, but at rest, and why() tells more.
    Trouble step(double seconds, int steps, std::span<const JointDemand> demands,
                 const ServoOptions& options) CORTEX_REALTIME;
    const char* why() const CORTEX_REALTIME;

    // As it was made.
    void reset() CORTEX_REALTIME;
    // All that the next step reads.
    void keep(Archive& archive) CORTEX_REALTIME;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace cortex::physics
