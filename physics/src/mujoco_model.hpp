// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include <mujoco/mujoco.h>

namespace cortex::physics {

struct DeleteMujoco {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
};
using MujocoModel = std::unique_ptr<mjModel, DeleteMujoco>;
using MujocoData = std::unique_ptr<mjData, DeleteMujoco>;

// Throw Error with what MuJoCo says. Setup phase; any thread. No file is read or written.
MujocoModel loadModel(const std::string& mjcf);
// All of its memory was used once, so that no step waits for a page of it.
MujocoData makeData(const mjModel& model);

}  // namespace cortex::physics
