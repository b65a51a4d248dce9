// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/abnormal.hpp"
#include "model/event_row.hpp"
#include "model/state_times.hpp"
#include "style/shapes.hpp"

#include <QString>
#include <QStringList>
#include <optional>
#include <string>
#include <vector>

// What the first page says: of agents, of what is wrong, of who controls what, of what was last.
namespace cortex::gui {

struct OverviewRow {
    std::string key;             // by which it keeps its place
    std::string opens;           // a path; of an agent its name
    std::optional<Shape> shape;  // of its mark
    QStringList cells;
    std::string item{};     // what is wrong in the simplex
    QString whole{};        // what the tool tip of the last cell says, where that is shorter
    std::int64_t time = 0;  // of an event, UTC ns
    bool isLoss = false;    // of an event
};
using OverviewRows = std::vector<OverviewRow>;

// Name, state, rate, trouble; the worst first.
OverviewRows agentRows(const Frame& frame);

// Path, and what is wrong with it: Fault, outside of limits, lost, claimed twice. Of a lost agent
// one stands for all; of more than so many of a kind the last row says how many there are.
inline constexpr std::size_t mostWrongOfAKind = 100;
OverviewRows wrongRows(const Frame& frame, const Abnormal& abnormal, const StateTimes& times);
// "1 in Fault, 2 outside limits, 34 lost, 5 claimed twice"; empty: nothing is wrong.
QString wrongCount(const Frame& frame, const Abnormal& abnormal);

// Prefix, who holds it, of which agents, since when.
OverviewRows controlRows(const Frame& frame);
// What is true of the rest: held by nobody, or not known, as its agent is silent.
QString controlNote(const Frame& frame, bool held);

// Time, path, what: of commands, refusals, control, losses and faults. None: it is another event,
// a jog command, or an input that is back.
std::optional<OverviewRow> lastRow(const EventRow& event);

// The simplex to open for a path, a prefix or an event: itself, otherwise the first one below it.
// Empty: there is none.
std::string simplexAt(const Frame& frame, const std::string& path);

}  // namespace cortex::gui
