// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace cortex::toolkit {

// A simplex whose computation another program can load too, as text: `cortex-agent --dump-mjcf`
// finds it by this base. Setup phase.
class HasModelText {
public:
    virtual ~HasModelText();

    // Valid once the simplex is populated.
    virtual std::string modelText() const = 0;
};

}  // namespace cortex::toolkit
