// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/error.hpp"
#include "cortex/core/registry.hpp"
#include "cortex/cs/testing.hpp"
#include "cortex/toolkit/classes.hpp"

#include <chrono>
#include <string>
#include <vector>

namespace cortex::toolkit::test {

// A few simplexes of the shipped types, and axes with all limits, at 1 kHz unless told otherwise.
class Rig : public cs::TestPlant {
public:
    explicit Rig(const std::string& name = "rig",
                 std::chrono::milliseconds cycle = std::chrono::milliseconds{1})
        : TestPlant{{CORTEX_SOURCE_DIR "/ontology/cortex-morphology.xml",
                     CORTEX_SOURCE_DIR "/tests/data/ds402-types.xml",
                     CORTEX_SOURCE_DIR "/tests/data/limited-axes.xml",
                     CORTEX_SOURCE_DIR "/tests/data/process-types.xml"},
                    cycle,
                    name} {
        addClasses(classes());
    }

    std::vector<double> array(const std::string& path, const std::string& item) {
        return std::get<std::vector<double>>(cluster().image().value(path, item));
    }
};

}  // namespace cortex::toolkit::test
