// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"
#include "cortex/cs/testing.hpp"
#include "cortex/toolkit/classes.hpp"

#include <string>

#include <gtest/gtest.h>

// A type that extends a ready-made one needs no class of its own.
namespace cortex::toolkit::test {
namespace {

struct Hall : cs::TestPlant {
    Hall()
        : TestPlant{{CORTEX_SOURCE_DIR "/ontology/cortex-morphology.xml",
                     CORTEX_SOURCE_DIR "/tests/data/inherited-classes.xml"}} {
        addClasses(classes());
        add("/crane", "RotaryAxisObservation");
        add("/demand", "RotaryAxisConcept");
    }
};

TEST(AReadyMadeClass, RunsForATypeThatExtendsItsOwn) {
    std::string told;  // longer than the plant that tells it
    Hall hall;
    hall.add("/control", "CraneController", {{"axes", "/crane"}, {"demands", "/demand"}});
    hall.cluster().addEventSink(
        [&](const Event& event, const Structure&) { told += event.text.view(); });
    hall.start();
    hall.tree().at("/crane").data<double>("position") = 0.5;

    hall.startUp();
    hall.step();

    EXPECT_EQ(hall.state("/control"), State::Active);
    EXPECT_EQ(hall.get<double>("/demand", "position"), 0.5);
    EXPECT_EQ(hall.get<std::int64_t>("/control", "cranes"), 3);
    hall.cluster().agent().events().flush();
    EXPECT_NE(
        told.find("CraneController has no class of its own and runs that of HoldAxisController"),
        std::string::npos)
        << "somebody may have forgotten a plug-in";
}

TEST(AReadyMadeClass, IsNotTakenByChanceWhereATypeExtendsTwo) {
    Hall hall;
    hall.add("/control", "HoldAndFollow",
             {{"axes", "/crane"}, {"targets", "/crane"}, {"demands", "/demand"}});

    std::string refusal;
    try {
        hall.start();
    } catch (const Error& error) {
        refusal = error.what();
    }

    EXPECT_NE(refusal.find("/control: no C++ class implements the active type HoldAndFollow, and "
                           "it extends FollowAxisController and HoldAxisController, which have "
                           "one each"),
              std::string::npos)
        << refusal;
}

}  // namespace
}  // namespace cortex::toolkit::test
