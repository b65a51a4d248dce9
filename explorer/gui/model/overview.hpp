// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/event_row.hpp"
#include "session/frame.hpp"
#include "style/shapes.hpp"

#include <QString>
#include <QStringList>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// What the first page says: of agents, of who controls what, of what was last.
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

// What is said in the place of an agent that is not there any more, where its row is kept.
QString agentIsGone(const Frame& frame, const std::string& name);

// Prefix, who holds it, of which agents, since when. What was taken at another moment is a row of
// its own.
OverviewRows controlRows(const Frame& frame);
QString controlIsGone(const Frame& frame);  // where a row is kept
// What is true of the rest: held by nobody, or not known, as its agent is silent. At most so many
// agents are named.
QString controlNote(const Frame& frame, bool held, std::size_t named);

// Time, path, what: of commands, refusals, control, losses and faults. None: it is another event,
// a jog command, or an input that is back.
std::optional<OverviewRow> lastRow(const EventRow& event);
std::string lastKey(const comms::AgentEvent& event);  // of its row

// The simplex to open for a path, a prefix or an event: itself, otherwise the first one below it.
// Empty: there is none.
std::string simplexAt(const Frame& frame, const std::string& path);

}  // namespace cortex::gui
