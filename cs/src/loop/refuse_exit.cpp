// SPDX-License-Identifier: Apache-2.0
#include "cortex/cs/cluster_cs.hpp"

#include "loop/stop_guard.hpp"
#include "tasks/crash_report.hpp"
#include "tasks/refused_exit.hpp"

#include <string>
#include <string_view>

#include <unistd.h>

namespace cortex::cs {
namespace {

constexpr int codeOfRefusedExit = 3;

// False: no plug-in called. A library that is being loaded is not known as a plug-in yet.
bool tellExit(int code, bool nothingRuns) {
    const char* const plugin = pluginOfThread();
    const std::string place = placeOfThread();
    if (plugin == nullptr && !place.starts_with("loading the plug-in ")) return false;
    const std::string call = "exit(" + std::to_string(code) + ")";
    const std::string text =
        (plugin != nullptr ? "plug-in " + std::string{plugin} + " called " + call
                           : call + " was called") +
        " in " + place;
    if (!noteRefusedExit(text)) return true;
    const std::string line = text + (nothingRuns ? "" : "; all is shut down first") +
                             "; the process ends with exit code " +
                             std::to_string(codeOfRefusedExit) + "\n";
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
    return true;
}

}  // namespace

// Nothing can be thrown: whoever calls exit() was compiled in the belief that it throws nothing.
// The jump passes over frames of the plug-in, and none of ours that has something to destroy.
void refuseExit(int code) {
    const bool nothingRuns = getpid() == gettid() && !isLoopThread();
    if (!tellExit(code, nothingRuns)) return;
    if (nothingRuns) _exit(codeOfRefusedExit);
    StopGuard::get().ask();
    if (Escape* const escape = escapeOfThread()) _longjmp(escape->place, 1);
    for (;;) pause();  // a thread of the plug-in: it ends with the process
}

bool exitWasRefused() { return !refusedExitText().empty(); }

}  // namespace cortex::cs
