// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "child.hpp"

#include <string>
#include <vector>

// What other processes of this program do until their standard input ends. Domain -1: no network.
namespace cortex::network {

using profiler::Child;
using profiler::inputEnds;

// An agent at 1 kHz that links so many samples of another. Says when it began to join, by
// steadyNow(), and "linked" as soon as all their values are there.
struct AgentRole {
    std::string name;
    int domain = 0, samples = 0;
    std::string owner = "-";
    int links = 0;
};
std::vector<std::string> wordsOf(const AgentRole& role);

// An agent "sender" whose samples are linked, and octets of bare Fast DDS of the given number in
// turn with them, in the next domain.
std::vector<std::string> senderWords(int domain, int samples, std::size_t octets);

// A tool that looks at everything at a rate, 0 for every cycle. Says "ready" when values are there.
std::vector<std::string> viewerWords(const std::string& name, int domain, int rate);

// A bare participant that writes nothing. Says when it began to join.
std::vector<std::string> bareWords(int domain);

// For main(): plays the role of these words.
int playRole(const std::vector<std::string>& words);

}  // namespace cortex::network
