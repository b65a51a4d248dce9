// SPDX-License-Identifier: Apache-2.0
// What `cortex` prints of devices: nothing that never came, nothing twice.
#include "cli/conform_plant.hpp"
#include "cli/controlled_agent.hpp"
#include "cli/live_agent.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

// The line of an item, with single blanks; "": there is none.
std::string lineOf(const std::string& text, const std::string& item) {
    for (std::string line : linesOf(text)) {
        const auto twice = std::ranges::unique(
            line, [](char one, char other) { return one == ' ' && other == ' '; });
        line.erase(twice.begin(), twice.end());
        if (line.starts_with(" " + item + " ")) return line;
    }
    return {};
}

std::size_t countOf(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

TEST(CortexShow, MarksNothingAsLostThatTheAgentKnowsOfALinkAndShowsNoAgeOfWhatNeverCame) {
    ConformPlant plant;
    plant.addBus("/bus", "8");
    plant.start();
    const auto shown = lookUntil([] { return live({"show", "/bus"}).output; },
                                 [](const std::string& text) { return contains(text, "data"); });

    EXPECT_TRUE(lineOf(shown, "link").starts_with(" link Closed ")) << shown;
    EXPECT_TRUE(lineOf(shown, "exchangeCount").starts_with(" exchangeCount 0 ")) << shown;
    for (const char* each : {"age", "exchangeTimeLast", "exchangeTimeP99", "exchangeTimeMax"}) {
        const std::string line = lineOf(shown, std::string{each} + " -");
        EXPECT_FALSE(line.empty()) << each << "\n" << shown;
    }
    const std::string observed = live({"show", "/bus/is"}).output;
    EXPECT_TRUE(contains(observed, "lost, never measured")) << observed;
    EXPECT_TRUE(lineOf(observed, "age").empty()) << observed;
    EXPECT_TRUE(lineOf(observed, "value").starts_with(" value - ")) << observed;
    const auto json = liveJson({"show", "/bus/is"}, "show");
    EXPECT_TRUE(json["age_ms"].is_null()) << json;
    EXPECT_TRUE(json["data"]["value"]["value"].is_null()) << json;
}

// The device of what is shown tells whether anything was measured; its link it tells itself.
TEST(CortexShow, TellsTheLastValueOfADeviceThatHadAnsweredAndWatchItsLinkAsGood) {
    ConformPlant plant;
    plant.addBus("/bus", "10");
    plant.start();
    ASSERT_TRUE(becomesTrue([&] { return plant.number("/bus", "age") > 0; }));

    const std::string observed = live({"show", "/bus/is"}).output;
    const auto shown = liveJson({"show", "/bus/is"}, "show");
    const Outcome watched =
        live({"watch", "/bus.link", "/bus.age", "/bus/is.value", "--json", "--count", "1"});
    const std::string text =
        live({"watch", "/bus.link", "/bus.exchangeCount", "--count", "1"}).output;

    EXPECT_TRUE(contains(observed, "lost")) << observed;
    EXPECT_FALSE(contains(observed, "never measured")) << observed;
    EXPECT_TRUE(lineOf(observed, "value").starts_with(" value [")) << observed;
    EXPECT_FALSE(shown["age_ms"].is_null()) << shown;
    EXPECT_FALSE(shown["data"]["value"]["value"].is_null()) << shown;
    const auto values = nlohmann::json::parse(watched.output)["values"];
    EXPECT_EQ(values["/bus.link"]["quality"], "good") << values;
    EXPECT_EQ(values["/bus.age"]["quality"], "good") << values;
    EXPECT_EQ(values["/bus/is.value"]["quality"], "lost") << values;
    EXPECT_TRUE(contains(text, "/bus.link  Closed\n")) << text;
    EXPECT_TRUE(contains(text, "/bus.exchangeCount  1\n")) << text;
}

TEST(CortexConform, SaysEachReasonToSkipOnceAndPartsItFromTheNameOfTheTest) {
    ConformPlant plant;
    for (const std::string number : {"1", "2"}) {
        plant.add("/drive/is" + number, "Ds402RotaryObservation");
        plant.add("/drive/set" + number, "Ds402RotaryModification");
        plant.add("/drive/wish" + number, "ShortAxis");
    }
    plant.add("/drive", "Ds402SimulatedDrive",
              {{"demands", "/drive/set1"},
               {"demands", "/drive/set2"},
               {"observations", "/drive/is1"},
               {"observations", "/drive/is2"}});
    plant.add("/drive/lead", "Ds402AxisProcessor",
              {{"drives", "/drive/is1"},
               {"drives", "/drive/is2"},
               {"demands", "/drive/wish1"},
               {"demands", "/drive/wish2"},
               {"setpoints", "/drive/set1"},
               {"setpoints", "/drive/set2"}});
    plant.start();

    const std::string text = live({"conform", "/drive", "--seconds", "1"}).output;

    EXPECT_EQ(countOf(text, "it moves the axis or gives it torque; --move AMPLITUDE"), 1U) << text;
    EXPECT_TRUE(
        contains(text, "words refused: Operation enabled, axis 1 as for 'transition 4, axis 1'"))
        << text;
}

}  // namespace
}  // namespace cortex::test
