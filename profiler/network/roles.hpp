// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "child.hpp"

#include <string>
#include <vector>

#include <sched.h>

// What other processes of this program do until their standard input ends.
namespace cortex::profiler {

// An agent at 1 kHz with so many samples.
std::vector<std::string> agentWords(const std::string& name, int domain, int samples);

// An agent "sender" whose samples are linked, and bytes of bare Fast DDS of the given number in
// turn with them, in the next domain.
std::vector<std::string> senderWords(int domain, int samples, std::size_t octets);

int playAgent(const std::vector<std::string>& words);
int playSender(const std::vector<std::string>& words);

// Puts this thread, and those that it makes from then on, on the n-th CPU that it may use, as long
// as there are more than n, until the end of this object. Other than cs::OnCpu it does not look up
// which CPUs the process may use: the loop of a cluster that is made later stays there, too.
class OnCpu {
public:
    explicit OnCpu(int number);
    ~OnCpu();
    OnCpu(const OnCpu&) = delete;
    OnCpu& operator=(const OnCpu&) = delete;

private:
    cpu_set_t before_{};
};

}  // namespace cortex::profiler
