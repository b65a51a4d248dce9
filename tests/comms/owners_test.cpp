// SPDX-License-Identifier: Apache-2.0
// Who owns a path: each rule alone, and each against those that it outranks.
#include "peers/owners.hpp"

#include "wire/presence_extras.hpp"

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

constexpr std::int64_t second = 1'000'000'000;

Claimant claimant(const std::string& agent, std::int64_t began, std::int64_t heard = 100 * second,
                  const char* says = "") {
    return {agent, Rank::Equal, {heard, began, pairsFrom(says)}};
}

// For a listener that began at 95 s.
std::string ownerOf(const std::vector<Claimant>& claimants, std::int64_t listens = 95 * second) {
    const auto owner = ownerAmong(claimants, [&](const Claimant& one, const Claimant& other) {
        return wasFirst(one, other, listens);
    });
    return owner ? claimants[*owner].agent : "";
}

TEST(Owners, OfTwoTheOneThatRunsLongerOwnsThePath) {
    EXPECT_EQ(ownerOf({claimant("a", 50 * second), claimant("b", 49 * second)}), "b");
    EXPECT_EQ(ownerOf({claimant("b", 49 * second), claimant("a", 50 * second)}), "b");
}

TEST(Owners, OfTwoThatBeganNearlyAtOnceTheSmallerNameOwnsThePath) {
    EXPECT_EQ(ownerOf({claimant("b", 50 * second), claimant("a", 50 * second + second / 2)}), "a");
}

TEST(Owners, OwnEarsOutrankWhatTheySayOfTheirUptime) {
    const Claimant early = claimant("b", 90 * second, 100 * second);
    const Claimant late = claimant("a", 0, 121 * second);
    EXPECT_EQ(ownerOf({early, late}, 99 * second), "b");
    EXPECT_EQ(ownerOf({early, late}, 102 * second), "a") << "not for long enough";
}

TEST(Owners, AWordAgainstOneselfOutranksEars) {
    const Claimant early = claimant("b", 90 * second, 100 * second, "a>b");
    const Claimant late = claimant("a", 0, 121 * second);
    EXPECT_EQ(ownerOf({early, late}, 99 * second), "a");
    EXPECT_EQ(ownerOf({claimant("b", 1, 1, "b>a"), claimant("a", 2 * second, 1)}), "b")
        << "a word for oneself counts for nothing";
}

TEST(Owners, WhereBothYieldTheWordOfTheSmallerNameCounts) {
    EXPECT_EQ(ownerOf({claimant("a", 1, 1, "b>a"), claimant("b", 2, 1, "a>b")}), "b");
}

TEST(Owners, AHigherRankWinsHoweverLateItComes) {
    for (const Rank rank : {Rank::Equal, Rank::Owns, Rank::Named}) {
        Claimant late = claimant("z", 99 * second), early = claimant("a", 0);
        late.rank = rank;
        early.rank = static_cast<Rank>(static_cast<int>(rank) - 1);
        EXPECT_EQ(ownerOf({early, late}), "z");
    }
}

TEST(Owners, NobodyOwnsAPathWithoutARight) {
    Claimant only = claimant("a", 0);
    only.rank = Rank::None;
    EXPECT_EQ(ownerOf({only}), "");
    EXPECT_EQ(ownerText("/arm", std::vector{only}, 0),
              "agent a has /arm; commands go to nobody, as its signed list owns other paths");
    Claimant other = claimant("b", 9 * second);
    other.rank = Rank::Least;
    EXPECT_EQ(ownerOf({only, other}), "b");
}

TEST(Owners, WhoIsLostOwnsNothingThatAnotherHas) {
    Claimant first = claimant("a", 0);
    first.lost = true;
    EXPECT_EQ(ownerOf({first, claimant("b", 9 * second)}), "b");
    EXPECT_EQ(ownerOf({first}), "a") << "its last values are shown";
}

TEST(Owners, OfThreeTheOneBeforeWhichNobodyWasOwnsThePathAndInACircleTheSmallestName) {
    EXPECT_EQ(ownerOf({claimant("a", 9 * second), claimant("b", 5 * second), claimant("c", 0)}),
              "c");
    EXPECT_EQ(ownerOf({claimant("c", 0, 100 * second, "b>c"), claimant("b", 0, 100 * second, "a>b"),
                       claimant("a", 0, 100 * second, "c>a")}),
              "a");
}

