// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/command.hpp"

#include "cortex/core/command_exchange.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/record.hpp"

#include "support/agent_rig.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using test::commandTypes;

struct Command : testing::Test {
    const TypeModel types = commandTypes();
    const CommandTable table = commandTable(types.at("Worker"));

    std::uint32_t index(std::string_view name) const { return table.find(name); }
    const CommandTable::Entry& entry(std::string_view name) const {
        return table.entries[index(name)];
    }
    std::vector<std::uint64_t> record(std::string_view command,
                                      const std::map<std::string, Value>& arguments = {}) const {
        std::vector<std::uint64_t> words(entry(command).request.size / 8 + 1);
        encodeRecord(table, index(command), arguments, reinterpret_cast<std::byte*>(words.data()));
        return words;
    }
    std::string check(std::string_view command, const std::vector<std::uint64_t>& words) const {
        return std::string{
            checkArguments(entry(command).request, reinterpret_cast<const std::byte*>(words.data()))
                .view()};
    }
};

TEST(Outcome, HasAName) {
    EXPECT_STREQ(name(Outcome::None), "None");
    EXPECT_STREQ(name(Outcome::MailboxFull), "MailboxFull");
    EXPECT_STREQ(name(Outcome::Unknown), "Unknown");
    EXPECT_STREQ(name(Reason::None), "none");
    EXPECT_STREQ(name(Reason::UnknownCommand), "unknown");
}

TEST(LifeCycle, IsToldByTheNameOfItsCommand) {
    EXPECT_EQ(lifeCycleCommand("startup"), LifeCycle::Startup);
    EXPECT_EQ(lifeCycleCommand("shutdown"), LifeCycle::Shutdown);
    EXPECT_EQ(lifeCycleCommand("clearFaults"), LifeCycle::ClearFaults);
    EXPECT_EQ(lifeCycleCommand("zero"), LifeCycle::None);
}

TEST_F(Command, TableHasTheCommandsOfTheTypeThenCancelThenSet) {
    ASSERT_GE(table.entries.size(), 2U);
    EXPECT_EQ(table.entries.back().name, "set");
    EXPECT_EQ(table.entries.back().command, nullptr);
    EXPECT_EQ(table.entries[table.entries.size() - 2].name, "cancel");
    EXPECT_TRUE(table.hasLong);
    EXPECT_EQ(table.find("nothing"), CommandTable::none);
    EXPECT_EQ(table.settable.size(), 5U);
}

