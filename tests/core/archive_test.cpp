// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/archive.hpp"

#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {

namespace {

enum class Phase : std::uint8_t { Idle, Runs };

struct Profile {
    double position = 0;
    bool moves = false;

    void keep(Archive& archive) { archive & position & moves; }
    bool operator==(const Profile&) const = default;
};

// Something of each kind that can be kept.
struct Everything {
    double number = 0;
    std::int64_t count = 0;
    Phase phase = Phase::Idle;
    std::array<float, 3> array{};
    std::vector<Profile> profiles{2};
    std::array<std::byte, 5> raw{};

    void keep(Archive& archive) {
        archive.version("Everything", 1);
        archive & number & count & phase & array & profiles & raw;
    }
    bool operator==(const Everything&) const = default;
};

Everything full() {
    return {1.5, -7, Phase::Runs, {1, 2, 3}, {{0.1, true}, {0.2, false}}, {std::byte{9}}};
}

template <class T>
std::vector<std::byte> saved(T& object) {
    Archive measured;
    object.keep(measured);
    std::vector<std::byte> bytes(measured.size());
    Archive archive{bytes};
    object.keep(archive);
    EXPECT_FALSE(archive.problem());
    return bytes;
}

// What the check says; "" where it fits.
template <class T>
std::string problemOf(T& object, std::span<const std::byte> bytes) {
    Archive archive{bytes, Archive::Purpose::Check};
    object.keep(archive);
    archive.finish();
    return archive.problem() ? std::string{archive.problem()->view()} : "";
}

TEST(Archive, GivesBackEveryKindOfValueThatItTook) {
    Everything before = full();
    const std::vector<std::byte> bytes = saved(before);
    Everything after;

    EXPECT_EQ(problemOf(after, bytes), "");
    EXPECT_EQ(after, Everything{});
    Archive archive{bytes, Archive::Purpose::Restore};
    after.keep(archive);

    EXPECT_EQ(after, full());
}

TEST(Archive, KeepsHowLongAgoATimeWas) {
    struct Times {
        std::int64_t last = 0, next = 0;
        void keep(Archive& archive) { archive.time(last).time(next); }
    };
    Times before{700, 1'300}, after{1, 2};
    std::vector<std::byte> bytes(saved(before).size());
    Archive archive{bytes, 1'000};
    before.keep(archive);
    ASSERT_EQ(problemOf(after, bytes), "");
    EXPECT_EQ(after.last, 1) << "a check changes nothing";

    Archive restored{bytes, Archive::Purpose::Restore, 50'000};
    after.keep(restored);
    EXPECT_EQ(after.last, 49'700);
    EXPECT_EQ(after.next, 50'300);
}

TEST(Archive, SaysWhichValueIsAnother) {
    struct Other {
        double number = 0;
        bool count = false;
        void keep(Archive& archive) {
            archive.version("Everything", 1);
            archive & number & count;
        }
    } other;
    Everything object;
    const std::vector<std::byte> bytes = saved(object);

    EXPECT_EQ(problemOf(other, bytes),
              "Everything, value 2: it keeps 1 bool, saved was 1 int of 8 bytes");
}

TEST(Archive, FindsAnArrayOfAnotherLength) {
    Everything longer = full();
    longer.profiles.resize(3);
    const std::vector<std::byte> bytes = saved(longer);
    Everything object;

    EXPECT_EQ(problemOf(object, bytes),
              "Everything, value 5: it keeps 2 structs, saved was 3 structs");
}

struct Versioned {
    std::uint16_t number;
    std::string_view name = "Counter";
    double old = 3, added = 4;

    void keep(Archive& archive) {
        const std::uint16_t version = archive.version(name, number);
        archive & old;
        if (version >= 2) archive & added;
    }
};

TEST(Archive, LetsANewerClassTakeWhatAnOlderOneKept) {
    Versioned older{1};
    older.old = 8;
    const std::vector<std::byte> bytes = saved(older);
    Versioned newer{2};

    EXPECT_EQ(problemOf(newer, bytes), "");
    Archive archive{bytes, Archive::Purpose::Restore};
    newer.keep(archive);

    EXPECT_EQ(newer.old, 8);
    EXPECT_EQ(newer.added, 4);
}

TEST(Archive, RefusesANewerVersionAndAnotherClass) {
    Versioned newer{2}, older{1}, other{2, "Integral"};
    const std::vector<std::byte> bytes = saved(newer);

    EXPECT_EQ(problemOf(older, bytes), "Counter: version 2 was saved, this one knows up to 1");
    EXPECT_EQ(problemOf(other, bytes), "Integral: saved was another class");
}

TEST(Archive, FindsWhatWasCutAndWhatIsTooLong) {
    Everything object = full();
    std::vector<std::byte> bytes = saved(object);

    for (std::size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_NE(problemOf(object, std::span{bytes}.first(size)), "") << size;
    }
    bytes.push_back(std::byte{0});
    EXPECT_EQ(problemOf(object, bytes), "Everything, value 10: more was saved than it keeps");
}

TEST(Archive, NeverWritesBesideItsRoom) {
    Everything object = full();
    const std::size_t size = saved(object).size();
    std::vector<std::byte> room(size - 1, std::byte{0xee});
    Archive archive{room};

    object.keep(archive);

    ASSERT_TRUE(archive.problem());
    EXPECT_NE(archive.problem()->view().find("there is no room for it"), std::string_view::npos);
}

TEST(Archive, TakesNoBoolThatIsNone) {
    Profile object;
    std::vector<std::byte> bytes = saved(object);
    bytes.back() = std::byte{2};

    EXPECT_NE(problemOf(object, bytes), "");
}

}  // namespace

}  // namespace cortex
