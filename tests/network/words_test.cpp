// SPDX-License-Identifier: Apache-2.0
// What `cortex` says on hosts whose network is not as it should be.
#include "core/model_folder.hpp"
#include "network/host.hpp"

#include <optional>
#include <string>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

struct NetworkWords : testing::Test {
    void SetUp() override {
        if (const std::string why = whyNoHosts(); !why.empty()) GTEST_SKIP() << why;
        host.emplace("alone");
        host->command(
            "ip link add eth7 type veth peer name far && "
            "ip address add 10.78.0.1/24 dev eth7");
    }
    // Whatever the exit code is.
    std::string said(const std::string& program) const {
        return host->command("CORTEX_PATH=" CORTEX_SOURCE_DIR "/ontology " CORTEX_BINARY_DIR
                             "/bin/" +
                             program + " || true");
    }

    std::optional<Host> host;
};

TEST_F(NetworkWords, AToolWhereNoInterfaceIsUpSaysSoAtOnce) {
    host->command("ip link delete eth7 && ip link set lo down");
    const std::string words = "no network interface is up, so nobody is heard: ip link set lo up";
    for (const char* verb : {"list", "agents", "doctor"}) {
        EXPECT_NE(said(std::string{"cortex "} + verb).find(words), std::string::npos) << verb;
    }
}

TEST_F(NetworkWords, AToolWhoseInterfaceIsDownNamesItAndItsRemedy) {
    const std::string words = "interface eth7 is down: ip link set eth7 up\n";
    EXPECT_EQ(said("cortex list --interface eth7"), "cortex: " + words);
    EXPECT_EQ(said("cortex list --interface 10.78.0.1"), "cortex: " + words);
    EXPECT_EQ(said("cortex list --interface lo --interface eth7"), "cortex: " + words);
    host->command("ip link set lo down");
    EXPECT_EQ(said("cortex list --interface lo"),
              "cortex: interface lo is down: ip link set lo up\n");
}

// `agent` stands for the program and its system file in what the shell of the host does, in a
// folder of its own. The agent that it started last is ended.
std::string withAgent(const Host& host, const std::string& script) {
    const ModelFolder folder;
    const std::string file = (folder.path() / "mixer.xml").string();
    return host.command(
        "export CORTEX_DOMAIN=0 CORTEX_PATH=" CORTEX_SOURCE_DIR "/ontology PATH=" CORTEX_BINARY_DIR
        "/bin:$PATH; cortex new-system mixer -o " +
        file + " && cd " + folder.path().string() + " && agent() { exec timeout 60 cortex-agent " +
        file + " --frequency 100 --priority 0 \"$@\"; }; " + script +
        "; kill $! && wait $! || true");
}

TEST_F(NetworkWords, AnAgentThatBeganWithoutAnyInterfaceJoinsTheLoopbackInterfaceWhenItComes) {
    host->command("ip link delete eth7 && ip link set lo down");
    const std::string said = withAgent(*host,
                                       "agent & until cortex list --timeout 1 | grep /drive || ! "
                                       "kill -0 $!; do ip link set lo up; "
                                       "done");
    EXPECT_NE(said.find("/drive "), std::string::npos) << said;
}

TEST_F(NetworkWords, AnAgentThatKeepsToTheLoopbackInterfaceSaysThatOthersAreNotOnIt) {
    host->command("ip link set eth7 up && ip link set far up");
    const std::string said = withAgent(*host,
                                       "agent --log /dev/null & first=$!; "
                                       "until grep -q :1CF3 /proc/net/udp || ! kill -0 $!; "
                                       "do sleep 0.01; done; agent --interface lo >said 2>&1 & "
                                       "until grep 'keeps to the loopback' said || ! kill -0 $!; "
                                       "do sleep 0.01; done; kill $first");
    EXPECT_NE(said.find("keeps to the loopback interface, on which others of domain 0 are not: "
                        "leave --interface (CORTEX_INTERFACE) out"),
              std::string::npos)
        << said;
}

}  // namespace
}  // namespace cortex::test
