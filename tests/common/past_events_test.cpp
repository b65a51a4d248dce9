// SPDX-License-Identifier: Apache-2.0
// What agents keep, with what came live: as both programs show it.
#include "common/past_events.hpp"

#include "common/utc_text.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace cortex::common;
using comms::AgentEvent;
using Since = comms::PastEvents::Since;

constexpr std::int64_t second = 1'000'000'000, noon = 1'795'953'600 * second;  // 2026-11-29
constexpr std::int64_t noonEpoch = noon / 1000;

AgentEvent eventAt(std::int64_t time, std::uint64_t number, const std::string& text,
                   const std::string& kind = "command", const std::string& path = "/arm") {
    AgentEvent event;
    event.agent = "robot";
    event.epoch = 1;
    event.number = number;
    event.wallClock = time;
    event.kind = kind;
    event.path = path;
    event.text = text;
    return event;
}

std::string textsOf(const AgentEvents& events) {
    std::string texts;
    for (const AgentEvent& each : events) texts += each.text + ' ';
    return texts;
}

TEST(PastEvents, AreMergedWithLiveOnesInOrderOfTimeAndEachOnce) {
    AgentEvent again = eventAt(2, 7, "live");
    again.repeatable = 3;
    AgentEvent otherStart = eventAt(5, 7, "other-start"), otherAgent = eventAt(6, 7, "other-agent");
    otherStart.epoch = 2;
    otherAgent.agent = "cart";
    const AgentEvents kept{eventAt(1, 6, "old"),
                           eventAt(2, 7, "kept"),
                           eventAt(4, 0, "value", "value"),
                           eventAt(4, 0, "value", "value"),
                           otherStart,
                           otherAgent,
                           eventAt(1, 6, "old")};

    const AgentEvents all = merged(kept, {eventAt(3, 8, "new"), again});

    EXPECT_EQ(textsOf(all), "old live new value value other-start other-agent ");
    EXPECT_EQ(all[1].repeatable, 3U) << "what came live says more";
    EXPECT_TRUE(merged({}, {}).empty());
}

TEST(PastEvents, OfControlConcernThePathThatWasTaken) {
    const std::string axis = "cortex@desk.1-a for alice: takeControl(prefix=\"/arm/axis1\"): Done";
    const std::string all = "desk: releaseControl(prefix=\"/\"): Done in 2 cycles";
    const std::string to = "desk: handOverControl(prefix=\"/arm\", to=\"/cart\"): Done";
    const std::string gone = "desk for alice no longer has control of /arm: it is gone";
    const struct {
        std::string text, prefix;
        bool concerned;
        std::string kind = "control";
    } table[] = {{axis, "/arm/axis1", true},
                 {axis, "/arm", true},
                 {axis, "/arm/axis1/drive", true},
                 {axis, "/", true},
                 {axis, "/arm/axis", false},
                 {axis, "/arm/axis12", false},
                 {axis, "/robot", true},
                 {axis, "/arm/axis1", false, "command"},
                 {all, "/arm/axis1", true},
                 {to, "/arm/axis1", true},
                 {to, "/cart", false},
                 {"9 times within a second: " + to, "/arm", true},
                 {gone, "/arm/axis1", true},
                 {gone, "/army", false},
                 {"desk: takeControl(prefix=\"/arm/axi…): Done", "/arm/axis1", true},
                 {"desk: takeControl(prefix=\"/arm/axi…): Done", "/cart", false},
                 {"desk no longer has control of ", "/arm", true},
                 {"desk: takeControl(): Done", "/arm", false},
                 {"", "/arm", false}};
    for (const auto& each : table) {
        const AgentEvent event = eventAt(1, 1, each.text, each.kind, "/robot");
        EXPECT_EQ(concerns(event, each.prefix), each.concerned) << each.text << each.prefix;
    }
}

std::string inUtc(std::int64_t time) { return utcText(time); }

