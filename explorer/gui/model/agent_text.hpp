// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <QString>
#include <QStringList>

// Agents in words.
namespace cortex::gui {

QString rateText(const comms::AgentStatus& agent);  // "100 Hz", "9.1 of 100 Hz"
// "overloaded: 9.1 of 100 Hz"; empty: it is not. The judgement lags behind the rate by a second.
QString overloadText(const comms::AgentStatus& agent);
QString stateWord(const comms::AgentStatus& agent);  // "running", "ended"
QString cameText(const comms::AgentStatus& agent);   // "37 of 44", of types and simplexes
// "overloaded: 46 of 200 Hz; 437 ticks missed since its start"; empty: it is not.
QString missedText(const AgentFrame& agent);
QString missedTicksText(const AgentFrame& agent);  // the second half of that alone
// Where it stands in the order of the worst first.
int troubleRank(const AgentFrame& agent);
// Everything else that is wrong with it, the worst first.
QStringList troublesOf(const comms::AgentStatus& agent);

}  // namespace cortex::gui
