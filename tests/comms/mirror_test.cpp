// SPDX-License-Identifier: Apache-2.0
#include "cortex/comms/mirror.hpp"

#include "cortex/core/error.hpp"

#include "comms/stepped_agent.hpp"
#include "wire/presence_interval.hpp"

#include <algorithm>
#include <atomic>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using namespace std::chrono_literals;

// The agent "robot" with two workers, one of them Active.
std::unique_ptr<SteppedAgent> robot() {
    auto agent = std::make_unique<SteppedAgent>("robot");
    test::Hand& arm = agent->rig.hand("/arm");
    agent->rig.hand("/hand");
    agent->rig.make();
    const auto sum = arm.result<double>("add", "sum");
    const auto amount = arm.argument<double>("add", "amount");
    arm.on("add", [=](Call& call) {
        call[sum] = call[amount] + 1;
        return Outcome::Done;
    });
    arm.on("poke", [](Call& call) { return call.fail("it hurts"); });
    return agent;
}

test::Hand& arm(SteppedAgent& agent) {
    return dynamic_cast<test::Hand&>(agent.rig.tree.at("/arm"));
}

AgentStatus statusOf(const Mirror& mirror, const std::string& name) {
    for (const AgentStatus& each : mirror.agents()) {
        if (each.name == name) return each;
    }
    return {};
}

TEST(Mirror, KnowsEveryAgentWithAllItHas) {
    const auto first = robot();
    first->run();
    SteppedAgent second{"station"};
    second.rig.hand("/stick");
    second.run();
    const Mirror mirror{"test", loopback()};

    // Agents that have just started need not know each other yet.
    ASSERT_TRUE(comesTrue(
        [&] { return mirror.waitUntilComplete(test::patience) && mirror.agents().size() == 2; }));

    ASSERT_EQ(mirror.agents().size(), 2U);
    const AgentStatus status = mirror.agents().front();
    EXPECT_EQ(status.name, "robot");
    EXPECT_EQ(status.state, "running");
    EXPECT_EQ(status.epoch, first->structure().epoch);
    EXPECT_EQ(status.simplexes, first->structure().simplexes.size());
    EXPECT_EQ(status.missing, 0U);
    EXPECT_EQ(status.loss, 0U);
    const auto structure = mirror.structure("robot");
    ASSERT_TRUE(structure);
    for (std::uint32_t i = 0; i < structure->simplexes.size(); ++i) {
        EXPECT_EQ(structure->simplexes[i].path, first->structure().simplexes[i].path);
    }
    EXPECT_EQ(mirror.ownerOf("/stick"), "station");
    EXPECT_EQ(mirror.ownerOf("/nothing"), std::nullopt);
    EXPECT_EQ(mirror.refused(), 0U);
}

// It says goodbye and stays: nothing more comes of it, as of one that stands still or was killed.
TEST(Mirror, KnowsWhoSaidOnceWhoItIsAndMissesWhoNeverDid) {
    const auto agent = robot();
    agent->run();
    Participant other{loopback(), "other"};
    const auto speaks = other.writer<Presence>(topics::presence);
    const Mirror mirror{"test", loopback()};
    ASSERT_TRUE(comesTrue([&] { return mirror.nameless() == 1; })) << "it has said nothing";
    EXPECT_FALSE(mirror.waitUntilComplete(1ms));

    Presence presence;
    presence.agent = agentId("other");
    presence.name = "other";
    presence.epoch = 1;
    presence.role = "tool";
    presence.state = "running";
    presence.interval = shortestInterval;
    ASSERT_TRUE(comesTrue([&] { return speaks->write(presence) && mirror.nameless() == 0; }));
    presence.state = "stopping";
    ASSERT_TRUE(speaks->write(presence));
    presence.role = "agent";  // of no name, so it is refused: what came before it was taken
    presence.state = "running";
    presence.name.clear();
    ASSERT_TRUE(comesTrue([&] { return speaks->write(presence) && mirror.refused() > 0; }));
    EXPECT_EQ(mirror.nameless(), 0U);
    EXPECT_TRUE(mirror.waitUntilComplete(test::patience));
}

