// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

// What this program does besides testing, told by its arguments: hosts and stations that are to be
// cut off or killed are processes of their own.
namespace cortex::test {

void runRobot(int file, const std::string& peer, const std::string& security);
[[noreturn]] void runStation(const std::string& domain);

}  // namespace cortex::test
