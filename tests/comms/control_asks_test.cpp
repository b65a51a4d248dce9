// SPDX-License-Identifier: Apache-2.0
// Control that one tool asks another for, over DDS.
#include "cortex/comms/lease_client.hpp"
#include "cortex/core/error.hpp"

#include "comms/stepped_agent.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

struct Asking : testing::Test {
    struct Tool {
        Tool(const std::string& name, const std::string& person) : mirror{name, loopback()} {
            if (!person.empty()) mirror.introduce(person);
            EXPECT_TRUE(comesTrue([this] {
                return mirror.structure("robot") != nullptr &&
                       mirror.structure("station") != nullptr;
            }));
            mirror.view({"/robot", "/station"}, 100);
            leases.acceptOffers([] {});
        }
        bool takes(const std::string& prefix, const std::vector<std::string>& agents) {
            const auto answers = leases.wait(leases.take(prefix, agents));
            return std::ranges::all_of(answers,
                                       [](const auto& each) { return each.answer.done(); });
        }
        bool sees(const std::string& person) const {
            return comesTrue([&] {
                const auto tools = mirror.tools();
                return std::ranges::find(tools, person, &ToolStatus::person) != tools.end();
            });
        }
        bool seesHolder(const std::string& prefix) const {
            return comesTrue([&] { return !leases.holdersOf(prefix).empty(); });
        }
        bool isAsked() const {
            return comesTrue([this] { return !leases.asked().empty(); });
        }
        // The news that came until this one did.
        std::vector<std::string> newsUntil(const std::string& wanted) {
            std::vector<std::string> all;
            EXPECT_TRUE(comesTrue([&] {
                for (const std::string& each : leases.news()) all.push_back(each);
                return std::ranges::find(all, wanted) != all.end();
            })) << wanted
                << (all.empty() ? "" : "; it was: " + all.back());
            return all;
        }
        Mirror mirror;
        LeaseClient leases{mirror};
    };

    Asking() {
        robot.rig.hand("/arm");
        station.rig.hand("/stick");
        robot.run();
        station.run();
    }

    // No faster than its clock: the time of a command is in cycles.
    void stepRobot() {
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
        robot.rig.step();
    }
    // While the test steps the robot.
    bool isDone(Tool& tool, std::uint64_t number) {
        LeaseClient::Answers answers;
        const bool came = comesTrue([&] {
            stepRobot();
            return tool.leases.poll(number, answers);
        });
        for (const auto& each : answers) EXPECT_TRUE(each.answer.done()) << each.answer.text();
        return came;
    }

    SteppedAgent robot{"robot"}, station{"station"};
};

TEST_F(Asking, ToolsKnowOneAnotherBeforeAnybodyHoldsAnything) {
    Tool first{"first", "alice"}, second{"second", "bob"}, verb{"verb", ""};
    EXPECT_TRUE(first.sees("bob"));
    EXPECT_TRUE(second.sees("alice"));
    EXPECT_TRUE(verb.sees("alice"));
    ASSERT_EQ(first.mirror.tools().size(), 1U) << "a verb does not say who uses it";
    EXPECT_EQ(first.mirror.tools().front().name, second.mirror.name());
    EXPECT_THROW(verb.mirror.introduce("bob\n"), Error);
    EXPECT_THROW(verb.mirror.introduce("bob\xc2\x9b"), Error) << "a terminal would obey it";
}

