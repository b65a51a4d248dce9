// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include <QString>

// What is seen or done in the window as a line for a POSIX shell.
namespace cortex::gui {

// "cortex call /control/pose moveTo speedShare=0.25", with the options of the domain where they
// differ from the defaults.
QString shellText(const comms::NetworkOptions& network, const char* verb, const std::string& path,
                  const std::string& command = {}, const comms::Mirror::Arguments& arguments = {});

}  // namespace cortex::gui
