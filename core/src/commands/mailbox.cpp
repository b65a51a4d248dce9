// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/mailbox.hpp"

#include "cortex/core/error.hpp"

#include "commands/command_port.hpp"
#include "commands/lane.hpp"
#include "commands/unset_arguments.hpp"
#include "tables/lookup.hpp"

#include <memory>
#include <string>
#include <utility>

namespace cortex {
namespace {

struct Shape {
    Kind kind;
    bool array;
};

const ItemLayout& parameterAt(const CommandSender::State* state, std::string_view name, Shape shape,
                              bool request) {
    if (state == nullptr) throw Error("this command sender is unbound: get it in populate()");
    const CommandTable::Entry& entry = state->table->entries[state->command];
    const RecordLayout& layout = request ? entry.request : entry.response;
    const ItemLayout* item = layout.find(name);
    const std::string what = std::string{"command '"} + std::string{entry.name} + "' has no " +
                             (request ? "request" : "response") + " parameter '";
    if (item == nullptr) {
        std::vector<std::string> valid;
        for (const ItemLayout& each : layout.items) valid.push_back(each.item->name);
        throwUnknown(what + std::string{name} + "'", name, valid);
    }
    if (item->item->kind != shape.kind || (item->item->length != 1 && !shape.array)) {
        throw Error(what + std::string{name} + (shape.array ? "' as an array of " : "' as one ") +
                    cortex::name(shape.kind) + ": it is " + shapeOf(*item->item));
    }
    return *item;
}

Outcome refuse(CommandSender::State& state, const DataItem& unset) {
    EventText why{"'"};
    why << unset.name << "' has no default and was never set";
    state.answer.reason = Reason::Range;
    state.answer.why = why;
    state.hasReason = true;
    return state.lane->sender().notSent(state, Outcome::Rejected, why.view());
}

}  // namespace

CommandSender::State::State(const CommandTable& commands, std::uint32_t entry,
                            std::uint32_t edgeIndex, std::uint32_t room)
    : command{static_cast<std::uint16_t>(entry)},
      table{&commands},
      edge{edgeIndex},
      capacity{room},
      sizes{commands.entries[entry].request.size, commands.entries[entry].response.size} {
    const std::uint32_t words = (sizes.first + sizes.second) / 8U;
    if (words > smallRecords.size()) {
        records.resize(words);
        requestWords = external;
    } else {
        requestWords = static_cast<std::uint8_t>(sizes.first / 8U);
        responseWords = static_cast<std::uint8_t>(sizes.second / 8U);
    }
    initialiseRecord(commands.entries[entry].request, request());
    initialiseRecord(commands.entries[entry].response, response());
    mayBeUnset = markUnset(commands.entries[entry], request());
}

void CommandSender::State::storeFinal(const AnswerHead& head, const std::byte* record) {
    answer = head;
    hasReason = true;
    copyRecord(response(), record, responseSize());
}

Outcome CommandSender::send() {
    State& state = boundState();
    if (state.lane == nullptr) return Outcome::MailboxFull;  // before start()
    state.answer.outcome = Outcome::None;
    CommandPort& sender = state.lane->sender();
    if (state.mayBeUnset) [[unlikely]] {
        if (const DataItem* unset = findUnset(state.table->entries[state.command], state.request()))
            return refuse(state, *unset);
        state.mayBeUnset = false;
    }
    const auto post = [&](std::uint32_t beyond) {
        return state.lane->post(state.command, state.handle, state.request(), state.requestSize(),
                                sender.thread().clock, beyond);
    };
    if (!post(0) && (state.beyond == 0 || !post(state.beyond))) {
        return sender.notSent(state, Outcome::MailboxFull, "the mailbox is full");
    }
    if (state.notSent) state.notSent = false;
    if (!state.lane->hasOneHandle()) ++state.sent;
    return Outcome::None;
}

CommandSender::State& CommandSender::boundState() const {
    if (state_ == nullptr) throw UnboundHandle{"CommandSender", this};
    return *state_;
}

const AnswerHead& CommandSender::answer() const { return boundState().answer; }

std::uint64_t CommandSender::State::sentCount() const {
    return lane != nullptr && lane->hasOneHandle() ? lane->sent() : sent;
}

std::uint64_t CommandSender::State::answeredCount() const {
    return lane != nullptr && lane->hasOneHandle() ? lane->answered() : answered;
}

std::uint64_t CommandSender::sent() const { return boundState().sentCount(); }

std::uint64_t CommandSender::answered() const { return boundState().answeredCount(); }

std::pair<void*, std::size_t> CommandSender::argumentCells(std::string_view name, Kind kind,
                                                           bool array) {
    const ItemLayout& item = parameterAt(state_.get(), name, {kind, array}, true);
    const CommandTable::Entry& entry = boundState().table->entries[state_->command];
    if (entry.command == nullptr) {  // `set`: the flag of this item
        state_->request()[&item - entry.request.items.data()] = std::byte{1};
    }
    state_->given.emplace(name);
    return {state_->request() + item.offset, item.item->length};
}

std::pair<const void*, std::size_t> CommandSender::responseCells(std::string_view name, Kind kind,
                                                                 bool array) {
    const ItemLayout& item = parameterAt(state_.get(), name, {kind, array}, false);
    return {state_->response() + item.offset, item.item->length};
}

}  // namespace cortex
