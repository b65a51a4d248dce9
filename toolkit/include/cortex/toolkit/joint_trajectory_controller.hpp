// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/slow_work.hpp"
#include "cortex/toolkit/axis_pose_controller.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cortex::toolkit {

class JointPoints;

// Teach and repeat: keeps points, which are poses of all axes, and goes from one to the next, all
// axes at once and at rest in each. Points are kept in files below the folder of the program.
class JointTrajectoryController : public AxisPoseController {
public:
    explicit JointTrajectoryController(Identity identity);
    ~JointTrajectoryController() override;

protected:
    void populate() override;
    bool stateStartingUp(const Tick& tick) CORTEX_REALTIME override;
    void keep(Archive& archive) CORTEX_REALTIME override;

    const JointPoints& points() const { return *points_; }

private:
    struct Files;

    // The commands.
    Outcome teach(Call& call) CORTEX_REALTIME;
    Outcome insert(Call& call) CORTEX_REALTIME;
    Outcome remove(Call& call) CORTEX_REALTIME;
    Outcome clear(Call& call) CORTEX_REALTIME;
    Outcome showPoint(Call& call) CORTEX_REALTIME;
    Outcome run(Call& call) CORTEX_REALTIME;
    Outcome next(Call& call) CORTEX_REALTIME;
    Outcome previous(Call& call) CORTEX_REALTIME;
    Outcome save(Call& call) CORTEX_REALTIME;
    Outcome load(Call& call) CORTEX_REALTIME;

    bool add(Call& call, std::size_t before) CORTEX_REALTIME;
    bool isPoint(Call& call, std::string_view argument, std::int64_t number) const CORTEX_REALTIME;
    bool standsAt(Call& call, std::size_t point) const CORTEX_REALTIME;
    bool begins(Call& call) CORTEX_REALTIME;  // run
    bool goTo(Call& call, std::int64_t number) CORTEX_REALTIME;
    Outcome goOn(Call& call, std::int64_t number) CORTEX_REALTIME;  // next and previous
    Outcome work(Call& call, cs::SlowWork& work, bool begins) CORTEX_REALTIME;

    std::unique_ptr<JointPoints> points_;
    std::unique_ptr<Files> files_;
    std::vector<double> pose_;  // observed, kept within the limits
    Data<std::int64_t> pointCount_, point_;
    Data<std::string_view> name_;
    Data<const double> share_;
    Data<const bool> loop_;
    Argument<std::int64_t> insertAt_, removeAt_, shown_, from_, to_;
    Argument<std::string_view> saveName_, loadName_;
    Result<std::int64_t> taught_;
    ArrayResult<double> position_;
    std::int64_t first_ = 0, last_ = 0;  // of the run
};

}  // namespace cortex::toolkit
