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

TEST(CommandSentence, IsTakenApart) {
    const struct {
        const char* text;
        Parts parts;
    } table[] = {
        {"operator@desk: jog(speed=0.5): Done in 2 cycles",
         {"operator@desk", "jog", "speed=0.5", "Done", "2 cycles", true}},
        {"bridge@desk for Ada: stop(): Done in 1 cycle",
         {"bridge@desk for Ada", "stop", "", "Done", "1 cycle", true}},
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