TEST(PastEvents, OfWhatIsNotKeptSoLongItIsSaidSinceWhen) {
    const std::int64_t ten = noon + 10 * second;
    const struct {
        const char* what;
        std::vector<Since> since;
        std::string text;
    } table[] = {{"all is kept", {{"fault", noon}, {"command", noon - second}}, ""},
                 {"nothing is said", {}, ""},
                 {"one kind",
                  {{"fault", noon}, {"command", ten}},
                  "commands are kept since 2026-11-29T12:00:10.000Z; older ones are not kept"},
                 {"two kinds",
                  {{"fault", noon}, {"command", ten - second}, {"state change", ten}},
                  "state changes are kept since 2026-11-29T12:00:10.000Z, commands since "
                  "2026-11-29T12:00:09.000Z; "
                  "older ones are not kept"},
                 {"as one",
                  {{"fault", noon}, {"command", ten}, {"loss", ten}, {"control", ten}},
                  "commands, losses and changes of control are kept since "
                  "2026-11-29T12:00:10.000Z; older ones "
                  "are not kept"},
                 {"to the millisecond, as events are shown",
                  {{"fault", noon}, {"message", noon + second * 77 / 100 + 1}},
                  "other errors are kept since 2026-11-29T12:00:00.770Z; older ones are not kept"},
                 {"all, from its start on",
                  {{"fault", noon + second}, {"command", noon + second}},
                  "keeps what happened since 2026-11-29T12:00:01.000Z, when it started"},
                 {"all, from an earlier start on, shortly before",
                  {{"fault", noon + 3 * second}, {"command", noon + 3 * second}},
                  "keeps what happened since 2026-11-29T12:00:03.000Z"},
                 {"all, from another time on",
                  {{"fault", noon + 3600 * second}, {"command", noon + 3600 * second}},
                  "keeps what happened since 2026-11-29T13:00:00.000Z"},
                 {"all, and some were dropped",
                  {{"fault", noon + second}, {"command", ten}, {"loss", noon + second}},
                  "commands are kept since 2026-11-29T12:00:10.000Z, all else since "
                  "2026-11-29T12:00:01.000Z; older "
                  "ones are not kept"},
                 {"a single kind",
                  {{"fault", noon + second}},
                  "faults are kept since 2026-11-29T12:00:01.000Z; older ones are not kept"},
                 {"a kind of a later build",
                  {{"fault", noon}, {"smell", ten}},
                  "smell are kept since 2026-11-29T12:00:10.000Z; older ones are not kept"}};
    for (const auto& each : table)
        EXPECT_EQ(keptText(each.since, noon, noonEpoch, inUtc), each.text) << each.what;
}

TEST(PastEvents, TheFirstFaultOfAChainIsTheOneToExplain) {
    const AgentEvents events{eventAt(0, 1, "long-before", "fault", "/arm/axis1"),
                             eventAt(5 * second, 2, "cause", "fault", "/arm/axis3"),
                             eventAt(5 * second + 1, 3, "said", "message", "/arm/axis3"),
                             eventAt(5 * second + 2, 4, "elsewhere", "fault", "/army"),
                             eventAt(6 * second, 5, "arm", "fault", "/arm"),
                             eventAt(7 * second, 6, "later", "state change", "/arm")};

    const auto chain = newestFaults(events, "/arm");

    ASSERT_TRUE(chain);
    EXPECT_EQ(events[chain->first].text, "cause");
    EXPECT_EQ(events[chain->newest].text, "arm");
    EXPECT_EQ(chain->faults, 2U) << "not what is beside the path, nor a second and more before";
    const auto axis1 = newestFaults(events, "/arm/axis1");
    ASSERT_TRUE(axis1);
    EXPECT_EQ(axis1->first, 0U);
    EXPECT_EQ(axis1->faults, 1U);
    EXPECT_EQ(newestFaults(events, "/")->faults, 3U);
    EXPECT_FALSE(newestFaults(events, "/cart"));
    EXPECT_FALSE(newestFaults({}, "/"));
}

TEST(PastEvents, BeforeOneAreThoseOfTheTimeAndWhatCameAfterIsNot) {
    const AgentEvents events{eventAt(second - 1, 1, "earlier"), eventAt(second, 2, "first"),
                             eventAt(3 * second, 0, "value"), eventAt(3 * second, 3, "fault"),
                             eventAt(3 * second, 4, "after")};

    EXPECT_EQ(textsOf(beforeEvent(events, 3, 2 * second)), "first value fault ");
    EXPECT_EQ(textsOf(beforeEvent(events, 0, second)), "earlier ");
    EXPECT_EQ(secondsBefore(events[1], events[3]), "-2.000 s");
    EXPECT_EQ(secondsBefore(eventAt(690'000'000, 1, ""), events[3]), "-2.310 s");
    EXPECT_EQ(secondsBefore(events[2], events[3]), "0.000 s");
}

// Whatever an agent says of its times.
TEST(PastEvents, OfImpossibleTimesAreShownAsWell) {
    constexpr auto first = std::numeric_limits<std::int64_t>::min();
    constexpr auto last = std::numeric_limits<std::int64_t>::max();
    const AgentEvents events{eventAt(first, 1, "a", "fault"), eventAt(last, 2, "b", "fault")};

    EXPECT_EQ(newestFaults(events, "/")->faults, 1U);
    EXPECT_EQ(textsOf(beforeEvent(events, 1, second)), "b ");
    EXPECT_EQ(textsOf(beforeEvent(events, 0, second)), "a ");
    EXPECT_EQ(secondsBefore(events[0], events[1]), "-18446744073.709 s");
    EXPECT_NE(keptText({{"fault", last}, {"command", first}}, 0, first, inUtc), "");
    EXPECT_EQ(keptText({{"fault", first}}, 0, last, inUtc), "");
}

}  // namespace
}  // namespace cortex::test
