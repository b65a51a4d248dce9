// SPDX-License-Identifier: Apache-2.0
#include "model_text.hpp"

namespace cortex::toolkit {

// Here, so that the program and each plug-in see one class.
HasModelText::~HasModelText() = default;

}  // namespace cortex::toolkit
