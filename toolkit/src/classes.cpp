// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/classes.hpp"

#include "axis_controllers.hpp"
#include "axis_pose_controller.hpp"
#include "cartesian_follow_controller.hpp"
#include "handset_playback.hpp"
#include "jog_controller.hpp"
#include "kinematics.hpp"
#include "processor_selector.hpp"
#include "simulated_axis.hpp"
#include "tracking_monitor.hpp"

namespace cortex::toolkit {

void addClasses(ClassRegistry& registry) {
    registry.add<ForwardKinematics>("ForwardKinematics");
    registry.add<InverseKinematics>("InverseKinematics");
    registry.add<HoldAxisController>("HoldAxisController");
    registry.add<FollowAxisController>("FollowAxisController");
    registry.add<AxisPoseController>("AxisPoseController");
    registry.add<JogController>("JogController");
    registry.add<SineController>("SineController");
    registry.add<CartesianFollowController>("CartesianFollowController");
    registry.add<ProcessorSelector>("ProcessorSelector");
    registry.add<SimulatedAxis>("SimulatedAxis");
    registry.add<HandsetPlayback>("HandsetPlayback");
    registry.add<TrackingMonitor>("TrackingMonitor");
}

}  // namespace cortex::toolkit
