// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/classes.hpp"

#include "cortex/toolkit/axis_controller_selector.hpp"
#include "cortex/toolkit/axis_controllers.hpp"
#include "cortex/toolkit/axis_pose_controller.hpp"
#include "cortex/toolkit/cartesian_jog_controller.hpp"
#include "cortex/toolkit/gripper_controller.hpp"
#include "cortex/toolkit/jog_controller.hpp"
#include "cortex/toolkit/joint_trajectory_controller.hpp"
#include "cortex/toolkit/pid_controller.hpp"

#include "cartesian_follow_controller.hpp"
#include "ds402/ds402_processor.hpp"
#include "ds402/simulated_drive.hpp"
#include "fieldbus/fieldbus_monitor.hpp"
#include "handset_playback.hpp"
#include "inverse_dynamics.hpp"
#include "kinematics.hpp"
#include "process/filter.hpp"
#include "process/ramp.hpp"
#include "process/rate_limiter.hpp"
#include "process/watchdog.hpp"
#include "processor_selector.hpp"
#include "safety_panel.hpp"
#include "simulated_axis.hpp"
#include "sine_controller.hpp"
#include "tracking_monitor.hpp"

namespace cortex::toolkit {

void addClasses(ClassRegistry& registry) {
    registry.add<ForwardKinematics>("ForwardKinematics");
    registry.add<InverseKinematics>("InverseKinematics");
    registry.add<InverseDynamics>("InverseDynamics");
    registry.add<HoldAxisController>("HoldAxisController");
    registry.add<FollowAxisController>("FollowAxisController");
    registry.add<AxisPoseController>("AxisPoseController");
    registry.add<AxisControllerSelector>("AxisControllerSelector");
    registry.add<JogController>("JogController");
    registry.add<CartesianJogController>("CartesianJogController");
    registry.add<JointTrajectoryController>("JointTrajectoryController");
    registry.add<GripperController>("GripperController");
    registry.add<SineController>("SineController");
    registry.add<CartesianFollowController>("CartesianFollowController");
    registry.add<ProcessorSelector>("ProcessorSelector");
    registry.add<SimulatedAxis>("SimulatedAxis");
    registry.add<HandsetPlayback>("HandsetPlayback");
    registry.add<TrackingMonitor>("TrackingMonitor");
    registry.add<PidController>("PidController");
    registry.add<RateLimiter>("RateLimiter");
    registry.add<Filter>("Filter");
    registry.add<Ramp>("Ramp");
    registry.add<Watchdog>("Watchdog");
    registry.add<Ds402AxisProcessor>("Ds402AxisProcessor");
    registry.add<Ds402SimulatedDrive>("Ds402SimulatedDrive");
    registry.add<FieldbusMonitor>("FieldbusMonitor");
    registry.add<SimulatedSafetyPanel>("SimulatedSafetyPanel");
}

}  // namespace cortex::toolkit
