// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/cluster_cs.hpp"
#include "cortex/cs/hook_checker.hpp"

#include <string>

namespace cortex::toolkit {

// --check-hooks. The library of the hook checker stands in for malloc and its like, so it has to
// come before all others: the program starts itself anew, with it preloaded. Program's thread.
class HookCheck {
public:
    // Does not return where the program starts anew. Throws Error where it cannot be.
    HookCheck(bool wanted, char** arguments);

    void watch(cs::ClusterCS& cluster);  // before start()
    void look();                         // again and again: prints what is new
    bool printEnd();                     // true: something was found

private:
    cs::HookChecker* checker_ = nullptr;
};

}  // namespace cortex::toolkit
