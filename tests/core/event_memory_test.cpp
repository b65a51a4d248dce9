// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/event_memory.hpp"

#include "support/small_structure.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using Kinds = std::vector<std::pair<EventKind, Severity>>;

// One for each room.
const Kinds rooms{
    {EventKind::Fault, Severity::Error},         {EventKind::StateChange, Severity::Info},
    {EventKind::Command, Severity::Info},        {EventKind::Refusal, Severity::Warning},
    {EventKind::Control, Severity::Info},        {EventKind::Loss, Severity::Warning},
    {EventKind::ValueChange, Severity::Warning}, {EventKind::Message, Severity::Error}};

KeptEvent entry(std::size_t room, std::int64_t wallClock, std::string text = "text") {
    KeptEvent event;
    event.epoch = 7;
    event.number = static_cast<std::uint64_t>(wallClock);
    event.wallClock = wallClock;
    std::tie(event.kind, event.severity) = rooms[room];
    event.path = "/axis";
    event.text = std::move(text);
    return event;
}

std::vector<std::int64_t> timesOf(const std::vector<KeptEvent>& events) {
    std::vector<std::int64_t> times;
    std::ranges::transform(events, std::back_inserter(times), &KeptEvent::wallClock);
    return times;
}

std::vector<std::int64_t> timesOf(const EventMemory& memory, std::int64_t from = 0,
                                  std::int64_t until = EventMemory::always) {
    return timesOf(memory.page(0, from, until).events);
}

