// SPDX-License-Identifier: Apache-2.0
// What agents say of commands is taken apart again by every tool: both ends of one sentence.
#include "cortex/core/command_sentence.hpp"

#include "core/router_fixture.hpp"

#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using test::Router;

// What the agent wrote last about /worker.
std::string newestOf(test::AgentRig& rig) {
    constexpr std::string_view path = "/worker: ";
    std::string text;
    for (const std::string& each : rig.events()) {
        if (each.starts_with(path)) text = each.substr(path.size());
    }
    return text;
}

struct Parts {
    std::string sender, command, arguments, outcome, latency;
    bool done;
    bool operator==(const Parts&) const = default;
};

Parts partsOf(std::string_view text) {
    const auto found = commandSentence(text);
    if (!found) return {"none", "", "", "", "", false};
    return {std::string{found->sender},  std::string{found->command}, std::string{found->arguments},
            std::string{found->outcome}, std::string{found->latency}, found->done};
}

void PrintTo(const Parts& parts, std::ostream* out) {
    *out << parts.sender << '|' << parts.command << '|' << parts.arguments << '|' << parts.outcome
         << '|' << parts.latency << '|' << parts.done;
}

TEST_F(Router, TellsACommandSoThatToolsKnowWhoSentItAndWhatBecameOfIt) {
    rig.make();
    const auto amount = worker.argument<double>("add", "amount");
    worker.on("add",
              [&](Call& call) { return call[amount] < 5 ? Outcome::Done : Outcome::Failed; });
    worker.on("poke",
              [](Call& call) { return call.reject(Reason::Range, "2): Done in 3 cycles, or so"); });
    rig.start();
    const auto told = [&](const std::string& command, ProgramInterface::Arguments arguments) {
        const std::uint64_t number = rig.outside.answers.size() + 1;
        answerTo({.path = "/worker",
                  .command = command,
                  .arguments = std::move(arguments),
                  .sequence = number,
                  .answeredBelow = number,
                  .host = "desk"});
        return newestOf(rig);
    };

    const std::string done = told("add", {{"amount", Value{std::vector{2.5}}}});
    EXPECT_EQ(partsOf(done),
              (Parts{"tool@desk", "add", "amount=2.5", "Done", "the same cycle", true}))
        << done;
    const std::string failed = told("add", {{"amount", Value{std::vector{-7e-7}}}});
    EXPECT_EQ(partsOf(failed).arguments, "amount=-7e-07") << failed;
    const std::string refused = told("poke", {});
    EXPECT_EQ(partsOf(refused).command, "poke") << refused;
    EXPECT_EQ(partsOf(refused).sender, "tool@desk") << refused;
    EXPECT_FALSE(partsOf(told("add", {{"amount", Value{std::vector{9.0}}}})).done);
}

TEST_F(Router, TellsTheHostOfASenderWhoseNameDoesNotSayIt) {
    start();
    const std::string cloud = "ip-10-0-0-1.eu-central-1.compute.internal";
    const struct {
        std::string name, host, told;
    } table[] = {
        {"operator", "desk", "operator@desk"},
        {"cortex@desk.4711-5e1f0a", "desk", "cortex@desk.4711-5e1f0a"},
        {"cortex@desk.lab.4711-5e1f0a", "desk.lab", "cortex@desk.lab.4711-5e1f0a"},
        {"cortex@desk.4711-5e1f0a", "hall", "cortex@desk.4711-5e1f0a@hall"},
        {"cortex@des.4711-5e1f0a", "desk", "cortex@des.4711-5e1f0a@desk"},
        {"a.b@desk", "desk", "a.b@desk@desk"},
        {"@.", "desk", "@.@desk"},
        {"cortex-explorer@" + cloud.substr(0, 35) + ".4711-5e1f0a", cloud,
         "cortex-explorer@" + cloud.substr(0, 35) + ".4711-5e1f0a"},
        {"cortex@desk.4711-5e1f0a", "", "cortex@desk.4711-5e1f0a"},
    };
    std::int64_t epoch = 0;
    for (const auto& each : table) {
        answerTo({.path = "/worker",
                  .command = "poke",
                  .sender = each.name,
                  .epoch = ++epoch,
                  .host = each.host});
        EXPECT_EQ(partsOf(newestOf(rig)).sender, each.told);
    }
}