TEST(Mirror, IsNotCompleteWhereNobodyIs) {
    const Mirror mirror{"test", loopback()};

    EXPECT_FALSE(mirror.waitUntilComplete(1ms));
    EXPECT_TRUE(mirror.agents().empty());
    EXPECT_FALSE(mirror.image("robot"));
}

TEST(Mirror, ShowsTheValuesThatAreViewed) {
    const auto agent = robot();
    agent->run();
    Mirror mirror{"test", loopback()};
    ASSERT_TRUE(mirror.waitUntilComplete(test::patience));
    EXPECT_FALSE(mirror.image("robot"));

    mirror.view({"/arm"}, 100);

    ASSERT_TRUE(comesTrue([&] { return static_cast<bool>(mirror.image("robot")); }));
    ASSERT_TRUE(mirror.waitForValues(test::patience));
    agent->change([&] { arm(*agent).data<std::string_view>("title") = "drill"; });
    EXPECT_TRUE(comesTrue(
        [&] { return mirror.image("robot")->get<std::string_view>("/arm", "title") == "drill"; }));
    AgentImage image = mirror.image("robot");
    EXPECT_TRUE(comesTrue([&] {  // stale where the loop or the network is late
        image = mirror.image("robot");
        return image->quality("/arm") == Quality::Good;
    }));
    EXPECT_EQ(image->quality("/hand"), Quality::Lost) << "nobody asked for it";
    EXPECT_GE(mirror.age("robot", image->structure().find("/arm")).value_or(-1), 0.0);
    EXPECT_FALSE(mirror.age("robot", image->structure().find("/hand")));
}

// The listener stands still while the agent goes on; then it is told what came meanwhile, too.
TEST(Mirror, ReportsEveryImageInOrderToWhoAskedForEveryCycle) {
    const auto agent = robot();
    agent->run();
    std::mutex mutex;
    std::vector<std::int64_t> cycles;  // outlives the mirror, whose thread writes it
    std::promise<void> goOn;
    const std::shared_future<void> mayGoOn = goOn.get_future().share();
    Mirror mirror{"test", loopback()};
    mirror.onImage([&](const std::string& name, const AgentImage& image) {
        if (name != "robot" || !image.came(image->structure().find("/arm"))) return;
        {
            const std::lock_guard lock{mutex};
            cycles.push_back(image->cycle());
        }
        mayGoOn.wait();
    });
    ASSERT_TRUE(mirror.waitUntilComplete(test::patience));
    mirror.view({"/arm"}, 0);
    const auto told = [&] {
        const std::lock_guard lock{mutex};
        return cycles;
    };
    const auto cycle = [&] { return agent->rig.agent->images().newest().cycle(); };
    EXPECT_TRUE(comesTrue([&] { return !told().empty(); }));
    const std::int64_t begin = cycle();
    EXPECT_TRUE(comesTrue([&] { return cycle() >= begin + 100; }));
    const std::int64_t end = cycle();
    goOn.set_value();
    ASSERT_TRUE(comesTrue([&] { return !told().empty() && told().back() > end; }));
    agent->stop();

    const std::vector<std::int64_t> all = told();
    EXPECT_TRUE(std::ranges::is_sorted(all));
    const auto meanwhile =
        std::ranges::count_if(all, [&](std::int64_t each) { return each > begin && each <= end; });
    EXPECT_GE(meanwhile, 10) << "of 100, some of which a busy agent may leave out";
}

