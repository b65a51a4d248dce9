// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/options.hpp"

namespace cortex::gui {

class MainWindow;

// Runs the window for a while once everything has come, and writes as JSON what a frame costs its
// thread, and what memory the program takes. Returns the exit code of the program.
int measure(MainWindow& window, const Options& options);

}  // namespace cortex::gui
