// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/tables.hpp"

#include "cortex/core/error.hpp"

#include "support/small_structure.hpp"

#include <cstdint>
#include <cstring>
#include <string>

#include <gtest/gtest.h>

namespace cortex {
namespace {

class TablesTest : public ::testing::Test {
protected:
    const ItemLayout& layout(std::uint32_t simplex, std::string_view item) const {
        return *plant.structure->simplexes[simplex].layout->find(item);
    }
    Value read(const Slice& slice, std::uint32_t simplex, std::string_view item) const {
        const ItemLayout& found = layout(simplex, item);
        return loadValue(*found.item, slice.at(found.item->kind, found.offset));
    }
    double& position(const Slice& slice) const {
        return *static_cast<double*>(slice.at(Kind::Float, layout(plant.axis, "position").offset));
    }
    StringCell& label(const Slice& slice) const {
        return *static_cast<StringCell*>(
            slice.at(Kind::String, layout(plant.axis, "label").offset));
    }

    test::Plant plant = test::makePlant();
    Tables tables{plant.structure};
};

TEST_F(TablesTest, StartWithTheDefaultsOfTheTypes) {
    const Slice shared = tables.live(plant.shared);

    EXPECT_EQ(toText(read(shared, plant.shared, "position")), "0.5");
    EXPECT_EQ(toText(read(shared, plant.shared, "torques")), "1 2 3");
    EXPECT_EQ(toText(read(shared, plant.shared, "mode")), "7");
    EXPECT_EQ(toText(read(shared, plant.shared, "on")), "true");
    EXPECT_EQ(read(shared, plant.shared, "label"), Value{std::vector<std::string>{"axis"}});
    EXPECT_EQ(read(shared, plant.shared, "names"), (Value{std::vector<std::string>{"a", "b"}}));
    EXPECT_EQ(*shared.state, SlotState{});
}

TEST_F(TablesTest, StartWithWhatTheTreeSetsOverTheDefault) {
    EXPECT_EQ(position(tables.live(plant.axis)), 1.25);
    EXPECT_EQ(position(tables.live(plant.remote)), 0.5);
}

TEST_F(TablesTest, KeepConstantsApart) {
    const Slice constants = tables.constants(plant.axis);

    EXPECT_EQ(toText(read(constants, plant.axis, "origin")), "4 5 6");
    EXPECT_EQ(toText(read(tables.constants(plant.shared), plant.shared, "origin")), "0.1 0.2 0.3");
    EXPECT_EQ(read(constants, plant.axis, "serial"), Value{std::vector<std::string>{"S1"}});
    EXPECT_EQ(constants.state, nullptr);
    EXPECT_GE(tables.constantArena().size(), 6 * sizeof(double));
}

TEST_F(TablesTest, BeginWithARemoteSimplexLostByItself) {
    EXPECT_EQ(tables.live(plant.remote).state->quality, Quality::Lost);
    EXPECT_EQ(tables.live(plant.remote).state->cause, plant.remote);
    EXPECT_EQ(tables.edge(plant.remoteRead).state, tables.live(plant.remote).state);
}

TEST_F(TablesTest, LayEachKindInOneAlignedBlock) {
    const Slice first = tables.live(0);
    const auto aligned = [](const void* block) {
        return reinterpret_cast<std::uintptr_t>(block) % 64 == 0;
    };

    EXPECT_TRUE(aligned(first.floats) && aligned(first.ints) && aligned(first.strings) &&
                aligned(first.bools) && aligned(first.state));
    EXPECT_EQ(static_cast<const void*>(first.floats),
              static_cast<const void*>(tables.arena().data()));
    EXPECT_EQ(tables.live(plant.first).floats, first.floats + 4);  // behind the axis' own four
    EXPECT_EQ(tables.live(plant.first).state, first.state + 1);
    const std::byte* end = tables.arena().data() + tables.arena().size();
    const auto count = static_cast<std::ptrdiff_t>(plant.structure->simplexes.size());
    EXPECT_LE(reinterpret_cast<std::byte*>(first.state + count), end);
}

TEST_F(TablesTest, FindASliceInACopyOfTheArena) {
    std::vector<std::byte> copy(tables.arena().size());
    std::memcpy(copy.data(), tables.arena().data(), copy.size());
    position(tables.live(plant.axis)) = 9;

    EXPECT_EQ(position(tables.sliceIn(copy.data(), plant.axis)), 1.25);
}

TEST_F(TablesTest, LatchADelayedOutputForEveryReader) {
    position(tables.edge(plant.axisWritten)) = 2;
    tables.edge(plant.axisWritten).state->cycle = 3;
    label(tables.edge(plant.axisWritten)).assign("moved");

    EXPECT_EQ(position(tables.live(plant.axis)), 2);
    EXPECT_EQ(position(tables.edge(plant.latched)), 1.25);

    tables.latch();
    EXPECT_EQ(position(tables.edge(plant.latched)), 2);
    EXPECT_EQ(tables.edge(plant.latched).state->cycle, 3);
    EXPECT_EQ(label(tables.edge(plant.latched)).view(), "moved");
}

TEST_F(TablesTest, GiveUpALatchThatNobodyAskedForAndSayWhenToAsk) {
    const Slice kept = tables.edge(plant.latched);
    const std::size_t before = tables.copies();
    tables.giveUpUnusedLatches();
    EXPECT_EQ(tables.copies(), before - 1) << "nobody reads the active simplex delayed";
    position(tables.live(plant.axis)) = 2;
    tables.latch();

    EXPECT_EQ(position(kept), 2);
    EXPECT_EQ(tables.edge(plant.latched).state, kept.state);
    try {
        tables.edge(plant.activeDelayed);
        ADD_FAILURE() << "it was latched no longer";
    } catch (const Error& error) {
        EXPECT_NE(std::string{error.what()}.find("in populate(), not later"), std::string::npos)
            << error.what();
    }
}

TEST_F(TablesTest, LatchOnlyForWhoReadsDelayed) {
    EXPECT_EQ(tables.edge(plant.activeLive).state, tables.live(plant.first).state);
    EXPECT_NE(tables.edge(plant.activeDelayed).state, tables.live(plant.first).state);
    EXPECT_EQ(tables.edge(plant.live).state, tables.live(plant.shared).state);
}

TEST_F(TablesTest, GiveEachOfSeveralWritersACandidate) {
    position(tables.edge(plant.firstShared)) = 1;
    position(tables.edge(plant.secondShared)) = 2;

    EXPECT_EQ(position(tables.live(plant.shared)), 0.5);
    EXPECT_EQ(position(tables.edge(plant.firstShared)), 1);
    EXPECT_EQ(tables.edgeSource(plant.firstShared).floats, tables.edge(plant.firstShared).floats);

    copySlice(plant.structure->simplexes[plant.shared].layout->cyclic,
              tables.edge(plant.secondShared), tables.live(plant.shared));
    EXPECT_EQ(position(tables.live(plant.shared)), 2);
}

TEST_F(TablesTest, HoldACopyThatIsFilledFromLiveOrLatch) {
    EXPECT_EQ(tables.edgeSource(plant.held).floats, tables.live(plant.shared).floats);
    EXPECT_EQ(tables.edgeSource(plant.heldDelayed).floats, tables.edge(plant.latched).floats);
    EXPECT_EQ(position(tables.edge(plant.heldDelayed)), 1.25);

    position(tables.live(plant.shared)) = 3;
    tables.latch();
    EXPECT_EQ(position(tables.edge(plant.held)), 0.5);
}

TEST_F(TablesTest, SetTheCapacityOfEveryStringCell) {
    const auto edges = static_cast<std::uint32_t>(plant.structure->edges.size());
    for (std::uint32_t edge = 0; edge < edges; ++edge) {
        const Edge& each = plant.structure->edges[edge];
        if (plant.structure->simplexes[each.target].role == Role::Active) continue;
        EXPECT_EQ(label(tables.edge(edge)).capacity, 8) << edge;
        EXPECT_EQ(label(tables.edge(edge)).view(), "axis") << edge;
    }
}

TEST(StoreValue, RepeatsTheLastElementOfAShorterValue) {
    DataItem item = test::item("gains", std::vector{1.0, 2.0});
    item.length = 4;
    std::array<double, 4> cells{};

    storeValue(item, item.initial, cells.data());

    EXPECT_EQ(toText(loadValue(item, cells.data())), "1 2 2 2");
}

TEST(StoreValue, TakesAnEmptyValueAsZero) {
    const DataItem item = test::item("count", std::vector<std::int64_t>{});
    std::array<std::int64_t, 1> cells{5};

    storeValue(item, item.initial, cells.data());

    EXPECT_EQ(cells.front(), 0);
}

TEST(QualityName, IsTheWordThatPeopleRead) {
    EXPECT_STREQ(name(Quality::Good), "good");
    EXPECT_STREQ(name(Quality::Lost), "lost");
}

}  // namespace
}  // namespace cortex
