// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_listeners.hpp"

#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

class MirrorListenersTest : public testing::Test {
protected:
    void tell(int number) {
        for (const auto& each : listeners.list()) each->tell(number);
    }
    Listening listen() {
        return listeners.add([this](int number) { told.push_back(number); });
    }

    std::vector<int> told;
    Listeners<int> listeners;
};

TEST_F(MirrorListenersTest, AreToldUntilTheyAreStopped) {
    listen();  // its handle is dropped
    Listening second = listen();
    tell(1);
    EXPECT_EQ(told, (std::vector{1, 1}));

    second.stop();
    tell(2);
    EXPECT_EQ(told, (std::vector{1, 1, 2}));
    second.stop();
    tell(3);
    EXPECT_EQ(told, (std::vector{1, 1, 2, 3}));
}

TEST_F(MirrorListenersTest, ThatAreStoppedAreNotToldWhatIsUnderWay) {
    Listening listening = listen();
    const auto underWay = listeners.list();

    listening.stop();
    for (const auto& each : underWay) each->tell(1);

    EXPECT_TRUE(told.empty());
}

TEST_F(MirrorListenersTest, ThatAreStoppedKeepNothingThatTheyCaptured) {
    auto captured = std::make_shared<int>(1);
    Listening listening = listeners.add([captured](int) {});
    EXPECT_EQ(captured.use_count(), 2);

    listening.stop();

    EXPECT_EQ(captured.use_count(), 1);
}

TEST_F(MirrorListenersTest, MayStopThemselves) {
    auto captured = std::make_shared<int>(0);
    Listening listening;
    listening = listeners.add([&listening, captured](int number) {
        listening.stop();
        *captured += number;
    });

    tell(1);
    tell(1);

    EXPECT_EQ(*captured, 1);
    EXPECT_EQ(captured.use_count(), 1);
}

TEST(Listening, MayBeStoppedWhenNobodyTellsAnyMore) {
    Listening of, ofNothing;
    {
        Listeners<int> listeners;
        of = listeners.add([](int) {});
    }
    of.stop();
    ofNothing.stop();
}

}  // namespace
}  // namespace cortex::comms
