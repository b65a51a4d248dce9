// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/program_interface.hpp"
#include "cortex/core/transport.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace cortex {

// An in-process network: interfaces made from one hub find each other, link simplexes by path and
// carry commands, like agents on a real one. For tests, and for two clusters in one process.
class LoopbackHub {
public:
    LoopbackHub();
    ~LoopbackHub();

    // One per agent. The hub must outlive the agents.
    std::unique_ptr<CommunicationInterface> makeInterface();
    // Cuts or joins one agent's connection: what others linked from it is lost, and back.
    void setConnected(const std::string& agent, bool connected);
    // Between cycles: carries the commands of agents to each other, and the answers back.
    void carry();
    // A command to another agent's simplex, as a tool sends it. Throws Error if no agent has it.
    std::uint64_t post(const std::string& sender, std::string_view path, std::string_view command,
                       const ProgramInterface::Arguments& arguments, std::int64_t budgetCycles);
    bool poll(const std::string& sender, std::uint64_t sequence, CallResult& result);

    struct Implementation;

private:
    std::shared_ptr<Implementation> implementation_;
};

}  // namespace cortex