TEST_F(Router, TellsWhoSentWhichCommandAndItsOutcomeHoweverLongTheRestIs) {
    rig.make();
    worker.on("mix", [](Call& call) { return call.reject(Reason::Range, std::string(90, 'y')); });
    rig.start();
    const std::string person = "a-person-of-thirty-one-bytes...";
    const ProgramInterface::Arguments items{{"gain", Value{std::vector{0.123456}}},
                                            {"weights", Value{std::vector{0.125, -0.375, 1e-05}}},
                                            {"title", Value{std::vector<std::string>{"abc"}}}};
    for (std::size_t size = 1; size < sizeof(Sender::name); ++size) {
        const std::string name(size, 'n');
        const auto told = [&](const std::string& command,
                              const ProgramInterface::Arguments& arguments) {
            answerTo({.path = "/worker",
                      .command = command,
                      .arguments = arguments,
                      .sender = name,
                      .sequence = command == "set" ? 1U : 2U,
                      .onBehalfOf = person});
            return newestOf(rig);
        };
        const std::string done = told("set", items);
        const std::string begin = name + " for " + person + ": set(gain=0.123456, ti";
        EXPECT_EQ(done.substr(0, begin.size()), begin);
        EXPECT_TRUE(partsOf(done).done) << done;
        const std::string whole = "gain=0.123456, title=\"abc\", weights=0.125 -0.375 1e-05";
        const std::string shown = partsOf(done).arguments;
        EXPECT_TRUE(shown == whole || shown.ends_with("…")) << done;

        const std::string refused = told("mix", {});
        EXPECT_EQ(partsOf(refused).sender, name + " for " + person);
        EXPECT_EQ(partsOf(refused).arguments.substr(0, 12), "mode=0, numb") << refused;
        EXPECT_TRUE(partsOf(refused).outcome.starts_with("Rejected (")) << refused;
    }
}

TEST(CommandSentence, IsTakenApart) {
    const struct {
        const char* text;
        Parts parts;
    } table[] = {
        {"operator@desk: jog(speed=0.5): Done in 2 cycles",
         {"operator@desk", "jog", "speed=0.5", "Done", "2 cycles", true}},
        {"bridge@desk for Ada: stop(): Done in 1 cycle",
         {"bridge@desk for Ada", "stop", "", "Done", "1 cycle", true}},
        {"cortex-explorer@vm.14105-2501a1 for alice@desk: takeControl(prefix=\"/\"): Done in 1 "
         "cycle",
         {"cortex-explorer@vm.14105-2501a1 for alice@desk", "takeControl", "prefix=\"/\"", "Done",
          "1 cycle", true}},
        {"cortex@vm.1-2@vm for cortex@vm.3-4: set(gain=0.5, weigh…): Done",
         {"cortex@vm.1-2@vm for cortex@vm.3-4", "set", "gain=0.5, weigh…", "Done", "", true}},
        {"a@b: moveTo(x=1 2 3, name=in 5 cycles): Failed, blocked in the gate in 12 cycles",
         {"a@b", "moveTo", "x=1 2 3, name=in 5 cycles", "Failed, blocked in the gate", "12 cycles",
          false}},
        {"a@b: set(name=x): y(): Rejected (range), too far in the same cycle",
         {"a@b", "set", "name=x): y(", "Rejected (range), too far", "the same cycle", false}},
        {"a@b: load(name=a text that is cut in its mid",
         {"a@b", "load", "name=a text that is cut in its mid", "", "", false}},
        {"a@b: load(name=x): Done", {"a@b", "load", "name=x", "Done", "", true}},
        {"a@b: load(name=x): Doneness", {"a@b", "load", "name=x", "Doneness", "", false}},
        {"position limited from 1 to 2 rad", {"none", "", "", "", "", false}},
        {"", {"none", "", "", "", "", false}},
        {": (", {"none", "", "", "", "", false}},
    };
    for (const auto& each : table) EXPECT_EQ(partsOf(each.text), each.parts) << each.text;
}

TEST(CommandSentence, OfAnyPieceOfATextIsNeverMoreThanThatPiece) {
    const std::string text =
        "a@b for c: set(name=x): y(): Rejected (range), in 2 cycles: z(): Done";
    for (std::size_t begin = 0; begin <= text.size(); ++begin) {
        for (std::size_t size = 0; begin + size <= text.size(); ++size) {
            const std::string piece = text.substr(begin, size);
            const auto found = commandSentence(piece);
            if (!found) continue;
            EXPECT_NE(piece.find(found->sender), std::string::npos);
            EXPECT_NE(piece.find(found->outcome), std::string::npos);
            EXPECT_FALSE(found->command.empty()) << piece;
        }
    }
}

}  // namespace
}  // namespace cortex
