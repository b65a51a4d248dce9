// SPDX-License-Identifier: Apache-2.0
// From text to text: what a system file says, agents hold, links carry and tools print, save and
// restore is one and the same, bit by bit.
#include "texts/plant.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;

// By kind: how many values have gone all ways.
using Counts = std::array<std::size_t, 4>;

// All ways that values take from a file on. `now` is what the first agent has at each moment.
struct AllWays {
    AllWays(Chance& random, std::size_t types, std::size_t simplexes, Counts& counts)
        : chance{random}, plant{chance, types, simplexes}, now{plant.model.start()} {
        for (const auto& [path, items] : now) {
            for (const auto& [item, value] : items) counts[value.index()] += lengthOf(value);
        }
    }
    void run() {
        start();
        if (!testing::Test::HasFailure()) change();
        if (!testing::Test::HasFailure()) restore();
        if (!testing::Test::HasFailure()) startAgain();
    }

    void start() {
        ASSERT_EQ(plant.seen(now), "") << plant.output();
        ASSERT_EQ(plant.copied(now), "") << plant.output();
        ASSERT_EQ(plant.shown(now), "");
        ASSERT_EQ(plant.shown(plant.model.copies(now)), "");
        ASSERT_EQ(plant.saved("first-saved.xml", first), "");
        EXPECT_EQ(plant.restored("first-saved.xml")["same"], countOf(first));
        plant.refusesToSet();
        ASSERT_EQ(plant.echoed(chance), "");
        ASSERT_EQ(plant.seen(now), "");
    }
    void change() {
        ASSERT_EQ(plant.set(chance, second), "");
        replaceBy(now, second);
        ASSERT_EQ(plant.seen(now), "");
        ASSERT_EQ(plant.copied(now), "");
        ASSERT_EQ(plant.shown(second), "");
        ASSERT_EQ(plant.saved("second-saved.xml", second), "");
    }
    void restore() {
        const json restored = plant.restored("first-saved.xml");
        EXPECT_EQ(restored["differences"].size(), otherThan(first, second));
        for (const json& each : restored["differences"]) {
            const std::string path = each["path"], item = each["item"];
            const DataItem& known = plant.model.item(path, item);
            EXPECT_EQ(difference(second.at(path).at(item), *valueOf(known, each["now"])), "");
            EXPECT_EQ(difference(first.at(path).at(item), *valueOf(known, each["file"])), "");
        }
        replaceBy(now, first);
        ASSERT_EQ(plant.seen(now), "");
    }
    // What is retained goes on as it is; of the rest the file of settings counts.
    void startAgain() {
        plant.startAgain("second-saved.xml");
        for (const auto& [path, items] : second) {
            for (const auto& [item, value] : items) {
                if (!plant.model.item(path, item).retain) now[path][item] = value;
            }
        }
        ASSERT_EQ(plant.seen(now), "") << plant.output();
    }

    Chance& chance;
    Plant plant;
    AllValues now;
    const AllValues second = plant.model.settable(chance);
    const AllValues first = someOf(now, second);
};

std::uint64_t seedOf(bool fixed) {
    const char* given = std::getenv("CORTEX_SEED");
    if (given != nullptr) return std::strtoull(given, nullptr, 10);
    return fixed ? 1 : std::random_device{}();
}

TEST(TextToText, IsTheSameForAFewValues) {
    const std::uint64_t seed = seedOf(true);
    std::cout << "CORTEX_SEED=" << seed << std::endl;
    Chance chance{seed};
    Counts counts{};
    AllWays{chance, 2, 3, counts}.run();
    for (const std::size_t each : counts) EXPECT_GT(each, 100U);
}

// CORTEX_TEXTS: how many of each kind. With a number of one's own the seed is another each time.
TEST(TextToText, IsTheSameForTenThousandValuesOfEachKind) {
    const char* given = std::getenv("CORTEX_TEXTS");
    const std::uint64_t seed = seedOf(given == nullptr);
    const std::size_t wanted = given == nullptr ? 10'000 : std::strtoull(given, nullptr, 10);
    std::cout << "CORTEX_TEXTS=" << wanted << " CORTEX_SEED=" << seed << std::endl;
    Chance chance{seed};
    Counts counts{};
    while (*std::ranges::min_element(counts) < wanted && !HasFailure()) {
        AllWays{chance, 6, 12, counts}.run();
    }
    std::cout << counts[0] << " ints, " << counts[1] << " floats, " << counts[2] << " bools, "
              << counts[3] << " texts" << std::endl;
}

