// SPDX-License-Identifier: Apache-2.0
// The verbs that make and check the folders of keys and rights.
#include "cli/cortex_process.hpp"
#include "cli/json_schema.hpp"
#include "core/model_folder.hpp"

#include <fstream>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;

struct CortexSecurity : testing::Test {
    // `cortex security` in a folder of the test's own.
    Outcome security(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "security");
        return cortex(arguments, {}, folder.path().string());
    }

    ModelFolder folder;
};

TEST_F(CortexSecurity, MakesAnAuthorityAndTheFoldersOfAgentsAndShowsThem) {
    const Outcome authority = security({"create-authority"});
    ASSERT_EQ(authority.exit, 0) << authority.errors;
    EXPECT_NE(authority.output.find("create-agent NAME --authority authority"), std::string::npos);
    const Outcome agent = security({"create-agent", "robot"});
    ASSERT_EQ(agent.exit, 0) << agent.errors;
    EXPECT_NE(agent.output.find("cortex-agent SYSTEM.xml --security robot"), std::string::npos);
    EXPECT_EQ(security({"create-agent", "eye", "--read-only", "--out", "look"}).exit, 0);
    EXPECT_EQ(security({"create-agent", "desk", "--may-command", "/cell", "/belt"}).exit, 0);

    const Outcome shown = security({"show", "desk", "--json"});
    EXPECT_EQ(violationsOf("security", shown.output), "") << shown.output;
    const json desk = json::parse(shown.output);
    EXPECT_EQ(desk["agent"], "desk");
    EXPECT_EQ(desk["may_command"], (json{"/cell", "/belt"}));
    EXPECT_NE(security({"show", "look"}).output.find("only look"), std::string::npos);
    EXPECT_NE(security({"show", "robot"}).output.find("command everything"), std::string::npos);
}

TEST_F(CortexSecurity, RefusesInWords) {
    ASSERT_EQ(security({"create-authority"}).exit, 0);
    ASSERT_EQ(security({"create-agent", "robot"}).exit, 0);
    const Outcome again = security({"create-agent", "robot"});
    EXPECT_EQ(again.exit, 1);
    EXPECT_NE(again.errors.find("nothing is ever overwritten"), std::string::npos) << again.errors;
    std::ofstream{folder.path() / "robot" / "commands.smime"} << "may-command: /";
    const Outcome changed = security({"show", "robot"});
    EXPECT_EQ(changed.exit, 1);
    EXPECT_NE(changed.errors.find("commands.smime was changed"), std::string::npos);
    const Outcome both = security({"create-agent", "x", "--read-only", "--may-command", "/a"});
    EXPECT_EQ(both.exit, 2);
    const Outcome verb = security({"create-agnt", "x"});
    EXPECT_EQ(verb.exit, 2);
    EXPECT_NE(verb.errors.find("create-agent"), std::string::npos) << verb.errors;
}

}  // namespace
}  // namespace cortex::test
