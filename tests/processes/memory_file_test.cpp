// SPDX-License-Identifier: Apache-2.0
// What an agent remembers survives its restart, in a file.
#include "cortex/core/value.hpp"

#include "cli/cortex_process.hpp"
#include "comms/past_of.hpp"
#include "processes/station.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

namespace fs = std::filesystem;

using Texts = std::vector<std::string>;

class RememberedOverRestarts : public testing::Test {
protected:
    static fs::path systemIn(const ModelFolder& in) {
        return plantIn(in, "/counter", "Counter",
                       "<data name='count' kind='int' min='0' retain='true'/>"
                       "<data name='gain' kind='float' max='10' default='1' settable='always'/>"
                       "<data name='share' kind='float'/>"
                       "<data name='title' kind='string' capacity='40'/>");
    }
    AgentProcess agentIn(const ModelFolder& in, std::vector<std::string> options = {}) const {
        options.insert(options.end(), {"--plugin", CORTEX_BINARY_DIR "/lib/plugins/counter.so"});
        return {in, systemIn(in), options};
    }
    AgentProcess agentWith(const std::vector<std::string>& options = {}) const {
        return agentIn(folder, options);
    }
    std::string text() const { return fs::exists(memory) ? textOf(memory) : ""; }
    bool isWritten(const std::string& part) {
        return station.waitFor([&] { return contains(text(), part); });
    }
    void cortexHere(Texts words) {
        const comms::NetworkOptions network = comms::loopback();
        for (const std::string& each :
             {std::string{"--domain"}, std::to_string(network.domain), std::string{"--interface"},
              network.interfaces.front(), std::string{"--timeout"}, std::string{"60"}})
            words.push_back(each);
        const Outcome done = cortex(words);
        ASSERT_EQ(done.exit, 0) << done.errors;
    }
    void setGain(const std::string& value) { cortexHere({"set", "/counter", "gain=" + value}); }
    // The commands of all starts, as tools are told them.
    std::vector<std::string> commands() {
        std::vector<std::string> found;
        const comms::PastEvents past = comms::pastOf(station.mirror(), "plant");
        if (!past.trouble.empty()) found.push_back(past.trouble);
        for (const AgentEvent& event : past.events) {
            if (event.kind != "command") continue;
            const std::size_t name = event.text.find("set(");
            if (name == std::string::npos) continue;
            found.push_back(event.text.substr(name, event.text.find(')') + 1 - name));
        }
        return found;
    }

    const ModelFolder folder;
    const fs::path memory = folder.path() / "plant.memory";
    Station station;
};

TEST_F(RememberedOverRestarts, EachCommandOfManyInASecondStandsThereWordForWordAndInOrder) {
    AgentProcess agent = agentWith();
    Texts sent;
    std::string lines;
    for (int i = 0; i < 50; ++i) {
        const std::string value = toText(i / 8.0);
        lines += "set /counter gain=" + value + "\n";
        sent.push_back("set(gain=" + value + ")");
    }
    cortexHere({"shell", folder.write("lines.txt", lines).string()});

    EXPECT_TRUE(station.waitFor([&] { return commands() == sent; })) << agent.output();
    ASSERT_TRUE(isWritten(sent.back()));
    std::size_t last = 0;
    const std::string file = text();
    for (const std::string& each : sent) {
        const std::size_t at = file.find(each, last);
        ASSERT_NE(at, std::string::npos) << each << "\n" << file;
        last = at;
    }
}

TEST_F(RememberedOverRestarts, ACommandIsToldThoughTheAgentWasKilled) {
    AgentProcess agent = agentWith();
    setGain("2.5");
    ASSERT_TRUE(isWritten("set(gain=2.5)")) << text();
    const std::int64_t first = station.epochOf("plant");
    agent.kill9();
    AgentProcess again = agentWith();
    ASSERT_TRUE(station.waitFor([&] {
        return station.hears("plant") && station.epochOf("plant") != first;
    })) << again.output();
    setGain("4");

    const Texts both{"set(gain=2.5)", "set(gain=4)"};
    ASSERT_TRUE(station.waitFor([&] { return commands() == both; })) << again.output();
    EXPECT_EQ(again.endInOrder(), 0);
    EXPECT_TRUE(contains(again.output(), "plant.memory: all that happened since 20"))
        << again.output();
    EXPECT_TRUE(contains(text(), "set(gain=4)")) << "the rest is written at the end";
}

