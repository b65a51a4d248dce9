// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/registry.hpp"
#include "cortex/core/simplex_tree.hpp"
#include "cortex/cs/cluster_cs.hpp"

#include "options.hpp"

#include <functional>
#include <string>

namespace cortex::toolkit {

// A start up to the first cycle: all simplexes are populated, nothing runs, and neither a network
// nor a device is talked to. Then `look` is called. Throws ModelError or Error where the start is
// refused, and what `look` throws.
void dryStart(const CommandLine& line, const ClassRegistry& registry, SimplexTree& tree,
              const std::function<void(cs::ClusterCS&)>& look);

// Sets the standard output aside for what a program prints about a dry start, and nothing else,
// whatever plug-ins print: from now on it is the standard error.
class OutputAside {
public:
    OutputAside();  // throws Error
    ~OutputAside();
    OutputAside(const OutputAside&) = delete;
    OutputAside& operator=(const OutputAside&) = delete;

    void write(const std::string& text) const;  // all of it; throws Error

private:
    int descriptor_;
};

}  // namespace cortex::toolkit
