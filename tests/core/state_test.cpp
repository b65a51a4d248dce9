// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/state.hpp"

#include "cortex/core/command.hpp"
#include "cortex/core/event.hpp"
#include "cortex/core/nearest_names.hpp"
#include "cortex/core/quality.hpp"
#include "cortex/core/report.hpp"
#include "cortex/core/type_model.hpp"

#include "base/text.hpp"
#include "types/enum_names.hpp"

#include <gtest/gtest.h>

namespace cortex {
namespace {

TEST(State, HasTheNamesOfBaseXml) {
    for (int i = 0; i < stateCount; ++i) {
        const auto state = static_cast<State>(i);
        EXPECT_EQ(stateFromName(name(state)), state);
    }
    EXPECT_FALSE(stateFromName("standby"));
}

TEST(StateSet, IsTextInBothDirections) {
    for (unsigned bits = 1; bits < 1U << stateCount; ++bits) {
        StateSet set;
        for (int i = 0; i < stateCount; ++i) {
            if (bits >> static_cast<unsigned>(i) & 1U)
                set = set | StateSet::of(static_cast<State>(i));
        }
        EXPECT_EQ(stateSetFromText(set.text()), set) << set.text();
    }
    EXPECT_EQ(StateSet::always().text(), "always");
    EXPECT_EQ(StateSet::none().text(), "");
    EXPECT_EQ(stateSetFromText(" Active \n Standby ")->text(), "Standby Active");
}

TEST(StateSet, RefusesWhatIsNoState) {
    for (const char* text : {"", "  ", "standby", "Active always", "Active Off"}) {
        EXPECT_FALSE(stateSetFromText(text)) << text;
    }
}

TEST(StateSet, ContainsItsParts) {
    const StateSet both = StateSet::of(State::Active) | StateSet::of(State::Fault);
    EXPECT_TRUE(both.contains(StateSet::of(State::Fault)));
    EXPECT_FALSE(StateSet::of(State::Fault).contains(both));
    EXPECT_TRUE((both & StateSet::of(State::Standby)).empty());
}

TEST(EnumNames, AreReadAsWritten) {
    EXPECT_EQ(fromSpelling<Role>(name(Role::Modification)), Role::Modification);
    EXPECT_EQ(fromSpelling<Direction>(name(Direction::Output)), Direction::Output);
    EXPECT_EQ(fromSpelling<OnLoss>(name(OnLoss::Fault)), OnLoss::Fault);
    EXPECT_EQ(fromSpelling<OnLimit>(name(OnLimit::Clamp)), OnLimit::Clamp);
    EXPECT_EQ(fromSpelling<OnBusy>(name(OnBusy::Replace)), OnBusy::Replace);
    EXPECT_EQ(fromSpelling<OnSenderLost>(name(OnSenderLost::Cancel)), OnSenderLost::Cancel);
    EXPECT_EQ(fromSpelling<OnLeaseLost>(name(OnLeaseLost::Hold)), OnLeaseLost::Hold);
    EXPECT_EQ(allSpellings<Direction>(), "input or output");
    EXPECT_EQ(allSpellings<Kind>(), "int, float, bool or string");
}

TEST(Report, PrintsPathMessagePlaceAndRemedy) {
    Report report;
    report.error("/arm", "below-min", {"arm.xml", 14}, "rule 'gripper' needs 1", "relate one");
    report.warning("", "other", {}, "something");
    EXPECT_FALSE(report.ok());
    EXPECT_EQ(report.errors(), 1U);
    EXPECT_EQ(report.text(),
              "/arm: rule 'gripper' needs 1 [arm.xml:14]; relate one\nwarning: something\n");
}

TEST(Report, AppendsAnotherAndNeedsAnErrorToRefuse) {
    Report report, other;
    other.warning("A", "b", {"f.xml", 0}, "c");
    other.add({Severity::Info, "", "i", {}, "told", ""});
    report.append(other);
    EXPECT_TRUE(report.ok());
    EXPECT_EQ(report.text(), "warning: A: c [f.xml]\ninfo: told\n");
    EXPECT_STREQ(name(Severity::Error), "error");
}

TEST(Text, KnowsNames) {
    for (const char* text : {"a", "_x", "Axis-1", "kukaLbr_7"}) EXPECT_TRUE(isName(text)) << text;
    for (const char* text : {"", "1a", "-a", "a b", "a.b", "ä"}) EXPECT_FALSE(isName(text)) << text;
    EXPECT_TRUE(isName(std::string(64, 'a')));
    EXPECT_FALSE(isName(std::string(65, 'a')));
}

TEST(Text, KnowsUtf8) {
    for (const char* text : {"", "abc", "ü€𝄞", "\xEF\xBF\xBD"}) EXPECT_TRUE(isUtf8(text)) << text;
    for (const char* text : {"\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\x80",
                             "\xE2\x82", "\xF0\x80\x80\x80", "\xF5", "\xE2\x28\xA1"}) {
        EXPECT_FALSE(isUtf8(text));
    }
}

TEST(Text, CutsLongQuotationsAtACharacter) {
    EXPECT_EQ(inQuotes("short"), "'short'");
    std::string longText(79, 'x');
    longText += "€ and more";
    EXPECT_EQ(inQuotes(longText), "'" + std::string(79, 'x') + "…'");
}

TEST(NearestNames, ListsAtMostThreeByDistance) {
    const std::vector<std::string> valid{"position", "positions", "velocity", "postion2", "mode"};
    EXPECT_EQ(nearestNames("postion", valid), "nearest of: position, postion2, positions");
    EXPECT_EQ(nearestNames("POSITION", valid), "nearest of: position, positions, postion2");
    EXPECT_EQ(nearestNames("moed", valid), "nearest of: mode");
    EXPECT_EQ(nearestNames("gripper", valid), "");
    EXPECT_EQ(nearestNames("", valid), "");
    EXPECT_EQ(nearestNames(std::string(1'000'000, 'x'), valid), "");
}

template <class E, class Read>
void expectReadBack(int count, Read read) {
    for (int i = 0; i < count; ++i) EXPECT_EQ(read(name(static_cast<E>(i))), static_cast<E>(i));
    EXPECT_FALSE(read(""));
    EXPECT_FALSE(read("nothing"));
}

TEST(EnumNames, AreReadBack) {
    expectReadBack<Kind>(4, kindFromName);
    expectReadBack<Role>(4, roleFromName);
    expectReadBack<Outcome>(9, outcomeFromName);
    expectReadBack<Reason>(8, reasonFromName);
    expectReadBack<Quality>(4, qualityFromName);
    expectReadBack<Severity>(3, severityFromName);
    expectReadBack<EventKind>(13, eventKindFromName);
}

}  // namespace
}  // namespace cortex