TEST_F(Command, ParametersWithoutADefaultAreRequired) {
    const auto lift = [&](const std::map<std::string, Value>& arguments) -> std::string {
        try {
            record("lift", arguments);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    const Value load = std::vector{2.0}, arms = std::vector<std::int64_t>{1, 2};
    EXPECT_EQ(lift({}),
              "command 'lift' needs the parameters 'load' (float), 'arms' (int array of 2): they "
              "have no default");
    EXPECT_EQ(lift({{"arms", arms}}),
              "command 'lift' needs the parameter 'load' (float): it has no default");
    EXPECT_EQ(lift({{"arms", arms}, {"load", load}}), "") << "slow has a default";
}

TEST_F(Command, TableOfATypeWithoutLongCommandsOrSettableItemsHasNoBuiltInOnes) {
    const CommandTable boss = commandTable(types.at("Boss"));

    EXPECT_EQ(boss.find("cancel"), CommandTable::none);
    EXPECT_EQ(boss.find("set"), CommandTable::none);
    EXPECT_NE(boss.find("startup"), CommandTable::none);
}

TEST_F(Command, RecordOfSetHasAFlagForEachItemInFront) {
    const auto words = record("set", {{"gain", Value{std::vector{2.0}}}});
    const auto* octets = reinterpret_cast<const std::byte*>(words.data());

    for (std::size_t i = 0; i < table.settable.size(); ++i) {
        EXPECT_EQ(octets[i] == std::byte{1}, table.settable[i]->name == "gain");
    }
    EventText text;
    describeRecord(table, index("set"), octets, text);
    EXPECT_EQ(text.view(), "gain=2");
    EXPECT_EQ(argumentsOf(table, index("set"), octets),
              (std::map<std::string, Value>{{"gain", Value{std::vector{2.0}}}}));
}

TEST_F(Command, ArgumentsInRangeAreGood) {
    EXPECT_EQ(check("add", record("add")), "");
    EXPECT_EQ(check("add", record("add", {{"amount", Value{std::vector{100.0}}}})), "");
    EXPECT_EQ(check("mix", record("mix", {{"number", Value{std::vector<std::int64_t>{-3}}}})), "");
}

TEST_F(Command, ArgumentsOutOfRangeAreNamedWithTheirBound) {
    EXPECT_EQ(check("add", record("add", {{"amount", Value{std::vector{100.5}}}})),
              "amount: 100.5 is above 100");
    EXPECT_EQ(check("add", record("add", {{"amount", Value{std::vector{-1.0}}}})),
              "amount: -1 is below 0");
    EXPECT_EQ(check("mix", record("mix", {{"number", Value{std::vector<std::int64_t>{8}}}})),
              "number: 8 is above 7");
}

TEST_F(Command, ArgumentsMustBeFinite) {
    const double nan = std::nan("");
    const double infinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(check("add", record("add", {{"amount", Value{std::vector{nan}}}})),
              "amount: not a finite number");
    EXPECT_EQ(check("mix", record("mix", {{"list", Value{std::vector{0.0, infinite}}}})),
              "list: not a finite number");
}

TEST_F(Command, NumbersOfALabelledParameterWithoutRangeMustHaveALabel) {
    EXPECT_EQ(check("mix", record("mix", {{"mode", Value{std::vector<std::int64_t>{1}}}})), "");
    EXPECT_EQ(check("mix", record("mix", {{"mode", Value{std::vector<std::int64_t>{2}}}})),
              "mode: 2 has no label");
}

TEST_F(Command, OctetsThatAreNoBoolAndStringsOfAnotherShapeAreRefused) {
    auto words = record("mix");
    auto* octets = reinterpret_cast<std::byte*>(words.data());
    octets[entry("mix").request.find("flag")->offset] = std::byte{2};
    EXPECT_EQ(check("mix", words), "flag: neither true nor false");

    words = record("mix");
    octets = reinterpret_cast<std::byte*>(words.data());
    auto* cell = reinterpret_cast<StringCell*>(octets + entry("mix").request.find("text")->offset);
    cell->length = 9;
    EXPECT_NE(check("mix", words), "");
}

TEST_F(Command, BoundsBetweenIntegersAreTakenInwards) {
    DataItem item;
    item.name = "n";
    item.kind = Kind::Int;
    item.min = Number{-1.5};
    item.max = Number{2.5};
    RecordLayout layout{{{&item, 0}}, 8};
    const auto why = [&](std::int64_t value) {
        return std::string{
            checkArguments(layout, reinterpret_cast<const std::byte*>(&value)).view()};
    };

    EXPECT_EQ(why(-1), "");
    EXPECT_EQ(why(2), "");
    EXPECT_NE(why(-2), "");
    EXPECT_NE(why(3), "");

    item.min = Number{-1e300};
    item.max = Number{1e300};
    EXPECT_EQ(why(std::numeric_limits<std::int64_t>::min()), "");
    EXPECT_EQ(why(std::numeric_limits<std::int64_t>::max()), "");
}

TEST_F(Command, RecordRefusesUnknownParametersAndOtherShapes) {
    EXPECT_THROW(record("add", {{"amonut", Value{std::vector{1.0}}}}), Error);
    EXPECT_THROW(record("add", {{"amount", Value{std::vector{1.0, 2.0}}}}), Error);
    EXPECT_THROW(record("add", {{"amount", Value{std::vector<std::string>{"x"}}}}), Error);
    EXPECT_NO_THROW(record("add", {{"amount", Value{std::vector<std::int64_t>{3}}}}));
}

TEST_F(Command, RecordIsDescribedInShort) {
    const auto words = record("mix", {{"flag", Value{std::vector<bool>{true}}},
                                      {"text", Value{std::vector<std::string>{"hi"}}},
                                      {"list", Value{std::vector{0.5, 1.0}}}});
    EventText text;
    describeRecord(table, index("mix"), reinterpret_cast<const std::byte*>(words.data()), text);

    EXPECT_EQ(text.view(), "mode=0, number=0, flag=true, text=\"hi\", list=0.5 1");
}

TEST_F(Command, CallReadsArgumentsAndWritesResults) {
    auto request = record("add", {{"amount", Value{std::vector{4.0}}}});
    std::vector<std::uint64_t> response(1);
    Call call{reinterpret_cast<const std::byte*>(request.data()),
              reinterpret_cast<std::byte*>(response.data())};

    call[Result<double>{0}] = call[Argument<double>{0}] * 2;

    EXPECT_EQ(decodeRecord(entry("add").response,
                           reinterpret_cast<const std::byte*>(response.data()))["sum"],
              (Value{std::vector{8.0}}));
    EXPECT_TRUE(call.first());
    EXPECT_FALSE(call.cancelling());
    EXPECT_EQ(call.sender(), nullptr);
}

TEST_F(Command, CallSaysWhyItFailsOrRejects) {
    Call failed{nullptr, nullptr}, rejected{nullptr, nullptr};

    EXPECT_EQ(failed.fail("too hot"), Outcome::Failed);
    EXPECT_EQ(rejected.reject(Reason::Busy, "later"), Outcome::Rejected);

    EXPECT_EQ(failed.why(), "too hot");
    EXPECT_EQ(rejected.reason(), Reason::Busy);
    EXPECT_EQ((Call{nullptr, nullptr}.why()), "");
}

}  // namespace
}  // namespace cortex