TEST(Mirror, EndsAListeningWhenItIsToldToAndRefusesAnEmptyFunction) {
    const auto agent = robot();
    agent->run();
    std::atomic<int> images{0};
    Mirror mirror{"test", loopback()};
    Listening listening;
    {
        auto told = std::make_unique<std::atomic<int>>(0);  // ends before the mirror
        listening = mirror.onImage([&](const std::string&, const AgentImage&) { ++*told; });
        mirror.onImage([&](const std::string&, const AgentImage&) { ++images; });
        mirror.view({"/arm"}, 0);
        ASSERT_TRUE(comesTrue([&] { return *told > 0; }));
        listening.stop();
    }
    const int before = images;
    EXPECT_TRUE(comesTrue([&] { return images > before + 3; })) << "the other one goes on";

    EXPECT_THROW(mirror.onImage({}), std::invalid_argument);
    EXPECT_THROW(mirror.onEvent(nullptr), std::invalid_argument);
}

// Many cycles pass before the communication thread can run.
TEST(Mirror, GetsOrCountsEveryCycleWhereTheLoopIsFasterThanTheThreadThatSends) {
    const auto agent = robot();
    agent->rig.start();
    std::mutex mutex;
    std::vector<std::int64_t> cycles;
    Mirror mirror{"test", loopback()};
    mirror.onImage([&](const std::string&, const AgentImage& image) {
        const std::lock_guard lock{mutex};
        cycles.push_back(image->cycle());
    });
    const auto newest = [&] {
        const std::lock_guard lock{mutex};
        return cycles.empty() ? 0 : cycles.back();
    };
    mirror.view({"/arm"}, 0);
    ASSERT_TRUE(comesTrue([&] {
        agent->rig.step();
        return newest() > 0;
    }));
    for (int burst = 0; burst < 20; ++burst) {
        agent->rig.step(30);
        ASSERT_TRUE(comesTrue([&] { return newest() == agent->rig.tick.cycle; }));
    }

    const std::lock_guard lock{mutex};
    std::uint64_t missing = 0;
    for (std::size_t i = 1; i < cycles.size(); ++i) {
        if (cycles[i] > cycles[i - 1]) {
            missing += static_cast<std::uint64_t>(cycles[i] - cycles[i - 1] - 1);
        }
    }
    EXPECT_EQ(statusOf(mirror, "robot").loss, missing) << "each came or is counted";
    EXPECT_GT(cycles.size(), 300U) << "of 600: more than the newest of each burst";
}

TEST(Mirror, TellsTheAgesOfAllSimplexesOfAnAgentAtOnce) {
    const auto agent = robot();
    agent->run();
    Mirror mirror{"test", loopback()};
    ASSERT_TRUE(mirror.waitUntilComplete(test::patience));
    EXPECT_TRUE(mirror.ages("robot").empty()) << "nothing is viewed";
    mirror.view({"/arm"}, 100);
    ASSERT_TRUE(mirror.waitForValues(test::patience));

    const auto ages = mirror.ages("robot");

    const auto structure = mirror.structure("robot");
    ASSERT_EQ(ages.size(), structure->simplexes.size());
    EXPECT_GE(ages[structure->find("/arm")].value_or(-1), 0.0);
    EXPECT_FALSE(ages[structure->find("/hand")]) << "nobody asked for it";
    EXPECT_TRUE(mirror.ages("nobody").empty());
}

TEST(Mirror, CallsStaleWhatAnAgentThatHangsNoLongerSays) {
    const auto agent = robot();
    agent->run();
    Mirror mirror{"test", loopback()};
    mirror.view({"/"}, 30);
    ASSERT_TRUE(mirror.waitUntilComplete(test::patience));
    ASSERT_TRUE(mirror.waitForValues(test::patience));

    agent->change([&] {
        EXPECT_TRUE(
            comesTrue([&] { return mirror.image("robot")->quality("/arm") == Quality::Stale; }));
        EXPECT_EQ(statusOf(mirror, "robot").state, "running") << "it is still heard";
    });
    EXPECT_TRUE(comesTrue([&] { return mirror.image("robot")->quality("/arm") == Quality::Good; }));
}

