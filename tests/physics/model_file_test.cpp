// SPDX-License-Identifier: Apache-2.0
// What `cortex-agent --dump-mjcf` writes of a real world is a file for MuJoCo itself.
#include "cli/cortex_process.hpp"
#include "core/model_folder.hpp"

#include <array>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

namespace cortex::physics::test {
namespace {

TEST(ModelFile, OfAnAgentIsLoadedByMujocoItself) {
    const cortex::test::ModelFolder folder;
    folder.write("cell.xml",
                 "<system name='cell'><morphology file='physics-morphology.xml'/>"
                 "<cluster name='cell' frequency='1000'/>"
                 "<simplex path='/arm' type='SerialManipulator'>"
                 "<relate rule='axes' to='/arm/axis'/><relate rule='demands' to='/arm/demand'/>"
                 "</simplex><simplex path='/arm/axis' type='KukaLbrAxis2'/>"
                 "<simplex path='/arm/demand' type='KukaLbrAxis2'/>"
                 "<simplex path='/hold' type='HoldAxisController'>"
                 "<relate rule='axes' to='/arm/axis'/><relate rule='demands' to='/arm/demand'/>"
                 "</simplex><simplex path='/world' type='MujocoWorld'>"
                 "<relate rule='manipulators' to='/arm'/>"
                 "<relate rule='observations' to='/arm/axis'/>"
                 "<relate rule='demands' to='/arm/demand'/></simplex></system>");
    const cortex::test::Outcome agent = cortex::test::runProgram(
        "sh", {"-c", "exec " CORTEX_BINARY_DIR "/bin/cortex-agent cell.xml --dump-mjcf >mjcf.xml"},
        {}, folder.path().string());
    ASSERT_EQ(agent.exit, 0) << agent.errors;

    std::array<char, 1000> error{};
    const std::unique_ptr<mjModel, void (*)(mjModel*)> model{
        mj_loadXML((folder.path() / "mjcf.xml").c_str(), nullptr, error.data(), error.size()),
        &mj_deleteModel};

    ASSERT_NE(model, nullptr) << error.data();
    EXPECT_EQ(model->nq, 1);
    EXPECT_EQ(mj_name2id(model.get(), mjOBJ_JOINT, "/arm/axis"), 0);
    EXPECT_DOUBLE_EQ(mj_getTotalmass(model.get()), 6.35);
}

}  // namespace
}  // namespace cortex::physics::test
