// SPDX-License-Identifier: Apache-2.0
#include "tasks/refused_exit.hpp"

#include <mutex>
#include <utility>

namespace cortex::cs {
namespace {

std::mutex refusalMutex;
std::string firstRefused;

}  // namespace

std::string refusedExitText() {
    const std::lock_guard lock{refusalMutex};
    return firstRefused;
}

bool noteRefusedExit(std::string text) {
    const std::lock_guard lock{refusalMutex};
    if (!firstRefused.empty()) return false;
    firstRefused = std::move(text);
    return true;
}

}  // namespace cortex::cs
