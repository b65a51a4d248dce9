// SPDX-License-Identifier: Apache-2.0
// Compiled once for each mistake; the test is that the compiler says what is wrong. Without a
// mistake it compiles.
#include "cortex/core/command.hpp"

namespace cortex {

struct Handles {
    Data<double> value;
    Data<const double> seen, other;
    Data<std::int64_t> count;
    Argument<double> argument;
    Result<double> result;

    void hook(Call& call, Data<const double> given) {
#if defined(COPY_INTO_WHAT_ONLY_READS)
        seen = other;
#elif defined(BIND_WITHOUT_CONST)
        value = Data<const double>{given};
#elif defined(BIND_ANOTHER_KIND)
        count = Data<double>{value};
#elif defined(KEEP_AN_ARGUMENT)
        seen = call[argument];
#elif defined(WRITE_AN_ARGUMENT)
        call[argument] = 1;
#else
        value = other;
        value = call[argument];
        value = call[result];
        call[result] = value;
        call[result] += call[argument];
        seen = Data<const double>{given};
#endif
    }
};

}  // namespace cortex
