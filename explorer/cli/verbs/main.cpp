// SPDX-License-Identifier: Apache-2.0
#include "text/interrupts.hpp"
#include "verbs/program.hpp"

#include <algorithm>
#include <csignal>
#include <iostream>

int main(int count, char** values) {
    using namespace cortex::cli;
    try {
        return Program{}.run({values + 1, values + std::max(count, 1)});
    } catch (const Interrupted& interrupted) {
        std::cout.flush();
        if (!interrupted.remark.empty()) std::cerr << "cortex: " << interrupted.remark << '\n';
    }
    std::raise(Interrupts::signal());  // as if nobody had handled it
    return No;
}
