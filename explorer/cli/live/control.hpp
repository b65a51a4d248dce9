// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command.hpp"

#include "live/live.hpp"

#include <optional>
#include <set>
#include <string>

// Control of parts of the plant: who may command them.
namespace cortex::cli {

// Takes the lease on a prefix from every agent with something at or below it, or from none. Throws
// Failure that names the holder and says what to do.
void takeControl(Live& live, const std::string& prefix);
// The agents that have something at or below the prefix; throws Failure if there is none.
std::set<std::string> agentsBelow(Live& live, const std::string& prefix);
void releaseControl(Live& live, const std::string& prefix);
void handOverControl(Live& live, const std::string& prefix, const std::string& to);

// What must be controlled for a command: its simplex, or what its prefix names. None: it is free.
std::optional<std::string> controlledBy(const FoundSimplex& simplex,
                                        const CommandTable::Entry& command,
                                        const comms::Mirror::Arguments& arguments);

// Whether control, which somebody else has or nobody, is what a command lacks.
bool lacksControl(const comms::CommandAnswer& answer);
// What to do about a command that was refused for want of control or of a right, a line; or "".
std::string authorityHint(const comms::CommandAnswer& answer);

// Control for the time of one verb, unless the session has it anyway.
class BriefControl {
public:
    BriefControl(Live& live, const std::string& agent, const std::string& prefix);
    ~BriefControl();
    BriefControl(const BriefControl&) = delete;
    BriefControl& operator=(const BriefControl&) = delete;

private:
    comms::LeaseClient& leases_;
    std::string agent_, prefix_;
    bool taken_ = false;
};

}  // namespace cortex::cli
