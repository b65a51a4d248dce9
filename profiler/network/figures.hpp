// SPDX-License-Identifier: Apache-2.0
#pragma once

// The parts of the table; each starts and ends what it measures, in this domain and the next.
namespace cortex::network {

struct Options {
    int seconds = 2;  // of each measurement
    int domain = 1;
    bool alone = false;  // on a loopback interface of its own
};

void loopCost(const Options& options);
void latency(const Options& options);
void discovery(const Options& options);
void wire(const Options& options);
void footprint(const Options& options);

}  // namespace cortex::network