TEST_F(Asking, AreGrantedWithExactlyWhatTheyAreAbout) {
    Tool first{"first", "alice"}, second{"second", "bob"};
    ASSERT_TRUE(first.takes("/", {"robot", "station"}));
    ASSERT_TRUE(second.sees("alice"));
    ASSERT_TRUE(second.seesHolder("/arm"));
    second.leases.ask("/arm");
    ASSERT_EQ(second.leases.asking().holders.size(), 1U);
    EXPECT_EQ(second.leases.asking().holders.front().person, "alice");

    ASSERT_TRUE(first.isAsked());
    const auto asked = first.leases.asked().front();
    EXPECT_EQ(asked.tool, second.mirror.name());
    EXPECT_EQ(asked.person, "bob");
    EXPECT_EQ(asked.prefix, "/arm");
    ASSERT_EQ(asked.gives.size(), 1U) << "the other agent has nothing of it";
    EXPECT_EQ(asked.gives.front().agent, "robot");
    EXPECT_EQ(asked.gives.front().prefix, "/");
    const auto answers = first.leases.wait(first.leases.grant(asked));

    ASSERT_EQ(answers.size(), 1U);
    EXPECT_TRUE(answers.front().answer.done());
    EXPECT_EQ(second.newsUntil("control of / of agent robot is yours now").size(), 1U);
    EXPECT_TRUE(comesTrue([&] { return second.leases.asking().prefix.empty(); }));
    EXPECT_TRUE(second.leases.covers("robot", "/arm"));
    EXPECT_TRUE(comesTrue([&] { return first.leases.asked().empty(); }));
    ASSERT_EQ(first.leases.held().size(), 1U);
    EXPECT_EQ(first.leases.held().front().agent, "station");
    EXPECT_TRUE(second.leases.news().empty());
}

TEST_F(Asking, AreRefusedInWordsAndMayBeAskedAnew) {
    Tool first{"first", "alice"}, second{"second", "bob"};
    ASSERT_TRUE(first.takes("/arm", {"robot"}));
    ASSERT_TRUE(second.sees("alice"));
    ASSERT_TRUE(second.seesHolder("/"));
    second.leases.ask("/");
    ASSERT_TRUE(first.isAsked());
    first.leases.refuse(first.leases.asked().front());
    EXPECT_TRUE(first.leases.asked().empty());

    second.newsUntil("control of / was refused to you by alice (" + first.mirror.name() + ")");

    EXPECT_TRUE(second.leases.asking().prefix.empty());
    EXPECT_EQ(first.leases.held().size(), 1U);
    second.leases.ask("/");
    EXPECT_TRUE(first.isAsked()) << "it is another one";
}

// As a verb of a shell does, which views what it prints.
TEST_F(Asking, GoOnWhileTheAskerLooksElsewhere) {
    Tool first{"first", "alice"}, second{"second", "bob"};
    ASSERT_TRUE(first.takes("/", {"robot"}));
    ASSERT_TRUE(second.sees("alice"));
    ASSERT_TRUE(second.seesHolder("/arm"));
    second.leases.ask("/arm");
    ASSERT_TRUE(first.isAsked());
    for (const char* path : {"/stick", "/arm", "/nowhere", "/stick"}) {
        second.mirror.view({path}, 100);
        for (int i = 0; i < 20; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds{10});
            const auto news = second.leases.news();
            ASSERT_TRUE(news.empty()) << path << ": " << news.front();
            ASSERT_EQ(second.leases.asking().holders.size(), 1U) << path;
        }
        ASSERT_TRUE(first.isAsked()) << path;
    }
    second.mirror.view({"/robot", "/station"}, 100);
    const auto asked = first.leases.asked();
    ASSERT_EQ(asked.size(), 1U);
    first.leases.wait(first.leases.grant(asked.front()));
    second.newsUntil("control of / of agent robot is yours now");
}

// However stubbornly they ask on, and although only eight refusals are told.
TEST_F(Asking, AreRefusedOnceEachHoweverManyAsk) {
    Tool holder{"first", "alice"};
    ASSERT_TRUE(holder.takes("/arm", {"robot"}));
    std::vector<std::unique_ptr<Mirror>> crowd;
    for (int i = 0; i < 10; ++i) {
        crowd.push_back(std::make_unique<Mirror>("stubborn", loopback()));
        crowd.back()->introduce("mob");
        crowd.back()->tellAsks({1, "/arm"}, {});
    }
    std::set<std::string> refused;
    EXPECT_TRUE(comesTrue([&] {
        for (const auto& each : holder.leases.asked()) {
            EXPECT_TRUE(refused.insert(each.tool).second) << "it was refused before";
            holder.leases.refuse(each);
        }
        return refused.size() == crowd.size();
    }));
    EXPECT_TRUE(holder.leases.asked().empty());
}

