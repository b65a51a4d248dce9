// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

// What the kernel says of this machine. `root` is the folder in which its proc and sys stand.
namespace cortex {

// The first line of a file, without blanks at its end; "" if it cannot be read.
std::string firstLineOf(const std::filesystem::path& file);

// CPUs as the kernel lists them: "2-3,6". What is no number ends the list.
std::vector<int> cpusOf(const std::string& list);

bool hasWord(const std::string& text, const std::string& word);

// How far a thread can interrupt the kernel: "PREEMPT_RT", "full", "lazy", "voluntary" or "none";
// "" where the kernel does not say.
std::string preemption(const std::filesystem::path& root = "/");

bool isVirtualMachine(const std::filesystem::path& root = "/");

}  // namespace cortex
