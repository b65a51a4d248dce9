// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace cortex::explorer {

class MainWindow;

// Writes a picture of the window once everything has come, or after `limit` seconds, and says which
// of the two it was. Returns the exit code of the program: 1 where the file cannot be written.
int writeScreenshot(MainWindow& window, const std::string& file, double limit);

}  // namespace cortex::explorer