TEST_F(RememberedOverRestarts, WhatCannotBeReadIsToldAndTheAgentStartsAllTheSame) {
    const std::string entry = "1\t2\t3\t4\tinfo\tcommand\t/counter\tann: set(gain=1): Done\n";
    folder.write("plant.memory",
                 "cortex-agent memory\t1\tplant\n" + entry + "broken\n" + entry + "1\t2\t3\t4\ter");

    AgentProcess agent = agentWith();
    ASSERT_TRUE(agent.prints("plant.memory: 1 line that cannot be read is left out\n"));

    const Texts both{"set(gain=1)", "set(gain=1)"};
    EXPECT_TRUE(station.waitFor([&] { return commands() == both; })) << agent.output();
    EXPECT_EQ(agent.endInOrder(), 0);
    EXPECT_TRUE(contains(text(), entry + entry)) << text();
    EXPECT_FALSE(contains(text(), "broken"));
}

TEST_F(RememberedOverRestarts, AFileIsMadeSmallerThatHasMoreThanTheAgentKeeps) {
    std::string old = "cortex-agent memory\t1\tplant\nsince\tcommand\t1\n";
    for (int i = 0; i < 10'000; ++i) {
        old += "1\t" + std::to_string(i) + "\t3\t4\tinfo\tcommand\t/counter\tann: set(gain=1)\n";
    }
    folder.write("plant.memory", old);

    AgentProcess agent = agentWith({"--memory-entries", "100", "--seconds", "0.05"});
    EXPECT_EQ(agent.waitForEnd(), 0) << agent.output();

    EXPECT_LT(text().size(), 65'536U);
    EXPECT_TRUE(contains(text(), "1\t9999\t3")) << "the newest are kept";
    EXPECT_TRUE(contains(text(), "since\tcommand\t5\n"));
    EXPECT_TRUE(contains(agent.output(),
                         "plant.memory: the oldest entries are dropped, 9970 in all, as they are "
                         "more than the agent keeps (--memory-entries)\n"))
        << agent.output();
}

TEST_F(RememberedOverRestarts, AFileOfSomethingElseIsRefusedAndLeftAsItIs) {
    const fs::path system = systemIn(folder);
    const fs::path other = folder.write("notes.txt", "notes\n");
    const std::string same = (folder.path() / "same").string();
    for (const auto& [options, told] : std::vector<std::pair<Texts, std::string>>{
             {{"--memory", system.string()}, "it is read by this agent"},
             {{"--memory", other.string()}, "is no file of what an agent remembers"},
             {{"--memory", folder.path().string()}, "is a folder"},
             {{"--memory", same, "--log", same}, "it is that of another option as well"}}) {
        const std::string before = textOf(system);
        AgentProcess agent = agentWith(options);
        EXPECT_EQ(agent.waitForEnd(), 2) << told;
        EXPECT_TRUE(contains(agent.output(), told)) << agent.output();
        EXPECT_EQ(textOf(system), before);
    }
    EXPECT_EQ(textOf(other), "notes\n");
}

TEST_F(RememberedOverRestarts, AStartThatWaitsGoesOnWithTheFileOfTheFirst) {
    AgentProcess first = agentWith();
    setGain("2");
    ASSERT_TRUE(isWritten("set(gain=2)"));
    const ModelFolder other;
    const std::string file = memory.string();
    AgentProcess refused = agentIn(other, {"--memory", file});
    EXPECT_EQ(refused.waitForEnd(), 5) << refused.output();
    AgentProcess second = agentIn(other, {"--memory", file, "--wait"});
    ASSERT_TRUE(second.prints("this one waits until it has ended\n"));
    setGain("3");
    EXPECT_EQ(first.endInOrder(), 0) << first.output();
    ASSERT_TRUE(station.waitFor([&] { return commands() == Texts{"set(gain=2)", "set(gain=3)"}; }))
        << second.output();
    setGain("4");

    EXPECT_EQ(second.endInOrder(), 0) << second.output();
    for (const char* each : {"set(gain=2)", "set(gain=3)", "set(gain=4)"}) {
        EXPECT_TRUE(contains(text(), each)) << text();
    }
    EXPECT_FALSE(contains(refused.output() + second.output(), "not written")) << second.output();
}

}  // namespace
}  // namespace cortex::test
