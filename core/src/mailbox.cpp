// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/mailbox.hpp"

#include "cortex/core/error.hpp"

#include "command_port.hpp"
#include "lane.hpp"
#include "lookup.hpp"

#include <algorithm>
#include <bit>
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

}  // namespace

Verdict verdictOf(Outcome outcome, const Call& call) {
    Verdict verdict{outcome, call.reason(), {}};
    if (!call.why().empty()) verdict.why.emplace(call.why());
    if (outcome == Outcome::None || outcome >= Outcome::MailboxFull) {
        verdict.outcome = Outcome::Failed;
    }
    return verdict;
}

Lane::Lane(const Shape& shape, std::vector<CommandSender::State*> handles)
    : onlyHandle_{handles.size() == 1 ? handles.front() : nullptr},
      capacity_{shape.capacity},
      requestWords_{static_cast<std::uint16_t>(shape.requestSize / 8U)},
      bits_{static_cast<std::uint8_t>(std::bit_width(std::max(shape.capacity, 1U) - 1U))},
      delayed_{shape.delayed},
      hasLong_{shape.hasLong},
      rest_{std::make_unique<Rest>(Rest{shape, std::move(handles), {}, {}, {}, {}})} {
    const auto octets =
        static_cast<std::uint32_t>(sizeof(LaneSlot)) + shape.requestSize + shape.responseSize;
    lines_ = static_cast<std::uint16_t>((octets + lineSize - 1U) / lineSize);
    const std::size_t slots = std::size_t{1} << bits_;
    rest_->whys.resize(slots);
    rest_->memory.resize(lines_ * slots);
    slots_ = rest_->memory.front().octets;
    for (std::uint64_t i = 0; i < slots; ++i) new (place(i)) LaneSlot;
    if (!hasLong_) return;
    rest_->finals.resize(capacity_ + 1U);
    rest_->finalResponses =
        std::make_unique<std::byte[]>(rest_->finals.size() * shape.responseSize);
}

void Lane::finish(const AnswerHead& answer, std::uint16_t handle, const std::byte* response,
                  std::uint32_t size) {
    const std::size_t place = finalTail_ % rest_->finals.size();
    rest_->finals[place] = {answer, handle};
    copyRecord(&rest_->finalResponses[place * rest_->shape.responseSize], response, size);
    ++finalTail_;
}

void Lane::takeFinals() {
    const std::uint64_t end = delayed_ ? latchedFinalTail_ : finalTail_;
    for (; finalTaken_ != end; ++finalTaken_) {
        const std::size_t place = finalTaken_ % rest_->finals.size();
        const Final& final = rest_->finals[place];
        handle(final.handle)
            .storeFinal(final.answer, &rest_->finalResponses[place * rest_->shape.responseSize]);
    }
}

void Lane::latch() {
    latchedTail_ = low(tail_);
    latchedHead_ = low(head_);
    latchedFinalTail_ = finalTail_;
}

CommandSender::State::State(const CommandTable& commands, std::uint32_t entry,
                            std::uint32_t edgeIndex, std::uint32_t room)
    : requestSize{commands.entries[entry].request.size},
      responseSize{commands.entries[entry].response.size},
      command{static_cast<std::uint16_t>(entry)},
      table{&commands},
      edge{edgeIndex},
      capacity{room} {
    const std::size_t words = (requestSize + responseSize) / 8U;
    if (words > smallRecords.size()) records.resize(words);
    request = reinterpret_cast<std::byte*>(records.empty() ? smallRecords.data() : records.data());
    response = request + requestSize;
    initialiseRecord(commands.entries[entry].request, request);
    initialiseRecord(commands.entries[entry].response, response);
}

void CommandSender::State::storeFinal(const AnswerHead& head, const std::byte* record) {
    answer = head;
    worded = true;
    copyRecord(response, record, responseSize);
}

Outcome CommandSender::send() {
    State& state = *state_;
    if (state.lane == nullptr) return Outcome::MailboxFull;  // before start()
    state.answer.outcome = Outcome::None;
    if (state.lane->post(state.command, state.handle, state.request, state.requestSize,
                         state.sender->thread().clock) == 0) {
        return state.sender->mailboxFull(state);
    }
    state.full = false;
    ++state.sent;
    return Outcome::None;
}

const AnswerHead& CommandSender::answer() const { return state_->answer; }
std::uint64_t CommandSender::sent() const { return state_->sent; }
std::uint64_t CommandSender::answered() const { return state_->answered; }

std::pair<void*, std::size_t> CommandSender::argumentCells(std::string_view name, Kind kind,
                                                           bool array) {
    const ItemLayout& item = parameterAt(state_.get(), name, {kind, array}, true);
    const CommandTable::Entry& entry = state_->table->entries[state_->command];
    if (entry.command == nullptr) {  // `set`: the flag of this item
        state_->request[&item - entry.request.items.data()] = std::byte{1};
    }
    return {state_->request + item.offset, item.item->length};
}

std::pair<const void*, std::size_t> CommandSender::responseCells(std::string_view name, Kind kind,
                                                                 bool array) {
    const ItemLayout& item = parameterAt(state_.get(), name, {kind, array}, false);
    return {state_->response + item.offset, item.item->length};
}

}  // namespace cortex