TEST(Owners, TheSentenceSaysWhy) {
    const std::string start = "agents one, two both have /arm; commands go to one, ";
    const auto text = [](Claimant one, Claimant two) {
        return ownerText("/arm", std::vector{std::move(one), std::move(two)}, 95 * second);
    };
    const Claimant one = claimant("one", 0), two = claimant("two", 90 * second);
    EXPECT_EQ(text(claimant("one", 0, 1, "one>two"), two), start + "which was there first");
    EXPECT_EQ(text(one, two), start + "which runs longer");
    EXPECT_EQ(text(one, claimant("two", 0)), start + "whose name comes first");
    EXPECT_EQ(text(claimant("one", 0, 1, "one>two"), claimant("two", 90 * second, 1, "two>one")),
              start + "which runs longer; two says that it was first: stop one of them");
    Claimant owns = two, reads = one;
    owns.agent = "one";
    owns.rank = Rank::Owns;
    reads.agent = "two";
    EXPECT_EQ(text(owns, reads), start + "which has the right to it (--owns)");
    owns.rank = Rank::Named;
    EXPECT_EQ(text(owns, reads), start + "which has that name");
    owns.rank = Rank::Equal;
    reads.rank = Rank::Least;
    EXPECT_EQ(text(owns, reads), start + "as two may only look");
}

TEST(Owners, TheRightToAPathFollowsFromNameAndSignedList) {
    AgentRights rights;
    EXPECT_EQ(rankOf("arm", "/arm/axis", true, nullptr), Rank::Named);
    EXPECT_EQ(rankOf("arm", "/army", false, nullptr), Rank::Equal);
    EXPECT_EQ(rankOf("robot", "/arm", true, nullptr), Rank::Least);
    EXPECT_EQ(rankOf("robot", "/arm", true, &rights), Rank::Equal);
    rights.mayCommand.clear();
    EXPECT_EQ(rankOf("robot", "/arm", true, &rights), Rank::Least);
    rights.owns = {"/arm", "/belt"};
    EXPECT_EQ(rankOf("robot", "/arm/axis", true, &rights), Rank::Owns);
    EXPECT_EQ(rankOf("robot", "/armchair", true, &rights), Rank::None);
    rights.owns = {"/"};
    EXPECT_EQ(rankOf("robot", "/belt", true, &rights), Rank::Owns);
}

TEST(Owners, PairsAreReadAsTheyAreSaidAndWhatIsMalformedIsLeftOut) {
    const AgentPairs pairs{{"one", "two"}, {"three", "one"}};
    EXPECT_EQ(textOf(pairs), "one>two three>one");
    EXPECT_EQ(pairsFrom(textOf(pairs)), pairs);
    EXPECT_EQ(pairsFrom(" >a a> a>> > one  x>y "), (AgentPairs{{"a", ">"}, {"x", "y"}}));
    EXPECT_EQ(pairsFrom("a>b b>c c>d d>e e>f f>g g>h h>i i>j").size(), 8U);
    EXPECT_TRUE(pairsFrom(std::string(2'000, 'a') + ">b").empty());
}

TEST(Owners, RootsTellWhoMayHaveAPath) {
    EXPECT_TRUE(mayHave("/one /arm", "/arm/axis"));
    EXPECT_FALSE(mayHave("/one /arm", "/belt"));
    EXPECT_TRUE(mayHave("*", "/belt"));
    EXPECT_TRUE(mayHave("", "/belt")) << "another version does not say";
    EXPECT_TRUE(mayShare("/two /arm/axis", "/one /arm"));
    EXPECT_FALSE(mayShare("/two /army", "/one /arm"));
}

TEST(Owners, TheEarliestPossibleStartCountsHoweverLateAPresenceComes) {
    Presence presence;
    presence.extras = {{uptimeOfAgent, std::to_string(10 * second)}};
    Seniority seniority;
    EXPECT_TRUE(seniority.take(presence, 100 * second));
    EXPECT_EQ(seniority.began, 90 * second);
    EXPECT_FALSE(seniority.take(presence, 103 * second)) << "it was on its way for longer";
    EXPECT_EQ(seniority.began, 90 * second);
    EXPECT_EQ(seniority.heard, 100 * second);
    presence.extras.push_back({firstOfPairs, "one>two"});
    EXPECT_TRUE(seniority.take(presence, 104 * second));
    EXPECT_TRUE(seniority.saysFirst("one", "two"));
}

}  // namespace
}  // namespace cortex::comms
