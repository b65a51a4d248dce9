// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/data.hpp"

#include "cortex/core/command.hpp"
#include "cortex/core/error.hpp"

#include <array>
#include <limits>
#include <new>
#include <string>
#include <type_traits>

#include <gtest/gtest.h>

namespace cortex {
namespace {

static_assert(std::is_assignable_v<Data<double>&, double>);
static_assert(!std::is_assignable_v<Data<const double>&, double>);
static_assert(!std::is_assignable_v<Data<const std::string_view>&, std::string_view>);
static_assert(!std::is_assignable_v<Data<const bool>&, bool>);
static_assert(!std::is_constructible_v<Data<double>, const double*>);
// What an input gave is not written, and not bound where the member forgot `const`.
static_assert(std::is_assignable_v<Data<double>&, Data<const double>&>);       // copies the value
static_assert(std::is_assignable_v<Data<const double>&, Data<const double>>);  // populate() binds
// What a call shows is copied, never bound; what else must not compile: must_not_compile.cpp.
static_assert(std::is_assignable_v<Data<double>&, CellReference<const double>>);
static_assert(!std::is_assignable_v<Data<const double>&, CellReference<const double>>);
static_assert(!std::is_assignable_v<CellReference<const double>, double>);
static_assert(!std::is_constructible_v<Data<double>, Data<const double>>);
static_assert(
    !std::is_assignable_v<TextArray<std::string_view>&, TextArray<const std::string_view>>);
template <class T>
constexpr bool counts = requires(Data<T> data) {
    data += data.get();
    data -= data.get();
    data *= data.get();
    data /= data.get();
};
template <class T>
constexpr bool countsAtAll = requires(Data<T> data) { data += data.get(); } ||
                             requires(Data<T> data) { data -= data.get(); } ||
                             requires(Data<T> data) { data *= data.get(); } ||
                             requires(Data<T> data) { data /= data.get(); };
static_assert(counts<double> && counts<std::int64_t>);
static_assert(!countsAtAll<bool> && !countsAtAll<std::string_view>);
static_assert(!countsAtAll<const double> && !countsAtAll<const std::int64_t>);
static_assert(std::is_same_v<StorageOf<const std::string_view>::type, const StringCell>);
static_assert(kindFor<const std::int64_t>() == Kind::Int && kindFor<double>() == Kind::Float &&
              kindFor<bool>() == Kind::Bool && kindFor<std::string_view>() == Kind::String);

// A cell with the room that a table gives it.
struct Text {
    explicit Text(std::uint16_t capacity) : cell{new(memory.data()) StringCell{capacity, 0, 0}} {
        memory[StringCell::size(capacity)] = std::byte{0x7e};
        end = &memory[StringCell::size(capacity)];
    }
    alignas(8) std::array<std::byte, 64> memory{};
    StringCell* cell;
    std::byte* end;
};

TEST(Data, IsUsedLikeTheValueItself) {
    double cell = 2;
    Data<double> position{&cell};
    const Data<const double> seen{&cell};

    position = seen * 2 + 1;
    position += 0.5;

    EXPECT_EQ(cell, 5.5);
    EXPECT_EQ(seen.get(), 5.5);
}

TEST(Data, IsCountedAndScaledInPlace) {
    double cell = 6;
    std::int64_t count = 7;
    Data<double> position{&cell};
    Data<std::int64_t> cycles{&count};

    position -= 1;
    EXPECT_EQ(cell, 5);
    position *= 3;
    EXPECT_EQ(cell, 15);
    (position /= 2) += 0.5;
    EXPECT_EQ(cell, 8);
    cycles += 2;
    cycles -= 1;
    cycles *= 5;
    cycles /= 3;
    EXPECT_EQ(count, 13);
}

TEST(Data, IsUnboundUntilItIsObtained) {
    bool cell = false;
    EXPECT_FALSE(Data<bool>{}.bound());
    EXPECT_TRUE(Data<bool>{&cell}.bound());
}

TEST(Data, CopiesTheValueOfAHandleThatHasAName) {
    double from = 3, to = 1;
    Data<double> level{&to};
    Data<double> other{&from};
    const Data<const double> seen{&from};

    level = other;
    from = 4;

    EXPECT_EQ(to, 3);
    EXPECT_EQ(level, 3);
    level = seen;
    EXPECT_EQ(to, 4);
    EXPECT_EQ(&(level = other), &level);
}

TEST(Data, IsBoundByWhatHasNoName) {
    double first = 1, second = 2;
    Data<double> level{&first};

    level = Data<double>{&second};
    level = 5;

    EXPECT_EQ(first, 1);
    EXPECT_EQ(second, 5);
}

template <class Action>
std::string unboundIn(Action action) {
    try {
        action();
    } catch (const UnboundHandle& unbound) {
        return unbound.what();
    }
    return "nothing";
}

TEST(Data, ThatIsNotBoundSaysSoWhenItIsUsed) {
    Data<double> level;
    double cell = 1;
    Data<double> bound{&cell};

    EXPECT_EQ(unboundIn([&] { level = 1; }),
              "handle Data<double> is not bound (forgotten in populate()?)");
    EXPECT_EQ(unboundIn([&] { level += 1; }), unboundIn([&] { level = 1; }));
    EXPECT_EQ(unboundIn([&] { bound = level; }), unboundIn([&] { level = 1; }));
    EXPECT_EQ(unboundIn([&] { level = bound; }), unboundIn([&] { level = 1; }));
    EXPECT_EQ(unboundIn([] { Data<const std::string_view>{}.get(); }),
              "handle Data<const std::string_view> is not bound (forgotten in populate()?)");
    EXPECT_EQ(unboundIn([] { static_cast<void>(TextArray<std::string_view>{}[0]); }),
              "handle TextArray<std::string_view> is not bound (forgotten in populate()?)");
}

TEST(Call, SaysThatAnArgumentWasNotGotInPopulate) {
    Call call{nullptr, nullptr};
    EXPECT_EQ(unboundIn([&] { static_cast<void>(call[Argument<double>{}]); }),
              "handle Argument<double> is not bound (forgotten in populate()?)");
    EXPECT_EQ(unboundIn([&] { static_cast<void>(call[ArrayResult<bool>{}]); }),
              "handle ArrayResult<bool> is not bound (forgotten in populate()?)");
}

TEST(Call, GivesAHandleTheValueOfAParameterAndKeepsItsItem) {
    double cell = 1, request = 5, response = 7;
    Data<double> level{&cell};
    Call call{reinterpret_cast<std::byte*>(&request), reinterpret_cast<std::byte*>(&response)};

    level = call[Argument<double>{0}];
    EXPECT_EQ(cell, 5);
    level = call[Result<double>{0}];
    EXPECT_EQ(cell, 7);
    level = 9;

    EXPECT_EQ(cell, 9);
    EXPECT_EQ(request, 5);
    EXPECT_EQ(response, 7);
}

TEST(Data, AssignsTextByValue) {
    Text text{16};
    Data<std::string_view> label{text.cell};

    label = "gripper";

    EXPECT_EQ(label.get(), "gripper");
    EXPECT_EQ(text.cell->cuts, 0U);
}

TEST(StringCell, TakesWholeEightsInATable) {
    EXPECT_EQ(StringCell::size(0), 8U);
    EXPECT_EQ(StringCell::size(1), 16U);
    EXPECT_EQ(StringCell::size(8), 16U);
    EXPECT_EQ(StringCell::size(9), 24U);
}

TEST(StringCell, CutsAtACharacterAndCounts) {
    Text text{5};
    text.cell->assign("abcd\u00e9");  // the last character would need octets 5 and 6
    EXPECT_EQ(text.cell->view(), "abcd");
    text.cell->assign("ab\U0001F600");  // four octets from the third on
    EXPECT_EQ(text.cell->view(), "ab");
    text.cell->assign("abc\u00e9");
    EXPECT_EQ(text.cell->view(), "abc\u00e9");

    EXPECT_EQ(text.cell->cuts, 2U);
    EXPECT_EQ(*text.end, std::byte{0x7e});
}

TEST(StringCell, KeepsACharacterThatEndsAtTheCapacity) {
    Text text{4};
    text.cell->assign("ab\u00e9z");
    EXPECT_EQ(text.cell->view(), "ab\u00e9");
}

TEST(StringCell, CutsWhatIsNoUtf8AtMostToNothing) {
    Text text{3};
    text.cell->assign("\x80\x80\x80\x80\x80");
    EXPECT_EQ(text.cell->view(), "");
    EXPECT_EQ(text.cell->cuts, 1U);
}

TEST(StringCell, StopsCountingCutsInsteadOfStartingAgain) {
    Text text{1};
    text.cell->cuts = std::numeric_limits<std::uint32_t>::max();
    text.cell->assign("ab");
    EXPECT_EQ(text.cell->cuts, std::numeric_limits<std::uint32_t>::max());
}

TEST(StringCell, TakesAPartOfItself) {
    Text text{8};
    text.cell->assign("abcdef");
    text.cell->assign(text.cell->view().substr(2));
    EXPECT_EQ(text.cell->view(), "cdef");
}

TEST(StringCell, HoldsNothingWithoutCapacity) {
    Text text{0};
    text.cell->assign("a");
    text.cell->assign("");
    EXPECT_EQ(text.cell->view(), "");
    EXPECT_EQ(text.cell->cuts, 1U);
}

}  // namespace
}  // namespace cortex
