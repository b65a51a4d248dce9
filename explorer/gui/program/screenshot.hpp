// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/options.hpp"

namespace cortex::gui {

class MainWindow;
class Session;

// Writes a picture of the window once everything has come, or after the timeout, and says which of
// the two it was. Returns the exit code of the program: 1 where the file cannot be written, 3 where
// nobody is heard, or nobody has a path that was named.
int writeScreenshot(MainWindow& window, const Session& session, const Options& options);

}  // namespace cortex::gui
