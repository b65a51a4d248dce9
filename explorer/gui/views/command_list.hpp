// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/commands.hpp"

#include <QScrollArea>
#include <map>
#include <string>
#include <vector>

namespace cortex::gui {

class CommandCard;

// The commands of a simplex, one form each, below one another.
class CommandList : public QScrollArea {
    Q_OBJECT
public:
    explicit CommandList(Commands& commands, QWidget* parent = nullptr);
    // Forms that come back have what was entered, and are scrolled as they were.
    void show(const Frame& frame, Place place);
    void refresh(const Frame& frame, Place place);
    // Puts the keyboard in the form of this command and scrolls to it; false: there is none.
    bool choose(const std::string& command);

private:
    Commands& commands_;
    std::string path_;
    std::vector<Command> shown_;
    std::vector<CommandCard*> cards_;
    std::map<std::string, int> scrolled_;  // by path: how far
};

}  // namespace cortex::gui
