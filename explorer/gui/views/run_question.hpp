// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include "session/agent_start.hpp"

#include <QString>
#include <functional>
#include <string>

class QWidget;

namespace cortex::gui {

class Question;

// What is asked about, and how.
struct RunQuestion {
    std::string path;
    Command command;  // copies: the agent's types may go
    comms::Mirror::Arguments arguments;
    std::function<AgentStart()> owner;  // of the path just now
    std::function<QString()> whyNot;    // it cannot run now; empty: it can
    std::function<void()> yes;
};

// Asks whether a command is to run, as its type wants it; `yes` is called if the user says so while
// it can run, the path has the same owner, and `asker` is still shown. The question opens at
// `button`.
Question& askToRun(QWidget& asker, const QWidget& button, RunQuestion question);

}  // namespace cortex::gui
