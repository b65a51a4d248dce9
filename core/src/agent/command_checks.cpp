// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"
#include "cortex/core/system_findings.hpp"

#include "base/text.hpp"
#include "commands/command_port.hpp"
#include "commands/sender_state.hpp"

namespace cortex {
namespace {

// A type says what its simplexes can do, so a class that leaves a command out is none of this type.
void checkHandlers(const Simplex& simplex, const CommandTable& table, const CommandPort* port,
                   Report& report) {
    for (std::uint32_t i = 0; i < table.entries.size(); ++i) {
        const CommandTable::Entry& entry = table.entries[i];
        const bool isBuiltIn =
            entry.command == nullptr || lifeCycleCommand(entry.name) != LifeCycle::None;
        if (isBuiltIn || (port != nullptr && port->handles(i))) continue;
        report.error(simplex.path(), finding::noHandler, simplex.place(),
                     "its type " + simplex.type().name + " has the command " +
                         inQuotes(entry.name) + ", but its class has no handler for it",
                     "register one in populate(): on<&Class::function>(\"" +
                         std::string{entry.name} + "\")");
    }
}

}  // namespace

void AgentRuntime::checkCommands(std::uint32_t simplex, Report& report) const {
    const Simplex& checked = *simplexes_[simplex];
    checkHandlers(checked, commands(simplex), ports_[simplex].get(), report);
    for (const auto& sender : senders_) {
        const Edge& edge = structure_->edges[sender->edge];
        if (edge.owner != simplex) continue;
        const CommandTable::Entry& entry = sender->table->entries[sender->command];
        for (std::size_t i = 0; entry.command != nullptr && i < entry.command->request.size();
             ++i) {
            const DataItem& parameter = entry.command->request[i];
            if (parameter.hasDefault || sender->given.contains(parameter.name)) continue;
            report.error(checked.path(), finding::argumentNotSet, checked.place(),
                         "it sends " + inQuotes(entry.name) + " to " +
                             structure_->simplexes[edge.target].path + " without " +
                             inQuotes(parameter.name) + ", which has no default",
                         "get its handle in populate(), sender.argument<…>(\"" + parameter.name +
                             "\"), and set it; or give the parameter a default");
        }
    }
}

}  // namespace cortex