TEST_F(Asking, AreOnlyOfPathsAndOfOneWhoSaysWhoHeIs) {
    Tool tool{"first", "alice"}, verb{"verb", ""};
    for (const char* each : {"", "arm", "//", "/arm/", "/a b"}) {
        EXPECT_THROW(tool.leases.ask(each), Error) << each;
    }
    EXPECT_THROW(tool.leases.ask("/" + std::string(127, 'a')), Error);
    EXPECT_THROW(verb.leases.ask("/arm"), Error);
    EXPECT_TRUE(tool.leases.asking().prefix.empty());
}

TEST_F(Asking, AreGoneAtTheHolderWhenTheyAreWithdrawnOrTheirToolEnds) {
    Tool first{"first", "alice"};
    ASSERT_TRUE(first.takes("/arm", {"robot"}));
    {
        Tool second{"second", "bob"};
        ASSERT_TRUE(second.seesHolder("/arm"));
        second.leases.ask("/arm");
        ASSERT_TRUE(first.isAsked());
        second.leases.withdraw();
        EXPECT_TRUE(comesTrue([&] { return first.leases.asked().empty(); }));
        EXPECT_TRUE(second.leases.asking().prefix.empty());
        second.leases.ask("/arm");
        ASSERT_TRUE(first.isAsked());
    }
    EXPECT_TRUE(comesTrue([&] { return first.leases.asked().empty(); }));
}

TEST_F(Asking, EndWhenNobodyHoldsAPartAnyLonger) {
    Tool first{"first", "alice"}, second{"second", "bob"};
    ASSERT_TRUE(first.takes("/arm", {"robot"}));
    ASSERT_TRUE(second.seesHolder("/arm"));
    second.leases.ask("/arm");
    ASSERT_TRUE(first.isAsked());
    first.leases.release("/arm");
    second.newsUntil("nobody else holds a part of /arm now, so it can be taken");
    EXPECT_TRUE(second.takes("/arm", {"robot"}));
}

TEST_F(Asking, OfOneThatDoesNotSayWhoUsesItHaveNobodyToAnswerThem) {
    Tool verb{"verb", ""}, second{"second", "bob"};
    ASSERT_TRUE(verb.takes("/arm", {"robot"}));
    ASSERT_TRUE(second.seesHolder("/arm"));
    EXPECT_TRUE(second.leases.holdersOf("/arm").front().person.empty());
    EXPECT_TRUE(second.leases.holdersOf("/stick").empty());
    second.leases.ask("/arm");
    second.newsUntil("nobody can be asked for control of /arm: " + verb.mirror.name() +
                     " does not say who uses it");
}

// Its agent still takes it for ours. Control is one explicit act, and so is to have it again.
TEST_F(Asking, ControlThatWasLostDoesNotComeBackByItself) {
    Tool tool{"first", "alice"};
    std::atomic<int> looks = 0;
    ASSERT_TRUE(tool.takes("/arm", {"robot"}));
    tool.leases.acceptOffers([&] { ++looks; });
    robot.stop();
    tool.newsUntil(
        "control of /arm of agent robot was lost: the agent has confirmed no renewal for 2 s");
    const int then = looks;
    EXPECT_TRUE(comesTrue([&] {
        stepRobot();
        return looks > then + 1;
    }));
    EXPECT_TRUE(tool.leases.held().empty());
    EXPECT_TRUE(tool.leases.news().empty());
    for (int cycle = 0; cycle < 10; ++cycle) stepRobot();
    EXPECT_TRUE(isDone(tool, tool.leases.take("/arm", {"robot"})));
    EXPECT_EQ(tool.leases.held().size(), 1U) << "taken again";
    EXPECT_TRUE(isDone(tool, tool.leases.release("/arm")));
}

}  // namespace
}  // namespace cortex::comms
