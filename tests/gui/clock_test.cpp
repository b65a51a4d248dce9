// SPDX-License-Identifier: Apache-2.0
// In which zone times are shown, and agents whose clock differs from ours.
#include "model/event_details.hpp"
#include "model/event_model.hpp"
#include "model/outcome_text.hpp"
#include "model/past_reach.hpp"
#include "model/shown_time.hpp"
#include "plot_fixture.hpp"
#include "plots/time_axis.hpp"
#include "plots/time_ticks.hpp"
#include "record/clock_offset.hpp"
#include "views/lease_table.hpp"

#include <QTemporaryDir>
#include <cstdlib>
#include <ctime>
#include <sstream>

namespace cortex::test {
namespace {

constexpr std::int64_t ms = 1'000'000;  // ns

// A computer half an hour off the full hours, which no list of zones is needed for.
class InIndia : public Plotted {
protected:
    InIndia() {
        qputenv("TZ", "IST-5:30");
        tzset();
        showLocalTime(true);
    }
    ~InIndia() override {
        showLocalTime(false);
        qunsetenv("TZ");
        tzset();
    }
};

TEST_F(InIndia, LocalTimesAreShownWithTheNameOfTheirZone) {
    EXPECT_EQ(zoneName(MadeAgent::start), "IST");
    EXPECT_EQ(timeText(0, 1), "05:30:00");
    EXPECT_EQ(shownTimeText(0, "yyyy-MM-dd HH:mm"), "1970-01-01 05:30");
    const EventModel events;
    EXPECT_EQ(events.headerData(EventModel::Time, Qt::Horizontal, Qt::DisplayRole), "Time (IST)");
    showLocalTime(false);
    EXPECT_EQ(timeText(0, 1), "00:00:00");
    EXPECT_EQ(events.headerData(EventModel::Time, Qt::Horizontal, Qt::DisplayRole), "Time (UTC)");
}

TEST_F(InIndia, EachTimeThatIsSaidHasItsZone) {
    constexpr std::int64_t when = 1'764'410'000'250 * ms;
    CommandOutcome outcome;
    outcome.answer.outcome = Outcome::Done;
    outcome.came = when;
    EXPECT_TRUE(outcomeText(outcome).endsWith("  15:23:20.250 IST"));
    comms::AgentEvent event;
    event.kind = "overflow";
    event.wallClock = when;
    const auto details = detailsOf(EventRow{event});
    EXPECT_TRUE(std::ranges::any_of(details, [](const auto& each) {
        return each ==
               std::pair{QStringLiteral("time"), QStringLiteral("2025-11-29 15:23:20.250 IST")};
    }));
    PastReach reach;
    reach.agent = "robot";
    reach.asking = false;
    reach.since = {{"command", when}};
    EXPECT_EQ(reachText({reach}, 0),
              "robot: commands are kept since 2025-11-29 15:23:20.250 IST; older ones are not "
              "kept");
    LeaseTable leases;
    leases.show(*frameOf({agent.now()}), agent.now());
    EXPECT_EQ(leases.headerItem()->text(2), "Since (IST)");
}

TEST_F(InIndia, TicksStandAtFullHoursOfTheZone) {
    const QList<double> ticks = timeTicks({0, 8'000}, 3'600);
    ASSERT_EQ(ticks.size(), 2);
    EXPECT_EQ(timeText(ticks[0], 3'600), "06:00:00");
    EXPECT_EQ(timeText(ticks[1], 3'600), "07:00:00");
}

TEST_F(InIndia, TheAxisNamesTheZone) {
    view.add({position});
    show();
    run(100, [](double) { return 0.0; });
    show();
    EXPECT_EQ(view.findChild<TimeAxis*>()->accessibleName(), "Time in IST");
}

TEST(ShownTime, TheDateStandsAtTheAxisWhereMidnightIsWithinIt) {
    EXPECT_EQ(dateText({86'390, 86'410}), "01-01");
    EXPECT_EQ(dateText({86'400, 86'410}), "");
}

// So many blocks, one each 100 ms, of a clock that is ahead; each takes its own time to come.
ClockOffset heard(std::int64_t ahead, int blocks, std::int64_t (*way)(int), ClockOffset clock = {},
                  std::int64_t from = 0) {
    for (int i = 0; i < blocks; ++i) {
        const std::int64_t taken = MadeAgent::start + from + i * 100 * ms;
        clock.add(taken + ahead, taken + way(i));
    }
    return clock;
}

std::int64_t slowButForOne(int block) { return block % 50 == 20 ? ms : 300 * ms; }

TEST(ClockOffset, IsEstimatedFromTheQuickestBlockOfTwentySeconds) {
    EXPECT_EQ(heard(400 * ms, 100, slowButForOne).shift(), 399 * ms);
}

TEST(ClockOffset, IsNothingWhereTheQuickestBlockExplainsIt) {
    EXPECT_EQ(heard(0, 100, slowButForOne).shift(), 0);
    EXPECT_EQ(heard(45 * ms, 100, slowButForOne).shift(), 0);
}

TEST(ClockOffset, IsNotToldFromWhatCameFirst) {
    const auto old = [](int) { return 5'000 * ms; };
    EXPECT_EQ(heard(0, 9, old).shift(), 0);
}

TEST(ClockOffset, StaysWhileEstimatesWanderAndIsGivenUpOnceTheClockIsSet) {
    const auto quick = [](int) { return ms; };
    ClockOffset clock = heard(400 * ms, 50, quick);
    const std::int64_t before = clock.shift();
    clock = heard(412 * ms, 250, quick, clock, 5'000 * ms);
    EXPECT_EQ(clock.shift(), before);
    clock = heard(0, 250, quick, clock, 30'000 * ms);
    EXPECT_EQ(clock.shift(), 0);
}

class Ahead : public Plotted {
protected:
    // As `run`, of an agent whose clock is ahead by so much.
    void runAhead(int cycles, std::int64_t ahead) {
        for (int i = 0; i < cycles; ++i) {
            const auto image = agent.now().image;
            recorder.hear("far", *image, (*image)->wallClock() - ahead);
        }
    }
};

TEST_F(Ahead, AnAgentWithAnotherClockIsNamedAndItsLinesAreWhereTheyArrived) {
    view.add({position});
    show();
    runAhead(3'000, 400 * ms);
    show();
    EXPECT_EQ(view.notice(), "far's clock is 0.4 s ahead");
    const DrawnLine drawn = line(1);
    const double arrived =
        static_cast<double>(MadeAgent::start + agent.cycle() * MadeAgent::period) * 1e-9 - 0.4;
    EXPECT_NEAR(drawn.time->secondsAt(drawn.ring->end() - 1), arrived, 5e-3);
    EXPECT_NEAR(drawn.time->indexAt(arrived), static_cast<double>(drawn.ring->end() - 1), 5);
    EXPECT_NEAR(view.range().shown().to, arrived, 0.3) << "now is by our clock";
}

TEST_F(Ahead, AClockThatIsHoursBehindIsSaidInWords) {
    view.add({position});
    show();
    runAhead(3'000, -7'260'000 * ms);
    show();
    EXPECT_EQ(view.notice(), "far's clock is 2 h 01 min behind");
}

TEST_F(Ahead, NothingIsSaidOfAClockThatIsRight) {
    view.add({position});
    show();
    runAhead(3'000, 20 * ms);
    show();
    EXPECT_EQ(view.notice(), "");
}

}  // namespace
}  // namespace cortex::test
