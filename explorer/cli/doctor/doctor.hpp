// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"

#include "doctor/diagnosis.hpp"
#include "live/live.hpp"
#include "live/live_events.hpp"

namespace cortex::cli {

const char* name(Diagnosis::Level level);  // "ok", "warning", "error"

// They only look: nothing is changed, no limit, no lock, no file.
void examineMachine(Diagnoses& found);
void examineLibm(Diagnoses& found);  // which code the mathematical functions use on this CPU
void examineNetwork(int domain, Diagnoses& found);
// `arrivals` has the events of those agents.
void examineAgents(Live& live, Arrivals& arrivals, Diagnoses& found);

}  // namespace cortex::cli
