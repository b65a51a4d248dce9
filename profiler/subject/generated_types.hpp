// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include "subject.hpp"

namespace cortex::profiler {

enum class Content { Nothing, Data, Relationships, Commands };

// 25 simplexes with so many floats, relationships or commands each, of a type that is written to a
// file and read from it. What relationships lead to stands beside them, 100 of it at any number.
struct Loaded {
    static constexpr int simplexes = 25, most = 100;
    static SimplexTree tree(Content content, int each);
};

}  // namespace cortex::profiler
