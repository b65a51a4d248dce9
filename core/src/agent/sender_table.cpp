// SPDX-License-Identifier: Apache-2.0
#include "agent/sender_table.hpp"

#include <algorithm>

namespace cortex {

void SenderRecord::acknowledge(std::uint64_t below) {
    if (below <= answeredBelow) return;
    for (KeptOutcome& outcome : window) {
        if (outcome.sequence < below) outcome.stage = KeptOutcome::Stage::Empty;
    }
    answeredBelow = below;
    goOn(below);
}

void SenderRecord::goOn(std::uint64_t from) {
    next = std::max(next, from);
    while (kept(next).sequence == next) ++next;
}

void SenderRecord::insert(OutsideEntry& entry) {
    OutsideEntry** place = &waiting;
    while (*place != nullptr && (*place)->sequence < entry.sequence) place = &(*place)->next;
    entry.next = *place;
    *place = &entry;
    ++onTheirWay;
}

OutsideEntry& SenderRecord::takeFirst() {
    OutsideEntry& first = *waiting;
    waiting = first.next;
    return first;
}

void SenderRecord::refuse(std::int64_t epoch, std::uint64_t sequence) {
    if (epoch < refusedEpoch) return;
    if (epoch != refusedEpoch) refusedBelow = 1;
    refusedEpoch = epoch;
    refusedBelow = std::max(refusedBelow, sequence + 1);
}

SenderTable::SenderTable(std::uint32_t senders, std::uint32_t maxResponse)
    : records_(senders), responses_(std::size_t{senders} * senderWindow * maxResponse) {
    std::byte* response = responses_.data();
    for (SenderRecord& record : records_) {
        record.window.resize(senderWindow);
        for (KeptOutcome& outcome : record.window) {
            outcome.response = response;
            response += maxResponse;
        }
    }
}

SenderTable::Found SenderTable::find(std::uint32_t interface, const Sender& sender,
                                     std::int64_t cycle, std::uint32_t& record, Sender& before) {
    SenderRecord* free = nullptr;
    for (record = 0; record < records_.size(); ++record) {
        SenderRecord& each = records_[record];
        if (each.used && each.interface == interface && each.sender.name == sender.name) {
            if (each.sender.epoch == sender.epoch) {
                each.sender.host = sender.host;  // which names nobody
                return Found::Known;
            }
            const bool isOlder = each.sender.epoch > sender.epoch;
            if (isOlder && !each.isOver(cycle)) return Found::Older;
            before = each.sender;
            adopt(each, interface, sender);
            each.unsure = each.unsure || isOlder;
            if (each.refusedEpoch == sender.epoch) each.acknowledge(each.refusedBelow);
            return Found::Restarted;
        }
        if (!each.used || each.isOver(cycle)) {
            if (free == nullptr || (free->used && !each.used)) free = &each;
        }
    }
    if (free == nullptr) return Found::NoRoom;
    forgot_ = forgot_ || free->used;
    adopt(*free, interface, sender);
    free->lastNotAfter = 0;
    free->refusedEpoch = 0;
    free->refusedBelow = 1;
    free->unsure = forgot_;
    record = static_cast<std::uint32_t>(free - records_.data());
    return Found::New;
}

SenderRecord* SenderTable::known(std::uint32_t interface, const Sender& sender) {
    const auto found = std::ranges::find_if(records_, [&](const SenderRecord& each) {
        return each.used && each.interface == interface && each.sender == sender;
    });
    return found != records_.end() ? &*found : nullptr;
}

// `lastNotAfter` stays that of all starts: a copy of an earlier start's command that has run must
// be past its time before that start can count again.
void SenderTable::adopt(SenderRecord& record, std::uint32_t interface, const Sender& sender) {
    record.interface = interface;
    record.sender = sender;
    record.answeredBelow = 1;
    record.next = 1;
    record.newest = 0;
    record.onTheirWay = 0;
    record.used = true;
    for (KeptOutcome& outcome : record.window) {
        outcome.stage = KeptOutcome::Stage::Empty;
        outcome.sequence = 0;
        outcome.began = false;
    }
}

}  // namespace cortex
