// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"

#include "live.hpp"
#include "live_events.hpp"

#include <string>
#include <vector>

namespace cortex::explorer {

// One thing that was looked at: what is so, and if it should not be, what to do.
struct Diagnosis {
    enum class Level { Ok, Warning, Error };
    Level level = Level::Ok;
    std::string subject, message, remedy;
};
using Diagnoses = std::vector<Diagnosis>;

const char* name(Diagnosis::Level level);  // "ok", "warning", "error"

// They only look: nothing is changed, no limit, no lock, no file.
void examineMachine(Diagnoses& found);
void examineNetwork(int domain, Diagnoses& found);
// `arrivals` has the events of those agents.
void examineAgents(Live& live, Arrivals& arrivals, Diagnoses& found);

// The first line of a file, without blanks at its end; "" if it cannot be read.
std::string lineOf(const std::string& file);

}  // namespace cortex::explorer
