// SPDX-License-Identifier: Apache-2.0
#include "plugin/plugins.hpp"

#include "cortex/core/simplex_tree.hpp"

#include "motion/motion_views.hpp"

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

const QString folderOfViews = QStringLiteral(CORTEX_BINARY_DIR "/lib/views");

std::string viewOf(const std::string& type) {
    const TypeModel types = TypeModel::load(CORTEX_SOURCE_DIR "/ontology/robotics-morphology.xml");
    const ViewType* view = Plugins{{folderOfViews}}.viewFor(*types.find(type), types);
    return view == nullptr ? "none" : view->name;
}

TEST(Plugins, TheMostDerivedTypeThatHasAViewWins) {
    EXPECT_EQ(viewOf("SimulatedAxis"), "says-all");  // AxisDevice is nearer than Active
    EXPECT_EQ(viewOf("HoldAxisController"), "throws");
    EXPECT_EQ(viewOf("FollowAxisController"), "nothing");  // by Active
    EXPECT_EQ(viewOf("VirtualAxis"), "none");
}

TEST(Plugins, OneOfAnotherVersionIsNamedWithWhatToDo) {
    const Plugins plugins{{folderOfViews}};
    ASSERT_EQ(plugins.problems().size(), 1);
    const QString& problem = plugins.problems().front();
    EXPECT_TRUE(problem.contains("views_of_another_version.so")) << problem.toStdString();
    EXPECT_TRUE(problem.contains("Build it again")) << problem.toStdString();
}

TEST(Plugins, AViewOfTheProgramGivesWayToOneOfASharedObjectForTheSameType) {
    const TypeModel types = TypeModel::load(CORTEX_SOURCE_DIR "/ontology/robotics-morphology.xml");
    Plugins plugins{{folderOfViews}};
    plugins.add(explorer::motionViews());
    const auto nameFor = [&](const char* type) {
        const ViewType* view = plugins.viewFor(*types.find(type), types);
        return view == nullptr ? std::string{} : std::string{view->name};
    };
    EXPECT_EQ(nameFor("JogController"), "orders");
    EXPECT_EQ(nameFor("AxisPoseController"), "pose");
}

TEST(Plugins, AFolderThatIsNotThereIsNoProblem) {
    EXPECT_TRUE(Plugins{{"/no/such/folder"}}.problems().isEmpty());
}

}  // namespace
}  // namespace cortex::test
