// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include <functional>
#include <string>

class QWidget;

namespace cortex::gui {

// Asks whether a command is to run, as its type wants it; `yes` is called if the user says so and
// `asker` is still there.
void askToRun(QWidget* asker, const std::string& path, const Command& command,
              const comms::Mirror::Arguments& arguments, std::function<void()> yes);

}  // namespace cortex::gui
