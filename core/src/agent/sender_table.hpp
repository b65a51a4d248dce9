// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/transport.hpp"

#include "commands/outside_command.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cortex {

// What is remembered of one command until its sender has the answer, so that a repeat is answered
// and not executed again.
struct KeptOutcome {
    enum class Stage : std::uint8_t { Empty, Waiting, OnItsWay, Running, Final };
    Stage stage = Stage::Empty;
    // These three stay when it is acknowledged: a command that comes late is judged by them.
    std::uint64_t sequence = 0;
    std::uint32_t simplex = noSimplex;
    bool began = false;  // it is on its way, or was and did not expire there
    std::uint32_t command = CommandTable::none;
    AnswerHead answer;
    std::uint32_t size = 0;
    std::byte* response = nullptr;
};

// One start of one sender, seen through one interface.
struct SenderRecord {
    std::uint32_t interface = 0;
    Sender sender;
    std::uint64_t answeredBelow = 1;
    std::uint64_t next = 1;           // the lowest number that neither came nor was given up
    std::uint64_t newest = 0;         // the greatest number that began
    OutsideEntry* waiting = nullptr;  // by number
    // Numbers below it of this earlier start were refused.
    std::int64_t refusedEpoch = 0;
    std::uint64_t refusedBelow = 1;
    std::int64_t lastNotAfter = 0;  // after it no repeat of its commands can be executed
    std::uint32_t onTheirWay = 0;   // those that wait included
    bool used = false;
    bool unsure = false;              // it may be a forgotten sender that comes back
    bool listed = false;              // the router knows that some may wait
    std::vector<KeptOutcome> window;  // by sequence modulo its size

    // Its commands are all over and past repeating: it may be forgotten.
    bool isOver(std::int64_t cycle) const { return onTheirWay == 0 && lastNotAfter < cycle; }
    // A sequence number stays in its place when it is acknowledged.
    bool came(std::uint64_t sequence) { return kept(sequence).sequence >= sequence; }
    KeptOutcome& kept(std::uint64_t sequence) { return window[sequence % window.size()]; }
    void acknowledge(std::uint64_t below) CORTEX_REALTIME;
    void goOn(std::uint64_t from) CORTEX_REALTIME;     // what is missing below `from` is given up
    void insert(OutsideEntry& entry) CORTEX_REALTIME;  // among those that wait
    OutsideEntry& takeFirst() CORTEX_REALTIME;         // of those that wait
    // An earlier start, which does not count now: the number stays refused when it counts.
    void refuse(std::int64_t epoch, std::uint64_t sequence) CORTEX_REALTIME;
};

// The senders that are known, bounded. Loop thread only.
class SenderTable {
public:
    SenderTable(std::uint32_t senders, std::uint32_t maxResponse);

    enum class Found : std::uint8_t { Known, New, Restarted, Older, NoRoom };
    // `Restarted`: the record, with `before` its former owner, is now that of another start; what
    // waits in it is still of the former. It is that of an earlier one only if everything of the
    // later one is over: a wrong clock, or somebody who used its name, does not lock a sender out.
    Found find(std::uint32_t interface, const Sender& sender, std::int64_t cycle,
               std::uint32_t& record, Sender& before) CORTEX_REALTIME;
    SenderRecord& operator[](std::uint32_t record) { return records_[record]; }
    // Null: it is not known.
    SenderRecord* known(std::uint32_t interface, const Sender& sender) CORTEX_REALTIME;

private:
    void adopt(SenderRecord& record, std::uint32_t interface, const Sender& sender) CORTEX_REALTIME;

    std::vector<SenderRecord> records_;
    bool forgot_ = false;  // a sender, to make room for another
    std::vector<std::byte> responses_;
};

}  // namespace cortex
