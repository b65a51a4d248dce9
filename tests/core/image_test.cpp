// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/image.hpp"

#include "cortex/core/data.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/image_pool.hpp"

#include "support/small_structure.hpp"

#include <atomic>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

class ImageTest : public ::testing::Test {
protected:
    double& position() {
        const ItemLayout* item = plant.structure->simplexes[plant.axis].layout->find("position");
        return *static_cast<double*>(tables.live(plant.axis).at(Kind::Float, item->offset));
    }

    test::Plant plant = test::makePlant();
    Tables tables{plant.structure};
    ImagePool pool{tables, 2};
};

template <class Action>
std::string errorOf(Action action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST_F(ImageTest, ShowsTheInitialTablesBeforeTheFirstCycle) {
    const Image image = pool.newest();

    ASSERT_TRUE(image);
    EXPECT_EQ(image.cycle(), 0);
    EXPECT_EQ(image.get<double>("/axis", "position"), 1.25);
}

// Texts are copied only after one has changed, into each slot of its own.
TEST_F(ImageTest, ShowsEachTextAsItStandsInWhateverSlotItComesFrom) {
    const ItemLayout* item = plant.structure->simplexes[plant.axis].layout->find("label");
    auto* label = static_cast<StringCell*>(tables.live(plant.axis).at(Kind::String, item->offset));
    std::int64_t cycle = 0;
    for (const std::string text : {"one", "one", "two", "", "three"}) {
        label->assign(text);
        for (int times = 0; times < 3; ++times) {
            pool.publish(++cycle, 0, 0);
            EXPECT_EQ(pool.newest().get<std::string_view>("/axis", "label"), text) << cycle;
        }
    }
}

TEST_F(ImageTest, ShowsATextThatWasCopiedOrStoredAsAWhole) {
    const TypeLayout& layout = *plant.structure->simplexes[plant.axis].layout;
    const ItemLayout* item = layout.find("label");
    const Slice live = tables.live(plant.axis);
    pool.publish(1, 0, 0);
    pool.publish(2, 0, 0);

    storeValue(*item->item, std::vector<std::string>{""}, live.at(Kind::String, item->offset));
    pool.publish(3, 0, 0);
    EXPECT_EQ(pool.newest().get<std::string_view>("/axis", "label"), "");

    copySlice(layout.cyclic, tables.live(plant.shared), live);
    pool.publish(4, 0, 0);
    EXPECT_EQ(pool.newest().get<std::string_view>("/axis", "label"), "axis");
}

TEST_F(ImageTest, ReadsEveryKindByPathAndItem) {
    const Image image = pool.newest();

    EXPECT_EQ(image.get<std::int64_t>("/axis", "mode"), 7);
    EXPECT_EQ(image.get<bool>("/axis", "on"), true);
    EXPECT_EQ(image.get<std::string_view>("/axis", "label"), "axis");
    EXPECT_EQ(toText(image.value("/axis", "torques")), "1 2 3");
    EXPECT_EQ(toText(image.value("/axis", "origin")), "4 5 6");
    EXPECT_EQ(image.get<std::string_view>("/axis", "serial"), "S1");
    EXPECT_EQ(image.quality("/other/axis"), Quality::Lost);
    EXPECT_EQ(image.state(plant.remote).cause, plant.remote);
    EXPECT_EQ(&image.structure(), plant.structure.get());
}

TEST_F(ImageTest, KeepsWhatItShowsWhileTheLoopGoesOn) {
    position() = 2;
    pool.publish(1, 1'000'000, 5'000'000'000);
    const Image old = pool.newest();
    for (int cycle = 2; cycle < 50; ++cycle) {
        position() = cycle * 2.0;
        pool.publish(cycle, cycle * 1'000'000, 0);
    }

    EXPECT_EQ(old.cycle(), 1);
    EXPECT_EQ(old.nominalTime(), 1'000'000);
    EXPECT_EQ(old.wallClock(), 5'000'000'000);
    EXPECT_EQ(old.get<double>("/axis", "position"), 2);
    EXPECT_EQ(pool.newest().get<double>("/axis", "position"), 98);
    EXPECT_EQ(pool.newestCycle(), 49);
}

TEST_F(ImageTest, IsEmptyWhenAllReadersHoldOneAndComesBack) {
    Image first = pool.newest();
    {
        const Image second = pool.newest();
        EXPECT_TRUE(second);
        EXPECT_FALSE(pool.newest());
        pool.publish(1, 0, 0);
        pool.publish(2, 0, 0);
    }
    const Image third = pool.newest();
    EXPECT_TRUE(third);
    EXPECT_EQ(third.cycle(), 2);
    EXPECT_EQ(first.cycle(), 0);
}

TEST_F(ImageTest, AFollowerGetsEveryCycle) {
    pool.follow(3);
    for (int cycle = 1; cycle < 20; ++cycle) {
        position() = cycle;
        pool.publish(cycle, 0, 0);
        if (cycle % 3 != 0) continue;
        for (int each = cycle - 2; each <= cycle; ++each) {
            const Image image = pool.next();
            ASSERT_TRUE(image) << each;
            EXPECT_EQ(image.cycle(), each);
            EXPECT_EQ(image.get<double>("/axis", "position"), each);
        }
        EXPECT_FALSE(pool.next());
    }
    EXPECT_EQ(pool.lost(), 0U);
}

TEST_F(ImageTest, AFollowerThatIsSlowLosesCyclesAndHoldsUpNobody) {
    pool.follow(4);  // a ring of four
    const Image first = pool.newest();
    for (int cycle = 1; cycle <= 100; ++cycle) pool.publish(cycle, 0, 0);
    EXPECT_EQ(pool.lost(), 96U);
    EXPECT_EQ(pool.newest().cycle(), 100);
    for (int cycle = 1; cycle <= 4; ++cycle) EXPECT_EQ(pool.next().cycle(), cycle);
    pool.publish(101, 0, 0);
    EXPECT_EQ(pool.next().cycle(), 101) << "it goes on";
    EXPECT_EQ(first.cycle(), 0);
}

TEST_F(ImageTest, HasOneFollowerThatComesBeforeTheReaders) {
    {
        const Image held = pool.newest();
        EXPECT_EQ(errorOf([&] { pool.follow(); }),
                  "an image is held: follow before the first is read");
    }
    pool.follow();
    EXPECT_EQ(errorOf([&] { pool.follow(); }), "these images have a follower already");
}

TEST_F(ImageTest, ReleasesItsPinWhenItIsReplaced) {
    Image image = pool.newest();
    Image other = pool.newest();
    for (int cycle = 1; cycle < 9; ++cycle) {
        pool.publish(cycle, 0, 0);
        image = Image{};
        image = pool.newest();
        ASSERT_TRUE(image);
        EXPECT_EQ(image.cycle(), cycle);
    }
    Image& same = image;
    image = std::move(same);
    EXPECT_TRUE(image);
    Image moved{std::move(image)};
    other = std::move(moved);
    EXPECT_EQ(other.cycle(), 8);
    EXPECT_TRUE(pool.newest());
}

TEST_F(ImageTest, NamesTheNearestPathsAndItemsForAWrongOne) {
    const Image image = pool.newest();

    EXPECT_EQ(errorOf([&] { image.quality("/axes"); }),
              "agent robot has no simplex /axes; nearest of: /axis");
    EXPECT_EQ(errorOf([&] { image.get<double>("/axis", "positon"); }),
              "/axis: type Axis has no item 'positon'; nearest of: position");
    EXPECT_EQ(errorOf([&] { image.value("/first", "unlike"); }),
              "/first: type Driver has no item 'unlike'; there is: gain");
}

TEST_F(ImageTest, RefusesAnotherKindAndAnArrayAsAScalar) {
    const Image image = pool.newest();

    EXPECT_EQ(errorOf([&] { image.get<bool>("/axis", "mode"); }),
              "/axis: item 'mode' is int, not one bool");
    EXPECT_EQ(errorOf([&] { image.get<double>("/axis", "torques"); }),
              "/axis: item 'torques' is float array of 3, not one float");
}

TEST_F(ImageTest, SaysThatItIsEmptyInsteadOfBeingRead) {
    EXPECT_EQ(errorOf([] { (void)Image{}.cycle(); }), "this image is empty: check it before use");
}

// Every image is of one cycle, and no reader sees time run backwards. A follower sees each cycle or
// counts it as lost.
class ImageReaders : public ::testing::TestWithParam<int> {};

TEST_P(ImageReaders, SeeWholeCyclesInOrder) {
    const auto readers = static_cast<std::uint32_t>(GetParam());
    constexpr std::int64_t cycles = 3000;
    const test::Plant plant = test::makePlant();
    Tables tables{plant.structure};
    ImagePool pool{tables, readers};
    pool.follow(4);
    const auto fill = [&](std::int64_t cycle) {
        for (std::uint32_t i = 0; i < plant.structure->cyclic.floats; ++i) {
            tables.live(0).floats[i] = static_cast<double>(cycle);
        }
        tables.live(0).state->cycle = cycle;
        pool.publish(cycle, cycle * 1000, 0);
    };
    std::atomic<int> torn{0}, empty{0};
    std::atomic<std::int64_t> looks{0};
    const auto read = [&] {
        for (std::int64_t last = 0; last < cycles; ++looks) {
            const Image image = pool.newest();
            if (!image) {
                ++empty;
                continue;
            }
            const auto shown = static_cast<std::int64_t>(image.get<double>("/axis", "position"));
            const bool whole = shown == image.cycle() && image.nominalTime() == shown * 1000 &&
                               image.get<double>("/second", "gain") == static_cast<double>(shown) &&
                               image.state(0).cycle == shown;
            if (!whole || shown < last) ++torn;
            last = shown;
        }
    };

    std::int64_t followed = 0;
    const auto follow = [&] {
        for (std::int64_t last = -1;
             last < cycles && followed + static_cast<std::int64_t>(pool.lost()) <= cycles;) {
            const Image image = pool.next();
            if (!image) continue;
            if (image.cycle() <= last || image.state(0).cycle != image.cycle()) ++torn;
            last = image.cycle();
            ++followed;
        }
    };

    fill(0);
    std::vector<std::thread> threads;
    threads.emplace_back(follow);
    for (std::uint32_t i = 0; i < readers; ++i) threads.emplace_back(read);
    for (std::int64_t cycle = 1; cycle <= cycles; ++cycle) fill(cycle);
    for (std::thread& thread : threads) thread.join();

    EXPECT_EQ(torn, 0);
    EXPECT_EQ(empty, 0);
    EXPECT_GE(looks, readers);
    while (pool.next()) ++followed;
    EXPECT_EQ(followed + static_cast<std::int64_t>(pool.lost()), cycles + 1);
}

INSTANTIATE_TEST_SUITE_P(Image, ImageReaders, ::testing::Values(1, 2, 4));

}  // namespace
}  // namespace cortex
