// SPDX-License-Identifier: Apache-2.0
#include "common/kind_meaning.hpp"

#include "cortex/core/event.hpp"

namespace cortex::common {

namespace {

std::string_view meaningOf(EventKind kind) {
    switch (kind) {
        case EventKind::StateChange:
            return "A simplex went from one state to another, such as Standby to Active.";
        case EventKind::Fault:
            return "A simplex went to Fault, and why.";
        case EventKind::Refusal:
            return "A command was refused, and why.";
        case EventKind::Overflow:
            return "The loop of an agent did not keep its time: a cycle was late or missed.";
        case EventKind::Limit:
            return "A value was beyond its limits. A demand was cut to them.";
        case EventKind::Conflict:
            return "Several wrote one demand at once, and the values of one of them were taken.";
        case EventKind::Agent:
            return "What an agent reads from another one is linked, is missing, or does not fit.";
        case EventKind::Command:
            return "A command was executed: who sent it, and what came of it.";
        case EventKind::Watchdog:
            return "The loop of an agent stands still, and where; or it goes on.";
        case EventKind::Message:
            return "A simplex had something of its own to say.";
        case EventKind::Control:
            return "Control of a part was taken, handed over, released or lost.";
        case EventKind::Loss:
            return "An agent, an input or events were lost, or are back.";
        case EventKind::ValueChange:
            return "A value changed its state: another label or quality, or across a limit.";
    }
    return {};
}

}  // namespace

std::string_view kindMeaning(std::string_view kind) {
    const auto known = eventKindFromName(kind);
    return known ? meaningOf(*known) : std::string_view{};
}

}  // namespace cortex::common