// The attributes of <set> for item `x` of these kinds, which no value can be.
// /sink has copies of what /source has, and 500 is out of its range.
TEST(TextToText, WhatNobodyCanSetIsNamedAndTheRestIsRestoredOnDemand) {
    const ModelFolder folder;
    folder.copyOntology();
    writeTypes(folder,
               "<type name='Source' extends='Carrier'><data name='a' kind='float' default='500'/>"
               "</type><type name='Sink' extends='Carrier'><data name='aCopy' kind='float' min='0' "
               "max='100' settable='always'/><data name='gain' kind='float' default='3' "
               "settable='always'/></type>");
    const auto system = folder.write("odd.xml",
                                     "<system name='odd'><morphology file='rules.xml'/>"
                                     "<cluster name='odd' frequency='50'/>"
                                     "<simplex path='/source' type='Source'/>"
                                     "<simplex path='/sink' type='Sink'>"
                                     "<relate rule='source' to='/source'/></simplex></system>");
    AgentProcess agent{folder, system, withCarrier};
    agent.start();
    const std::string file = (folder.path() / "saved.xml").string();
    const json saved = lookUntil(
        [&] {
            return json::parse(live({"save", file, "--force", "--json"}).output, nullptr, false);
        },
        [](const json& seen) { return seen.contains("wrong") && !seen["wrong"].empty(); });
    ASSERT_TRUE(saved.contains("wrong")) << saved;
    EXPECT_EQ(saved["items"], 1);
    EXPECT_EQ(saved["wrong"][0]["item"], "aCopy");
    const Outcome told = live({"save", file, "--force"});
    EXPECT_EQ(told.exit, 3);
    EXPECT_TRUE(contains(told.errors, "/sink is not saved whole: aCopy: 500 is above 100"))
        << told.errors;
    ASSERT_EQ(live({"set", "/sink", "gain=4"}).exit, 0);
    EXPECT_EQ(live({"restore", file}).exit, 0) << textOf(file);
    EXPECT_EQ(liveJson({"show", "/sink"}, "show")["data"]["gain"]["value"], 3);

    folder.write("saved.xml",
                 "<system name='saved'><simplex path='/sink' type='Sink'>"
                 "<set data='aCopy' value='500'/><set data='gain' value='5'/></simplex></system>");
    EXPECT_EQ(live({"restore", file}).exit, 1);
    EXPECT_EQ(liveJson({"show", "/sink"}, "show")["data"]["gain"]["value"], 3);
    const Outcome rest = live({"restore", file, "--what-is-good"});
    EXPECT_EQ(rest.exit, 1);
    EXPECT_TRUE(contains(rest.output, "/sink.gain  3 -> 5")) << rest.output;
    EXPECT_EQ(liveJson({"show", "/sink"}, "show")["data"]["gain"]["value"], 5);
}

struct Refused {
    const char* data;        // attributes of the item
    std::string attributes;  // of <set>
    const char* words;
};

const std::vector<Refused>& refused() {
    static const std::vector<Refused> all{
        {"kind='float'", "value='nan'", "a finite number"},
        {"kind='float'", "value='-inf'", "a finite number"},
        {"kind='float'", "value='1e999'", "a finite number"},
        {"kind='float'", "value='1e-999'", "a finite number"},
        {"kind='float'", "value='0x1p3'", "a finite number"},
        {"kind='float'", "value='1,5'", "a finite number"},
        {"kind='float' length='2'", "value='1'", "found 1"},
        {"kind='int'", "value='9223372036854775808'", "64 bit"},
        {"kind='int'", "value='-9223372036854775809'", "64 bit"},
        {"kind='int'", "value='1e3'", "a whole number,"},
        {"kind='int' min='9007199254740993'", "value='9007199254740992'", "at least"},
        {"kind='float' max='0.1'", "value='0.10000000000000002'", "at most"},
        {"kind='bool'", "value='TRUE'", "true or false"},
        {"kind='string'", "value='a\\x00b' escaped='true'", "the octet 0"},
        {"kind='string' length='2'", "value='a \\x00b' escaped='true'", "the octet 0"},
        {"kind='string'", "value='a\\xffb' escaped='true'", "not UTF-8"},
        {"kind='string'", "value='\\xed\\xa0\\x80' escaped='true'", "not UTF-8"},
        {"kind='string'", "value='a\\x1' escaped='true'", "escaped"},
        {"kind='string'", "value='a\\n' escaped='true'", "escaped"},
        {"kind='string'", "value='a&#0;b'", "entity"},
        {"kind='string'", "value='a&#1;b'", "entity"},
        {"kind='string'", "value='&#xD800;'", "entity"},
        {"kind='string'", "value='&#x110000;'", "entity"},
        {"kind='string'", "value='a\xff'", "not UTF-8"},
        {"kind='string'", std::string{"value='a\0b'", 11}, "not UTF-8"},
        {"kind='string' capacity='3'", "value='ab\u00fc'", "takes 3 octets"},
        {"kind='string' length='2'", "value='a\"b c'", "double quote"},
        {"kind='int' labels='0:Off 1:0'", "value='0'", "a number, too"},
    };
    return all;
}

TEST(TextToText, WhatNoValueCanBeIsRefusedInWords) {
    const ModelFolder folder;
    folder.copyOntology();
    for (const Refused& each : refused()) {
        writeTypes(folder, "<type name='Has' extends='Carrier'><data name='x' " +
                               std::string{each.data} + "/></type>");
        const CheckedModel checked =
            check(folder.write("refused.xml",
                               "<system name='s'><morphology file='rules.xml'/>"
                               "<cluster name='s'/><simplex path='/x' type='Has'>"
                               "<set data='x' " +
                                   each.attributes + "/></simplex></system>"));
        EXPECT_FALSE(checked.report.ok()) << each.data << " " << each.attributes;
        EXPECT_TRUE(contains(checked.report.text(), each.words))
            << each.data << " " << each.attributes << ": " << checked.report.text();
    }
}

}  // namespace
}  // namespace cortex::test
