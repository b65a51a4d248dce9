// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/mailbox.hpp"

#include "cortex/core/error.hpp"

#include "commands/command_port.hpp"
#include "commands/lane.hpp"
#include "tables/lookup.hpp"

#include <algorithm>
#include <bit>
#include <memory>
#include <new>
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

std::uint32_t slotsOf(const Lane::Shape& shape) {
    return std::bit_ceil(std::max(shape.capacity, 1U));
}

std::size_t linesOfSlot(const Lane::Shape& shape) {
    const std::size_t octets = sizeof(LaneSlot) + shape.requestSize + shape.responseSize;
    return (octets + Lane::lineSize - 1) / Lane::lineSize;
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
    : capacity_{shape.capacity},
      onlyHandle_{handles.size() == 1 ? handles.front() : nullptr},
      lines_{static_cast<std::uint16_t>(linesOfSlot(shape))},
      requestWords_{static_cast<std::uint16_t>(shape.requestSize / 8U)},
      bits_{static_cast<std::uint8_t>(std::bit_width(slotsOf(shape)) - 1)},
      delayed_{shape.delayed},
      hasLong_{shape.hasLong},
      finals_{shape.hasLong ? std::make_unique<FinalAnswers>(shape.capacity, shape.responseSize,
                                                             shape.delayed)
                            : nullptr},
      rest_{std::make_unique<Rest>(Rest{shape, std::move(handles), {}})} {
    rest_->reasons.resize(slotsOf(shape));
    for (std::uint32_t i = 0; i < slotsOf(shape); ++i) new (place(i)) LaneSlot;
}

std::size_t Lane::octets(const Shape& shape) {
    return sizeof(Lane) + slotsOf(shape) * linesOfSlot(shape) * lineSize;
}

LaneBlock::LaneBlock(std::vector<Plan> plans) {
    std::size_t octets = 0;
    for (const Plan& plan : plans) octets += Lane::octets(plan.shape);
    memory_.resize(octets / Lane::lineSize);
    std::byte* place = memory_.empty() ? nullptr : memory_.front().octets;
    for (Plan& plan : plans) {
        const std::vector<CommandSender::State*> handles = plan.handles;
        lanes_.push_back(new (place) Lane{plan.shape, std::move(plan.handles)});
        for (CommandSender::State* handle : handles) handle->lane = lanes_.back();
        place += Lane::octets(plan.shape);
    }
}

LaneBlock::~LaneBlock() {
    for (Lane* lane : lanes_) std::destroy_at(lane);
}

void Lane::takeFinals(std::int64_t cycle) {
    finals_->take(cycle, taken_,
                  [this](std::uint16_t index, const AnswerHead& answer, const std::byte* response) {
                      handle(index).storeFinal(answer, response);
                  });
}

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
}

void CommandSender::State::storeFinal(const AnswerHead& head, const std::byte* record) {
    answer = head;
    hasReason = true;
    copyRecord(response(), record, responseSize());
}

Outcome CommandSender::send() {
    State& state = *state_;
    if (state.lane == nullptr) return Outcome::MailboxFull;  // before start()
    state.answer.outcome = Outcome::None;
    CommandPort& sender = state.lane->sender();
    if (!state.lane->post(state.command, state.handle, state.request(), state.requestSize(),
                          sender.thread().clock)) {
        return sender.mailboxFull(state);
    }
    if (state.full) state.full = false;
    if (!state.lane->hasOneHandle()) ++state.sent;
    return Outcome::None;
}

const AnswerHead& CommandSender::answer() const { return state_->answer; }

std::uint64_t CommandSender::State::sentCount() const {
    return lane != nullptr && lane->hasOneHandle() ? lane->sent() : sent;
}

std::uint64_t CommandSender::State::answeredCount() const {
    return lane != nullptr && lane->hasOneHandle() ? lane->answered() : answered;
}

std::uint64_t CommandSender::sent() const { return state_->sentCount(); }

std::uint64_t CommandSender::answered() const { return state_->answeredCount(); }

std::pair<void*, std::size_t> CommandSender::argumentCells(std::string_view name, Kind kind,
                                                           bool array) {
    const ItemLayout& item = parameterAt(state_.get(), name, {kind, array}, true);
    const CommandTable::Entry& entry = state_->table->entries[state_->command];
    if (entry.command == nullptr) {  // `set`: the flag of this item
        state_->request()[&item - entry.request.items.data()] = std::byte{1};
    }
    return {state_->request() + item.offset, item.item->length};
}

std::pair<const void*, std::size_t> CommandSender::responseCells(std::string_view name, Kind kind,
                                                                 bool array) {
    const ItemLayout& item = parameterAt(state_.get(), name, {kind, array}, false);
    return {state_->response() + item.offset, item.item->length};
}

}  // namespace cortex
