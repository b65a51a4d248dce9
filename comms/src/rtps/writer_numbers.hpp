// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rtps/recent_table.hpp"

#include <array>
#include <cstdint>

namespace cortex::comms::rtps {

using WriterGuid = std::array<std::uint8_t, 16>;  // prefix of the participant, id of the entity

// Judges sequence numbers by those that the same writer had before. One number too high would make
// a reader of Fast DDS skip all true samples up to it, and count through all numbers between.
//
// A number within a window above the newest passes: 4 numbers, and as many as arrive in 100 ms.
// Where datagrams are lost or overtake each other, numbers come in such steps. A greater one waits:
// it passes once another one comes near it, or the same is said again, and not where the writer
// goes on from its newest. So a true writer of which much was lost loses one datagram more. A
// single forged one has no effect, or one of 0.1 s. Numbers below pass, as the reader has them.
//
// What is higher than 100 numbers in each ms since the newest begins a run. It passes once eight
// numbers of the run came over 30 ms or more, so no true writer is dropped for ever. One thread
// at a time.
class WriterNumbers {
public:
    // Whether a sample, or the end of a range that a writer states, may have this number. `saying`
    // tells two statements of one number apart: a count of heartbeats, the number of a fragment,
    // the time of a sample or gap.
    bool admits(const WriterGuid& writer, std::int64_t number, std::uint32_t saying,
                std::int64_t now);

    // Whether a reader of Fast DDS skips what the writer says, as greater numbers came before,
    // which it did not give: for three seconds all that came were below.
    bool areSkipped(const WriterGuid& writer, std::int64_t now) const;

    // How far the reader may be moved on at once, of `first`: the numbers below are lost or not
    // relevant. Fast DDS counts through them, so a great step is taken in several.
    std::int64_t stepTo(const WriterGuid& writer, std::int64_t first);

private:
    // Numbers above the newest that wait, each not far from the one before.
    struct Run {
        std::int64_t last = 0;  // that came
        std::int64_t begun = 0, met = 0;
        std::uint32_t saying = 0;  // of the last
        int length = 0;            // 0: there is none
    };
    struct Numbers {
        std::int64_t newest;            // that was admitted
        std::array<Run, 2> runs{};      // one of the writer, one for who forges
        std::int64_t first = 0;         // to which the reader was moved on
        int below = 0;                  // numbers far below the newest, one after another
        int arrived = 0;                // numbers other than the newest that passed
        std::int64_t since = 0;         // monotonic time, ns
        std::int64_t perSecond = 0;     // of them, measured before that
        std::int64_t reached = newest;  // the greatest that ever passed
        std::int64_t belowSince = 0, lastBelow = 0;  // time; 0: the last one was not below that
    };

    static bool pass(Numbers& numbers, std::int64_t number, std::int64_t now);
    static bool goesOn(Numbers& numbers, Run next, std::int64_t pause);
    static Run& runBefore(Numbers& numbers, const Run& next);
    static void count(Numbers& numbers, std::int64_t now);
    static std::int64_t window(const Numbers& numbers);

    RecentTable<WriterGuid, Numbers> writers_{4096};
};

}  // namespace cortex::comms::rtps
