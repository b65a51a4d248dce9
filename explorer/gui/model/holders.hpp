// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <QString>
#include <QStringList>
#include <string>
#include <vector>

// Who holds control of what. A person is as told, and never a right: the name of the tool stands
// beside it, or in the tool tip. Names are plain text, and turn no text around them.
namespace cortex::gui {

// "alice (cortex-explorer@desk.4711-5e1f0a)"; of whom no person is known, the name alone.
QString wholeNameOf(const Control& control, const std::string& holder);
// "alice", where no other tool, and not this window, says the same; otherwise the tool's name.
QString shortNameOf(const Control& control, const std::string& holder);
QString ownName(const Control& control);  // whole
QString cutName(const QString& name, int letters);
QString joined(const QStringList& names);  // "alice, bob and carol"

// The others who hold a part of what lies there, by name.
std::vector<std::string> holdersAt(const Frame& frame, const std::string& prefix);
// Those of them who say who uses them: nobody else can be asked.
std::vector<std::string> canBeAsked(const Frame& frame, const std::string& prefix);
// Of a button: "Ask alice", "Ask 2 people"; empty: nobody can be asked.
QString askText(const Frame& frame, const std::string& prefix);

// The agents that have something there, have not ended, and are not controlled by us as a whole.
// All of an agent is below "/", also while it is not known yet what that is.
QStringList uncontrolled(const Frame& frame, const std::string& prefix);

// Whether somebody who is heard has something there that is not ours, and nobody else holds it.
bool canBeTaken(const Frame& frame, const std::string& prefix);
// All that have something there are heard, and show that nobody at all holds a part of it.
bool isFree(const Frame& frame, const std::string& prefix);

}  // namespace cortex::gui
