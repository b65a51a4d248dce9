// SPDX-License-Identifier: Apache-2.0
// Parameters of commands that are arrays: both ends see them as spans.
#include "cortex/core/error.hpp"

#include "support/agent_rig.hpp"

#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

struct ArrayParameters : testing::Test {
    test::AgentRig rig;
    test::Hand& boss = rig.hand("/boss", "Boss");
    test::Hand& worker = rig.hand("/worker");

    void SetUp() override {
        rig.tree.relate(boss, "workers", worker);
        rig.make();
    }
    std::string errorOf(const auto& function) {
        try {
            function();
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    }
};

TEST_F(ArrayParameters, GoToTheHandlerAndBack) {
    const auto in = worker.arrayArgument<double>("mix", "list");
    const auto out = worker.arrayResult<double>("mix", "list");
    worker.on("mix", [=](Call& call) {
        const std::span<const double> given = call[in];
        const std::span<double> twice = call[out];
        for (std::size_t i = 0; i < given.size(); ++i) twice[i] = 2 * given[i];
        return Outcome::Done;
    });
    CommandSender sender = boss.output("workers").command("mix");
    const std::span<double> list = sender.arrayArgument<double>("list");
    const std::span<const double> answer = sender.arrayResponse<double>("list");
    ASSERT_EQ(list.size(), 2U);
    list[0] = 1.5;
    list[1] = -4;
    boss.run = [&] {
        sender.send();
        boss.run = nullptr;
    };
    rig.start();
    rig.step(2);

    EXPECT_EQ(sender.answer().outcome, Outcome::Done) << sender.answer().why.view();
    EXPECT_EQ((std::vector<double>{answer.begin(), answer.end()}), (std::vector<double>{3, -8}));
}

TEST_F(ArrayParameters, AreNotTakenForScalarsNorForAnotherKind) {
    CommandSender sender = boss.output("workers").command("mix");

    EXPECT_NE(errorOf([&] { worker.argument<double>("mix", "list"); }).find("array"),
              std::string::npos);
    EXPECT_NE(errorOf([&] { worker.arrayArgument<bool>("mix", "list"); }).find("float"),
              std::string::npos);
    EXPECT_NE(errorOf([&] { sender.argument<double>("list"); }).find("as one float"),
              std::string::npos);
    EXPECT_NE(errorOf([&] { sender.arrayArgument<std::int64_t>("list"); }).find("array of int"),
              std::string::npos);
}

}  // namespace
}  // namespace cortex
