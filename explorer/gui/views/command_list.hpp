// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/commands.hpp"

#include <QScrollArea>
#include <vector>

namespace cortex::gui {

class CommandCard;

// The commands of a simplex, one form each, below one another.
class CommandList : public QScrollArea {
    Q_OBJECT
public:
    explicit CommandList(Commands& commands, QWidget* parent = nullptr);
    void show(const Frame& frame, Place place);  // forms that stay keep what was entered
    void refresh(const Frame& frame, Place place);

private:
    Commands& commands_;
    std::string path_;
    std::vector<Command> shown_;
    std::vector<CommandCard*> cards_;
};

}  // namespace cortex::gui
