// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/lease_client.hpp"

#include <string>
#include <vector>

namespace cortex::cli {

using Asked = comms::LeaseClient::Asked;

// "desk.4711-5e1f0a" stands behind the @ in the name of a tool. Where a person has such a name, the
// word means the tool alone.
bool isNameOfTool(const std::string& name);
// The word that names one who asks behind 'grant' and 'refuse': the person where that is clear,
// otherwise the tool.
std::string wordFor(const Asked& asked, const std::vector<Asked>& all);
// Those that are meant by a tool's whole name or, if no tool is called so, by that of a person.
std::vector<Asked> meantBy(const std::string& name, const std::vector<Asked>& all);

// Says once that somebody asks for control of ours, and once that he does no more.
class AskNews {
public:
    std::vector<std::string> news(const comms::LeaseClient& leases);
    void answered(const Asked& asked);  // by us: there is no more to say of it

private:
    std::vector<Asked> told_;
};

}  // namespace cortex::cli