TEST(Mirror, ShowsALoopThatStandsStillToAllWhoBeginToLook) {
    const auto agent = robot();
    agent->run();
    agent->change([&] {
        agent->rig.step();
        for (int i = 0; i < 3; ++i) {
            Mirror mirror{"test", loopback()};
            mirror.view({i == 2 ? "/hand" : "/arm"}, 30);
            ASSERT_TRUE(mirror.waitForOwner("/arm", test::patience));
            EXPECT_TRUE(mirror.waitForValues(test::patience)) << i;
        }
    });
}

TEST(Mirror, LooksForAPathUntilNobodyNewHasComeForAsLongAsItIsTold) {
    const auto first = robot();
    first->run();
    const Mirror mirror{"test", loopback()};
    ASSERT_TRUE(mirror.waitUntilComplete(test::patience));
    EXPECT_EQ(mirror.waitForOwner("/stick", test::patience), std::nullopt);
    EXPECT_FALSE(mirror.waitUntilComplete(0ms, 1h));

    auto found = std::async(std::launch::async,
                            [&] { return mirror.waitForOwner("/stick", test::patience, 1h); });
    SteppedAgent second{"station"};
    second.rig.hand("/stick");
    second.run();

    EXPECT_EQ(found.get(), "station");
}

TEST(Mirror, SpeaksLessOftenTheMoreListen) {
    Participant other{loopback(), "other"};
    Inbox<Presence> heard;
    std::vector<std::unique_ptr<Reader<Presence>>> listeners;
    for (int i = 0; i < 15; ++i) {
        listeners.push_back(other.reader<Presence>(topics::presence, heard.push()));
    }
    Mirror mirror{"test", loopback()};
    mirror.view({"/"}, 30);

    // The mirror listens too.
    EXPECT_TRUE(heard.waitUntil([](const std::vector<Presence>& all) {
        return std::ranges::any_of(
            all, [](const Presence& each) { return each.interval == 16 * 20'000'000; });
    }));
}

TEST(Mirror, SubscribesNothingThatIsNotAskedFor) {
    const auto agent = robot();
    agent->run();
    Participant other{loopback(), "other"};
    const auto presences = other.writer<Presence>(topics::presence);
    const auto blocks = other.writer<Block>(topics::view30);
    const auto events = other.writer<EventMessage>(topics::event);
    const auto answers = other.writer<Answer>(topics::answerTo("test"));
    Mirror mirror{"test", loopback()};
    ASSERT_TRUE(comesTrue([&] { return presences->readers() == 2; }));
    EXPECT_EQ(blocks->readers() + events->readers() + answers->readers(), 0U);

    mirror.view({"/arm"}, 30);
    EXPECT_TRUE(comesTrue([&] { return blocks->readers() == 1; }));
    mirror.view(std::vector<Viewed>{});
    EXPECT_TRUE(comesTrue([&] { return blocks->readers() == 0; }));
    mirror.onEvent([](const AgentEvent&) {});
    EXPECT_TRUE(comesTrue([&] { return events->readers() == 1; }));
    EXPECT_EQ(answers->readers(), 0U);
}

TEST(Mirror, CallsCommandsAndSaysWhatCameOfThem) {
    const auto agent = robot();
    agent->run();
    Mirror mirror{"test", loopback()};
    ASSERT_TRUE(mirror.waitUntilComplete(test::patience));

    CommandAnswer answer =
        mirror.call("/arm", "add", {{"amount", Value{std::vector{2.0}}}}, test::patience);
    EXPECT_EQ(answer.outcome, Outcome::Done) << answer.text();
    EXPECT_EQ(answer.response.at("sum"), Value(std::vector{3.0}));
    answer = mirror.call("/arm", "add", {{"amount", Value{std::vector{200.0}}}}, test::patience);
    EXPECT_EQ(answer.outcome, Outcome::Rejected);
    EXPECT_EQ(answer.reason, Reason::Range) << answer.text();
    answer = mirror.call("/arm", "poke", {}, test::patience);
    EXPECT_EQ(answer.outcome, Outcome::Failed);
    EXPECT_EQ(answer.why, "it hurts");
    answer = mirror.call("/arm", "set", {{"gain", Value{std::vector{4.0}}}}, test::patience);
    EXPECT_EQ(answer.outcome, Outcome::Done) << answer.text();
    agent->change([&] { EXPECT_EQ(double{arm(*agent).data<double>("gain")}, 4.0); });
    EXPECT_TRUE(agent->rig.hasEvent(mirror.name())) << "the agent says who commanded";
}

