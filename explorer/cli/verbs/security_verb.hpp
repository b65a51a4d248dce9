// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "text/output.hpp"

#include <string>
#include <vector>

namespace cortex::cli {

struct SecurityOptions {
    std::string folder;  // to make, or to show
    std::string authority = "authority";
    std::string agent;
    std::vector<std::string> mayCommand;  // none: everything
    std::vector<std::string> owns;        // none: what it has first
    bool readOnly = false;
    std::vector<int> domains;
    int days = 0;  // 0: as usual
    bool json = false;
};

Exit makeAuthority(const SecurityOptions& options);
Exit makeAgent(const SecurityOptions& options);
Exit showSecurity(const SecurityOptions& options);

}  // namespace cortex::cli
