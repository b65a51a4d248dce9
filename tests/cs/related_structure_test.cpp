// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"

#include "support/probe.hpp"

#include <string>

#include <gtest/gtest.h>

// What populate() learns of the structure around a related simplex.
namespace cortex::test {
namespace {

struct PlainDrive : cs::SimplexCS {
    using SimplexCS::SimplexCS;
};

struct RelatedStructure : testing::Test {
    RelatedStructure()
        : probe{cluster.probe("/probe")}, drive{cluster.tree.add<PlainDrive>("/drive", "Drive")} {
        cluster.tree.relate(drive, "demand", cluster.tree.add("/demand", "Demand"));
        cluster.tree.relate(drive, "observation", cluster.tree.add("/seen", "Observation"), true);
    }
    // "/demand (Demand) " for each, as populate() of the probe sees it; or why there is none.
    std::string joined(const std::string& rule) {
        std::string text;
        probe.onPopulate = [&](Probe& self) {
            try {
                for (const auto& each : self.input("before").related(rule))
                    text += each.path + " (" + each.type->name + ") ";
            } catch (const Error& error) {
                text = error.what();
            }
        };
        cluster.start();
        return text;
    }

    ProbeCluster cluster;
    Probe& probe;
    PlainDrive& drive;
};

TEST_F(RelatedStructure, NamesWhatIsJoinedUnderARuleAndUnderThoseThatRefineIt) {
    cluster.tree.relate(probe, "before", drive);

    EXPECT_EQ(joined("demands"), "/demand (Demand) ");
}

TEST_F(RelatedStructure, TakesRulesOfBothDirections) {
    cluster.tree.relate(probe, "before", drive);

    EXPECT_EQ(joined("observation"), "/seen (Observation) ");
}

TEST_F(RelatedStructure, NamesTheRuleThatTheTypeHasNot) {
    cluster.tree.relate(probe, "before", drive);

    const std::string why = joined("demnads");

    EXPECT_NE(why.find("/drive: type Drive has no rule 'demnads'"), std::string::npos) << why;
    EXPECT_NE(why.find("demands"), std::string::npos) << why;
}

TEST_F(RelatedStructure, IsNotKnownOfASimplexOfAnotherAgent) {
    cluster.tree.relateRemote(probe, "before", "/far", "Drive");

    EXPECT_EQ(joined("demands"), "");
}

}  // namespace
}  // namespace cortex::test