// What takes time are endpoints that find each other. Here they all have, before the command.
TEST(Mirror, PreparesCommandsWithEachAgentBeforeTheFirstOne) {
    const auto agent = robot();
    agent->run();
    Participant other{loopback(), "other"};
    std::vector<std::unique_ptr<Reader<Answer>>> readers;
    for (const char digit : std::string{"0123456789abcdef"}) {
        readers.push_back(other.reader<Answer>(
            {"cortex/1/answer/" + std::string{digit}, Qos::Exchange}, [](Answer&&) {}));
    }
    const auto writers = [&] {
        std::uint32_t count = 0;
        for (const auto& each : readers) count += each->writers();
        return count;
    };
    const auto commands = other.reader<Command>(topics::command, [](Command&&) {});
    Mirror looks{"test", loopback()};
    looks.view({"/"}, 30);
    ASSERT_TRUE(looks.waitUntilComplete(test::patience));
    ASSERT_TRUE(looks.waitForValues(test::patience));
    EXPECT_EQ(writers(), 0U) << "one that only looks costs no answers";
    Mirror mirror{"test", loopback()};

    mirror.prepareCommands();

    EXPECT_TRUE(comesTrue([&] { return writers() == 1 && commands->writers() == 1; }));
    ASSERT_TRUE(mirror.waitUntilComplete(test::patience));
    EXPECT_EQ(mirror.call("/arm", "poke", {}, test::patience).outcome, Outcome::Failed);
    EXPECT_EQ(writers(), 1U);
}

TEST(Mirror, NamesTheNearestPathOfAnUnknownOne) {
    const auto agent = robot();
    agent->run();
    Mirror mirror{"test", loopback()};
    ASSERT_TRUE(mirror.waitUntilComplete(test::patience));

    try {
        mirror.call("/amr", "poke");
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_NE(std::string{error.what()}.find("/arm"), std::string::npos) << error.what();
    }
}

TEST(Mirror, TellsEventsThatWereBeforeItCameToo) {
    const auto agent = robot();
    agent->run();
    test::Hand& worker = arm(*agent);
    const auto note = [&](const char* text) {
        agent->change([&] {
            agent->rig.agent->post(agent->rig.agent->thread(0), Severity::Warning,
                                   EventKind::Message, worker.index(), text);
        });
    };
    note("before");
    Inbox<AgentEvent> events;
    Mirror mirror{"test", loopback()};
    mirror.onEvent(events.push());
    const auto has = [](const char* text) {
        return [text](const std::vector<AgentEvent>& all) {
            return std::ranges::any_of(all, [&](const auto& each) { return each.text == text; });
        };
    };

    ASSERT_TRUE(events.waitUntil(has("before")));
    note("after");
    ASSERT_TRUE(events.waitUntil(has("after")));

    const auto all = events.elements();
    const AgentEvent& last = all.back();
    EXPECT_EQ(last.agent, "robot");
    EXPECT_EQ(last.path, "/arm");
    EXPECT_EQ(last.severity, Severity::Warning);
    EXPECT_GT(last.number, all.front().number);
}

