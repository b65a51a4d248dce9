// SPDX-License-Identifier: Apache-2.0
// Who of some simplexes starts before whom.
#include "model/start_order.hpp"

#include "gui/made_agent.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;
using Places = std::vector<std::size_t>;

StartOrder orderIn(std::vector<AgentFrame> agents, const std::vector<SimplexOf>& all) {
    StartOrder order = startOrder(*frameOf(std::move(agents)), all);
    for (Places& each : order) std::ranges::sort(each);
    return order;
}

// /first writes /signal, which /second reads; /third reads /second itself.
MadeAgent chain() {
    return {"chain", [](SimplexTree& tree) {
                Simplex& first = tree.add("/first", "Probe");
                Simplex& second = tree.add("/second", "Probe");
                Simplex& third = tree.add("/third", "Probe");
                Simplex& signal = tree.add("/signal", "Signal");
                tree.relate(first, "out", signal);
                tree.relate(second, "in", signal);
                tree.relate(third, "before", second);
            }};
}

TEST(StartOrder, WhoReadsFromAnotherReliesOnItAlsoThroughWhatHasNoState) {
    MadeAgent agent = chain();
    EXPECT_EQ(
        orderIn({agent.now()}, {{"chain", "/third"}, {"chain", "/first"}, {"chain", "/second"}}),
        (StartOrder{{2}, {}, {1}}));
}

TEST(StartOrder, ReliesAlsoThroughOneThatIsNotStartedUnlessThatIsActive) {
    MadeAgent agent = chain();
    const std::vector<SimplexOf> ends{{"chain", "/third"}, {"chain", "/first"}};
    EXPECT_EQ(orderIn({agent.now()}, ends), (StartOrder{{1}, {}}));
    agent.put("/second", "state", std::int64_t{2});
    EXPECT_EQ(orderIn({agent.now()}, ends), (StartOrder{{}, {}}));
}

TEST(StartOrder, WhatIsReadATickLateIsNotReliedOn) {
    MadeAgent agent{"agent", [](SimplexTree& tree) {
                        Simplex& one = tree.add("/one", "Probe");
                        Simplex& other = tree.add("/other", "Probe");
                        tree.relate(one, "before", other);
                        tree.relate(other, "before", one, true);
                        // What a device observes, of which the output is delayed.
                        Simplex& drive = tree.add("/drive", "Drive");
                        Simplex& seen = tree.add("/seen", "Observation");
                        Simplex& wanted = tree.add("/wanted", "Demand");
                        tree.relate(drive, "observation", seen, true);
                        tree.relate(drive, "demand", wanted);
                        tree.relate(one, "observed", seen);
                        tree.relate(one, "demand", wanted);
                    }};
    EXPECT_EQ(orderIn({agent.now()}, {{"agent", "/drive"}, {"agent", "/one"}, {"agent", "/other"}}),
              (StartOrder{{1}, {2}, {}}))
        << "the drive follows its demand";
}

TEST(StartOrder, ReliesAlsoOnASimplexOfAnotherAgent) {
    MadeAgent far = chain();
    MadeAgent near{"near", [](SimplexTree& tree) {
                       tree.relateRemote(tree.add("/reader", "Probe"), "in", "/signal");
                       tree.relateRemote(tree.add("/last", "Probe"), "before", "/third", "Probe");
                   }};
    EXPECT_EQ(
        orderIn({near.now(), far.now()},
                {{"near", "/reader"}, {"near", "/last"}, {"chain", "/first"}, {"chain", "/third"}}),
        (StartOrder{{2}, {3}, {}, {2}}));
}

TEST(StartOrder, OfAgentsThatRelyOnEachOtherInACircleNoneWaits) {
    const auto reads = [](const char* own, const char* other) {
        return [own, other](SimplexTree& tree) {
            Simplex& reader = tree.add(own, "Probe");
            tree.relateRemote(reader, "before", other, "Probe");
            tree.relate(tree.add(std::string{own} + "/after", "Probe"), "before", reader);
        };
    };
    MadeAgent left{"left", reads("/one", "/other")}, right{"right", reads("/other", "/one")};
    EXPECT_EQ(orderIn({left.now(), right.now()},
                      {{"left", "/one"}, {"right", "/other"}, {"right", "/other/after"}}),
              (StartOrder{{}, {}, {1}}));
}

TEST(StartOrder, OfSeveralAgentsWithOnePathTheOneThatIsMeantIsFound) {
    MadeAgent agent = chain();
    MadeAgent rival{"rival", [](SimplexTree& tree) { tree.add("/second", "Probe"); }};
    EXPECT_EQ(
        orderIn({agent.now(), rival.now()},
                {{"rival", "/second"}, {"chain", "/first"}, {"chain", "/second"}, {"gone", "/x"}}),
        (StartOrder{{}, {}, {1}, {}}));
}

TEST(StartOrder, OneMayStartOnceAllThatItReliesOnAreActive) {
    using enum StartStep;
    const StartOrder order{{}, {0}, {0, 1}, {}};
    EXPECT_EQ(mayStart(order, {Waits, Waits, Waits, Waits}), (Places{0, 3}));
    EXPECT_EQ(mayStart(order, {Asked, Waits, Waits, Failed}), Places{});
    EXPECT_EQ(mayStart(order, {Active, Waits, Waits, Asked}), Places{1});
    EXPECT_EQ(mayStart(order, {Active, Left, Waits, Active}), Places{2}) << "not of what others do";
    EXPECT_EQ(mayStart(order, {Active, Failed, Waits, Active}), Places{}) << "it never will";
}

}  // namespace
}  // namespace cortex::test