TEST(EventMemory, LosesNothingOfAKindInAFloodOfAnother) {
    for (const std::size_t size : {std::size_t{0}, std::size_t{150}, std::size_t{10'000}}) {
        for (std::size_t flood = 0; flood < rooms.size(); ++flood) {
            EventMemory memory{100};
            for (std::size_t room = 0; room < rooms.size(); ++room) {
                for (std::int64_t i = 1; i <= 4; ++i) memory.keep(entry(room, i));
            }
            for (std::int64_t i = 10; i < 500; ++i) {
                KeptEvent event = entry(flood, i, std::string(size, 't'));
                if (i % 2 == 0) std::swap(event.path, event.text);
                memory.keep(std::move(event));
            }

            const auto events = memory.page(0, 0, 4).events;
            const auto others = std::ranges::count_if(
                events, [&](const KeptEvent& each) { return each.kind != rooms[flood].first; });
            EXPECT_EQ(others, 4 * (std::ssize(rooms) - 1)) << "flood of " << flood;
            EXPECT_GE(memory.page(0, 499).events.size(), 1U) << "the newest of the flood";
        }
    }
}

TEST(EventMemory, IsBoundedInEntriesAndInBytes) {
    for (const std::size_t size : {std::size_t{0}, std::size_t{150}, std::size_t{1000}}) {
        EventMemory memory{100};
        for (std::int64_t i = 0; i < 3000; ++i) {
            memory.keep(
                entry(static_cast<std::size_t>(i) % rooms.size(), i, std::string(size, 't')));
        }
        const auto events = memory.page(0).events;
        std::size_t bytes = 0;
        for (const KeptEvent& each : events) bytes += EventMemory::sizeOf(each);
        EXPECT_EQ(bytes, memory.bytes());
        EXPECT_LE(bytes, 100 * EventMemory::bytesOfEntry);
        if (size == 0)
            EXPECT_EQ(events.size(), 100U);
        else
            EXPECT_GT(events.size(), 10U);
    }
}

TEST(EventMemory, KeepsTheNewestOfEachKindHoweverLongAndHoweverFewItMayKeep) {
    EventMemory memory{1};
    for (std::int64_t i = 1; i <= 3; ++i) {
        for (std::size_t room = 0; room < rooms.size(); ++room) {
            memory.keep(entry(room, i, std::string(100'000, 't')));
        }
    }
    EXPECT_EQ(timesOf(memory), std::vector<std::int64_t>(rooms.size(), 3));
    for (const std::int64_t each : memory.since()) EXPECT_EQ(each, 3);
}

TEST(EventMemory, TakesErrorsOfEveryKindAndNoChatter) {
    const test::Plant plant = test::makePlant();
    Event event;
    event.simplex = plant.axis;
    for (const EventKind kind : {EventKind::Limit, EventKind::Overflow, EventKind::Watchdog,
                                 EventKind::Conflict, EventKind::Agent, EventKind::Message}) {
        EventMemory memory;
        event.kind = kind;
        for (const Severity severity : {Severity::Info, Severity::Warning}) {
            event.severity = severity;
            memory.take(event, *plant.structure);
        }
        EXPECT_EQ(memory.bytes(), 0U) << name(kind);
        event.severity = Severity::Error;
        memory.take(event, *plant.structure);
        const auto events = memory.page(0).events;
        ASSERT_FALSE(events.empty()) << name(kind);
        EXPECT_EQ(events.back().kind, kind);
    }
}

TEST(EventMemory, KnowsAnEventAsOthersDo) {
    const test::Plant plant = test::makePlant();
    EventMemory memory;
    Event event;
    event.kind = EventKind::Command;
    event.severity = Severity::Warning;
    event.number = 3;
    event.cycle = 5;
    event.wallClock = 9;
    event.simplex = plant.axis;
    event.text = "desk: jog(): Refused";
    memory.take(event, *plant.structure);
    event.simplex = noSimplex;
    memory.take(event, *plant.structure);

    const auto events = memory.page(0).events;
    ASSERT_EQ(events.size(), 2U);
    const KeptEvent expected{
        1,       plant.structure->epoch, 3, 5, 9, Severity::Warning, EventKind::Command,
        "/axis", "desk: jog(): Refused"};
    EXPECT_EQ(events[0], expected);
    EXPECT_EQ(events[1].path, "/robot");
}

TEST(EventMemory, GivesWhatItKeepsInTheOrderInWhichItCameByTime) {
    EventMemory memory;
    for (std::int64_t i = 1; i <= 9; ++i) memory.keep(entry(static_cast<std::size_t>(i) % 3, i));

    EXPECT_EQ(timesOf(memory), (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
    EXPECT_EQ(timesOf(memory, 3, 6), (std::vector<std::int64_t>{3, 4, 5, 6})) << "both included";
    EXPECT_EQ(timesOf(memory, 10), (std::vector<std::int64_t>{}));
    EXPECT_FALSE(memory.page(0, 3, 6, 1'000'000).more) << "nothing of this time is behind these";
}

TEST(EventMemory, FindsWhatHappenedByATimeOfDayThatWentBack) {
    EventMemory memory{100};  // ten faults
    for (const std::int64_t time : {100, 200, 300, 50, 60, 210, 70}) memory.keep(entry(0, time));
    EXPECT_EQ(timesOf(memory, 55, 210), (std::vector<std::int64_t>{100, 200, 60, 210, 70}));

    for (const std::int64_t time : {80, 81, 82, 83, 84}) memory.keep(entry(0, time));

    EXPECT_EQ(timesOf(memory),
              (std::vector<std::int64_t>{300, 50, 60, 210, 70, 80, 81, 82, 83, 84}));
    EXPECT_EQ(memory.since()[0], 201) << "of 200 it does not know all any more, of 300 it does";
    for (int i = 0; i < 3; ++i) memory.keep(entry(0, 90));
    EXPECT_EQ(memory.since()[0], 301) << "50 and 60 were dropped later, and are older";
}

TEST(EventMemory, SaysForEachKindFromWhenOnItKnowsEverything) {
    EventMemory memory{100, 1000};
    EXPECT_EQ(memory.since()[2], 1000);
    for (std::int64_t i = 1; i <= 31; ++i) memory.keep(entry(2, 2000 + i));

    for (std::size_t room = 0; room < rooms.size(); ++room) {
        EXPECT_EQ(memory.since()[room], room == 2 ? 2002 : 1000) << room;
    }
    memory.keep(entry(7, EventMemory::always));
    for (int i = 0; i < 5; ++i) memory.keep(entry(7, 1));
    EXPECT_EQ(memory.since()[7], EventMemory::always);
}

TEST(EventMemory, GoesOnFromEarlierStartsWhicheverIsToldFirst) {
    EventMemory::Times since{};
    since.fill(500);
    EventMemory first{100, 1000}, second{100, 1000};
    first.goOn(since);
    for (EventMemory* each : {&first, &second}) {
        for (std::int64_t i = 1; i <= 12; ++i) each->recall(entry(0, 600 + i));
    }
    second.goOn(since);

    for (const EventMemory* each : {&first, &second}) {
        EXPECT_EQ(each->since()[0], 603) << "it had no room for 601 and 602";
        EXPECT_EQ(each->since()[1], 500);
    }
}

TEST(EventMemory, DropsWhatEarlierStartsKeptBeforeItsOwn) {
    EventMemory memory{100};
    for (std::int64_t i = 101; i <= 104; ++i) memory.keep(entry(0, i));
    for (std::int64_t i = 1; i <= 8; ++i) memory.recall(entry(0, i));
    EXPECT_EQ(timesOf(memory), (std::vector<std::int64_t>{101, 102, 103, 104, 3, 4, 5, 6, 7, 8}));
    const std::uint64_t place = memory.page(0).events.back().place;

    EXPECT_GT(memory.keep(entry(0, 105)), place);
    EXPECT_EQ(timesOf(memory), (std::vector<std::int64_t>{101, 102, 103, 104, 4, 5, 6, 7, 8, 105}));
    for (std::int64_t i = 106; i <= 110; ++i) memory.keep(entry(0, i));
    EXPECT_EQ(memory.since()[0], 9);
    memory.keep(entry(0, 111));
    EXPECT_EQ(memory.since()[0], 102);
    EXPECT_EQ(memory.recall(entry(0, 1)), place + 8) << "there is no room for it";
    EXPECT_EQ(timesOf(memory).front(), 102);
}

TEST(EventMemory, LeavesThreeQuartersOfARoomToOthersThanTheSenderWhoFillsIt) {
    EventMemory memory{1000};  // 300 commands
    const auto from = [](const std::string& sender, std::int64_t time,
                         const std::string& said = "") {
        return entry(2, time, said + sender + ": set(x=" + std::to_string(time) + "): Done");
    };
    // Each run of a tool is a process of its own.
    const auto flood = [](std::int64_t run) {
        return "cortex@hall.b." + std::to_string(run) + "-2b for Bo";
    };
    for (std::int64_t i = 1; i <= 150; ++i)
        memory.keep(from("desk for p" + std::to_string(i % 10), i));
    for (std::int64_t i = 1000; i < 3000; ++i) {
        memory.keep(from(flood(i), i, i % 2 == 0 ? "7 times within a second: " : ""));
    }
    EXPECT_EQ(memory.page(0, 0, 999).events.size(), 150U);
    EXPECT_GE(memory.page(0, 2990).events.size(), 10U) << "the newest of the flood";
    EXPECT_GT(memory.since()[2], 1000) << "not everything is kept since then";

    for (std::int64_t i = 3000; i < 3200; ++i)
        memory.keep(from("desk for p" + std::to_string(i % 10), i));
    EXPECT_GE(memory.page(0, 1000, 2999).events.size(), 30U);
    EXPECT_EQ(memory.page(0, 3000).events.size(), 200U);
}

TEST(EventMemory, LosesNoLossToThoseThatRepeat) {
    EventMemory memory{1000};  // 100 losses
    for (std::int64_t i = 1; i <= 40; ++i)
        memory.keep(
            entry(5, i, "input '" + std::string(static_cast<std::size_t>(i), 'a') + "' is lost"));
    for (std::int64_t i = 100; i < 1000; ++i) {
        memory.keep(entry(5, i,
                          i % 2 == 0 ? "/io is lost: no answer for 12" + std::to_string(i)
                                     : "/io is back after " + std::to_string(i) + " ms"));
    }
    EXPECT_EQ(memory.page(0, 0, 99).events.size(), 40U);
    EXPECT_EQ(memory.page(0, 990).events.size(), 10U);
}

// Page by page, while two threads keep more.
TEST(EventMemory, LosesAndDoublesNothingBetweenPages) {
    constexpr std::int64_t each = 3000;
    EventMemory memory{1'000'000};
    std::atomic<int> running{2};
    const auto keep = [&](std::size_t room) {
        for (std::int64_t i = 1; i <= each; ++i) memory.keep(entry(room, i));
        --running;
    };
    std::thread first{keep, 0}, second{keep, 6};
    std::map<EventKind, std::vector<std::int64_t>> seen;
    std::uint64_t place = 0;
    for (bool more = true; more;) {
        const bool last = running == 0;
        const EventMemory::Page page = memory.page(place, 0, EventMemory::always, 1000);
        for (const KeptEvent& event : page.events) {
            ASSERT_GT(event.place, place);
            place = event.place;
            seen[event.kind].push_back(event.wallClock);
        }
        more = page.more || !last;
    }
    first.join();
    second.join();

    for (const EventKind kind : {EventKind::Fault, EventKind::ValueChange}) {
        ASSERT_EQ(seen[kind].size(), static_cast<std::size_t>(each));
        for (std::int64_t i = 0; i < each; ++i) {
            ASSERT_EQ(seen[kind][static_cast<std::size_t>(i)], i + 1);
        }
    }
}

TEST(EventMemory, FillsAPageWithAsMuchAsFitsAndAtLeastOne) {
    EventMemory memory;
    for (std::int64_t i = 1; i <= 4; ++i) memory.keep(entry(0, i));
    const std::size_t size = EventMemory::sizeOf(entry(0, 1));
    for (const auto& [bytes, count] : std::map<std::size_t, std::size_t>{
             {0, 1}, {size, 1}, {2 * size - 1, 1}, {2 * size, 2}, {4 * size, 4}}) {
        const EventMemory::Page page = memory.page(0, 0, EventMemory::always, bytes);
        EXPECT_EQ(page.events.size(), count) << bytes;
        EXPECT_EQ(page.more, count < 4) << bytes;
    }
}

// What an EventMemory does, in the simplest way.
struct Model {
    struct Room {
        std::vector<KeptEvent> earlier, own;
        std::int64_t begin = 0, dropped = -1;
        std::size_t bytes(const std::optional<std::string>& text = {}) const {
            std::size_t sum = 0;
            for (const auto* events : {&earlier, &own}) {
                for (const KeptEvent& each : *events)
                    sum += !text || *text == each.text ? EventMemory::sizeOf(each) : 0;
            }
            return sum;
        }
    };
    std::vector<std::size_t> most;
    std::vector<Room> all = std::vector<Room>(rooms.size());

    void add(std::size_t room, KeptEvent event, bool isEarlier) {
        Room& at = all[room];
        (isEarlier ? at.earlier : at.own).push_back(std::move(event));
        while (at.earlier.size() + at.own.size() > 1 &&
               (at.earlier.size() + at.own.size() > most[room] ||
                at.bytes() > most[room] * EventMemory::bytesOfEntry)) {
            const auto [where, place] = next(at);
            at.dropped = std::max(at.dropped, (*where)[place].wallClock);
            where->erase(where->begin() + static_cast<std::ptrdiff_t>(place));
        }
    }
    // The one that goes.
    static std::pair<std::vector<KeptEvent>*, std::size_t> next(Room& at) {
        for (auto* events : {&at.earlier, &at.own}) {
            const std::size_t all = events->size() - (events == &at.own && !at.own.empty() ? 1 : 0);
            for (std::size_t i = 0; i < all; ++i) {
                if (at.bytes((*events)[i].text) > at.bytes() / 4) return {events, i};
            }
        }
        return {at.earlier.empty() ? &at.own : &at.earlier, 0};
    }
    std::vector<KeptEvent> between(std::uint64_t place, std::int64_t from,
                                   std::int64_t until) const {
        std::vector<KeptEvent> found;
        for (const Room& room : all) {
            for (const auto* events : {&room.earlier, &room.own}) {
                std::ranges::copy_if(*events, std::back_inserter(found), [&](const auto& each) {
                    return each.place > place && each.wallClock >= from && each.wallClock <= until;
                });
            }
        }
        std::ranges::sort(found, {}, &KeptEvent::place);
        return found;
    }
};

TEST(EventMemory, DoesWhatASimpleModelOfItDoes) {
    std::mt19937 random{20261129};
    const auto upTo = [&](std::int64_t most) {
        return std::uniform_int_distribution<std::int64_t>{0, most}(random);
    };
    for (int round = 0; round < 20; ++round) {
        const auto entries = static_cast<std::size_t>(1 + upTo(150));
        EventMemory memory{entries};
        Model model;
        for (const std::size_t percent : {10U, 20U, 30U, 10U, 10U, 10U, 5U, 5U}) {
            model.most.push_back(std::max<std::size_t>(entries * percent / 100, 1));
        }
        std::uint64_t place = 0;
        for (int step = 0; step < 600; ++step) {
            const auto room = static_cast<std::size_t>(upTo(7));
            const auto size = static_cast<std::size_t>(upTo(9) == 0 ? 3000 : 20 * upTo(4));
            KeptEvent event = entry(room, upTo(1000), std::string(size, 't'));
            const bool isEarlier = upTo(3) == 0;
            event.place = ++place;
            model.add(room, event, isEarlier);
            ASSERT_EQ(isEarlier ? memory.recall(event) : memory.keep(event), place);
            if (step % 20 != 0) continue;
            const auto from = upTo(900), until = from + upTo(500);
            const auto after = static_cast<std::uint64_t>(upTo(step));
            EXPECT_EQ(memory.page(after, from, until).events, model.between(after, from, until));
            for (std::size_t i = 0; i < rooms.size(); ++i) {
                EXPECT_EQ(memory.since()[i], std::max<std::int64_t>(model.all[i].dropped + 1, 0));
            }
        }
        EXPECT_EQ(memory.page(0).events, model.between(0, 0, EventMemory::always));
    }
}

}  // namespace
}  // namespace cortex