TEST(Mirror, LosesAnAgentThatEndsAndTakesItsNextStart) {
    auto agent = robot();
    agent->run();
    Mirror mirror{"test", loopback()};
    mirror.view({"/"}, 100);
    ASSERT_TRUE(mirror.waitUntilComplete(test::patience));
    ASSERT_TRUE(mirror.waitForValues(test::patience));
    const auto before = mirror.structure("robot");
    const AgentImage kept = mirror.image("robot");

    agent.reset();
    ASSERT_TRUE(comesTrue([&] { return statusOf(mirror, "robot").state == "lost"; }));
    EXPECT_EQ(mirror.image("robot")->quality("/arm"), Quality::Lost);
    EXPECT_EQ(mirror.call("/arm", "poke").outcome, Outcome::Expired);

    agent = robot();
    agent->run();
    ASSERT_TRUE(comesTrue([&] {
        const AgentImage image = mirror.image("robot");
        return image && &image->structure() != before.get() &&
               image->quality("/arm") == Quality::Good;
    }));
    EXPECT_GT(mirror.structure("robot")->epoch, before->epoch);
    EXPECT_EQ(kept->get<double>("/arm", "gain"), 1.0);
    EXPECT_EQ(mirror.call("/arm", "poke", {}, test::patience).outcome, Outcome::Failed);
}

TEST(Mirror, LosesAnAgentThatFallsSilentWithoutAWord) {
    Participant other{loopback(), "mute"};
    const auto presences = other.writer<Presence>(topics::presence);
    Presence presence;
    presence.name = "mute";
    presence.agent = idOf({"mute"});
    presence.epoch = 1;
    presence.role = "agent";
    presence.state = "running";
    presence.majors = {1};
    presences->write(presence);
    const Mirror mirror{"test", loopback()};

    ASSERT_TRUE(comesTrue([&] { return statusOf(mirror, "mute").state == "running"; }));
    EXPECT_TRUE(comesTrue([&] { return statusOf(mirror, "mute").state == "lost"; }));
    EXPECT_FALSE(mirror.structure("mute"));
}

TEST(Mirror, SurvivesWhatNoAgentWouldSay) {
    const auto agent = robot();
    agent->run();
    Mirror mirror{"test", loopback()};
    mirror.view({"/"}, 30);
    mirror.onEvent([](const AgentEvent&) {});
    ASSERT_TRUE(mirror.waitUntilComplete(test::patience));
    ASSERT_TRUE(mirror.waitForValues(test::patience));
    Participant other{loopback(), "liar"};
    const auto models = other.writer<Model>(topics::model);
    const auto blocks = other.writer<Block>(topics::view30);
    const auto events = other.writer<EventMessage>(topics::event);
    ASSERT_TRUE(comesTrue([&] {
        return models->readers() == 1 && blocks->readers() == 1 && events->readers() == 1;
    }));
    const std::uint64_t refused = mirror.refused();
    Model model;
    model.agent = "robot";
    model.epoch = agent->structure().epoch;
    models->write(model);
    EventMessage event;
    event.name = "robot";
    events->write(event);
    Block block;
    block.agent = idOf({"robot"});
    block.epoch = agent->structure().epoch;
    EXPECT_TRUE(comesTrue([&] {
        blocks->write(block);
        return mirror.refused() >= refused + 3;
    }));
    EXPECT_EQ(statusOf(mirror, "robot").state, "running");
    EXPECT_TRUE(mirror.refusals().empty()) << "its gate let all of them in, and it did not believe";
}

TEST(Mirror, HasANameOfItsOwnForEveryInstance) {
    const Mirror first{"test", loopback()};
    const Mirror second{"test", loopback()};

    EXPECT_NE(first.name(), second.name());
    EXPECT_EQ(first.name().find("test@"), 0U) << first.name();
    const std::string process = "." + std::to_string(getpid()) + "-";
    EXPECT_NE(first.name().find(process), std::string::npos) << "a random part follows";
    EXPECT_LT(first.name().size(), 64U);
    EXPECT_LT((Mirror{std::string(200, 'x'), loopback()}.name().size()), 64U);
}

}  // namespace
}  // namespace cortex::comms
