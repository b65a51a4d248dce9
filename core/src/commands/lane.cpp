// SPDX-License-Identifier: Apache-2.0
#include "commands/lane.hpp"

#include "cortex/core/argument_checks.hpp"

#include "commands/lane_block.hpp"

#include <algorithm>
#include <bit>
#include <memory>
#include <new>
#include <utility>

namespace cortex {
namespace {

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
        EventText why{"its handler returned "};
        verdict.why = why << name(outcome)
                          << ", which is no answer of a handler: Done, Running, "
                             "Cancelled, call.fail() and call.reject() are";
    }
    return verdict;
}

Verdict doneVerdict(const CommandTable::Entry& entry, std::byte* response) {
    const DataItem* wrong = entry.floats.empty() ? nullptr : notFinite(entry.floats, response);
    if (wrong == nullptr) return {};
    copyRecord(response, entry.emptyResponse.data(), entry.response.size);
    return {Outcome::Failed, Reason::None,
            EventText{"its response '"} << wrong->name << "' is not a number"};
}

Lane::Lane(const Shape& shape, std::vector<CommandSender::State*> handles)
    : capacity_{shape.capacity - shape.kept},
      onlyHandle_{handles.size() == 1 ? handles.front() : nullptr},
      lines_{static_cast<std::uint16_t>(linesOfSlot(shape))},
      requestWords_{static_cast<std::uint16_t>(shape.requestSize / 8U)},
      bits_{static_cast<std::uint8_t>(std::bit_width(slotsOf(shape)) - 1)},
      delayed_{shape.delayed},
      hasLong_{shape.hasLong},
      finals_{shape.hasLong ? std::make_unique<FinalAnswers>(shape.underWay(), shape.responseSize,
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

}  // namespace cortex
