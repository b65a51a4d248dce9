// SPDX-License-Identifier: Apache-2.0
// Values that cannot be, as the tools show them.
#include "cli/cortex_process.hpp"
#include "comms/inbox.hpp"
#include "processes/station.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cortex::test {
namespace {

// A counter whose type says that it counts to 1, and that its share, which is 0.25, is at most 0.2.
struct WrongValues : testing::Test {
    WrongValues() {
        system = plantIn(folder, "/counter", "Counter",
                         "<data name='count' kind='int' labels='0:None 1:One'/>"
                         "<data name='gain' kind='float' min='0' max='10' default='1'/>"
                         "<data name='share' kind='float' max='0.2'/>"
                         "<data name='title' kind='string'/>");
    }
    static std::string tool(std::vector<std::string> arguments) {
        const comms::NetworkOptions network = comms::loopback();
        arguments.insert(arguments.end(), {"--domain", std::to_string(network.domain),
                                           "--interface", network.interfaces.front()});
        const Outcome outcome = cortex(arguments);
        EXPECT_EQ(outcome.exit, 0) << outcome.errors;
        return outcome.output;
    }
    static nlohmann::json json(std::vector<std::string> arguments) {
        arguments.emplace_back("--json");
        return nlohmann::json::parse(tool(std::move(arguments)), nullptr, false);
    }

    ModelFolder folder;
    std::filesystem::path system;
    Station station;
};

TEST_F(WrongValues, AreMarkedByEveryTool) {
    AgentProcess agent{folder, system, {"--plugin", CORTEX_BINARY_DIR "/lib/plugins/counter.so"}};
    ASSERT_TRUE(station.waitFor([&] { return station.number("/counter", "count") > 1; }));
    EXPECT_TRUE(station.waitFor(
        [&] { return station.hasEvent("/counter", "none of its labels 0:None 1:One"); }));

    const std::string shown = tool({"show", "/counter"});
    EXPECT_TRUE(contains(shown, "  <- none of its labels")) << shown;
    EXPECT_TRUE(contains(shown, "0.25  <- above 0.2")) << shown;
    const auto data = json({"show", "/counter"})["data"];
    EXPECT_EQ(data["count"]["wrong"], "none of its labels");
    EXPECT_EQ(data["share"]["wrong"], "above 0.2");
    EXPECT_FALSE(data["gain"].contains("wrong"));

    const std::string listed = tool({"list", "/counter"});
    EXPECT_TRUE(contains(listed, ", 2 values out of range")) << listed;
    EXPECT_EQ(json({"list", "/counter"})[0]["wrong"], 2);
    EXPECT_EQ(json({"list", "/output"})[0]["wrong"], 0);

    const std::string watched = tool({"watch", "/counter.share", "--count", "1"});
    EXPECT_TRUE(contains(watched, "0.25  <- above 0.2") || contains(watched, "0.25  stale  <- "))
        << watched;
    const std::string csv = tool({"watch", "/counter.share", "--count", "1", "--csv"});
    EXPECT_FALSE(contains(csv, "<-")) << "a table of plain numbers: " << csv;
}

}  // namespace
}  // namespace cortex::test
