// SPDX-License-Identifier: Apache-2.0
#include "rtps/fragments.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace cortex::comms::rtps {
namespace {

constexpr std::size_t ofEach = 64;  // bytes that a message takes beside its content

std::uint32_t fragmentsOf(const Fragment& fragment) {
    return (fragment.sample + fragment.size - 1) / fragment.size;
}

}  // namespace

std::vector<Message> Fragments::add(const Fragment& fragment, Message message, std::int64_t now) {
    while (!begun_.empty() && now - begun_.front().met > patience)
        drop(begun_.begin(), incomplete_);
    const Place place = placeOf(fragment);
    Begun& begun = *place;
    begun.met = now;
    std::uint32_t added = 0;
    const std::uint32_t end = std::min(fragment.first - 1 + fragment.count, fragmentsOf(fragment));
    for (std::uint32_t i = fragment.first - 1; i < end; ++i) {
        added += begun.has[i] ? 0 : 1;
        begun.has[i] = true;
    }
    if (added == 0) return {};
    begun.missing -= added;
    const std::size_t bytes = message.size() + ofEach;
    begun.bytes += bytes;
    bytes_ += bytes;
    begun.messages.push_back(std::move(message));
    if (begun.missing > 0) {
        makeRoom(fragment.writer);
        return {};
    }
    std::vector<Message> whole = std::move(begun.messages);
    forget(place);
    // A writer that does not repeat is read in order: what it began before is over.
    for (Place each = begun_.begin(); each != begun_.end() && !fragment.comesAgain;) {
        const Place next = std::next(each);
        if (each->of.writer == fragment.writer && each->of.number < fragment.number)
            drop(each, incomplete_);
        each = next;
    }
    return whole;
}

// A sample that is said to be another one than before begins anew.
Fragments::Place Fragments::placeOf(const Fragment& fragment) {
    const auto known = std::ranges::find_if(begun_, [&](const Begun& begun) {
        return begun.of.number == fragment.number && begun.of.writer == fragment.writer;
    });
    if (known != begun_.end()) {
        if (known->of.size == fragment.size && known->of.sample == fragment.sample) {
            begun_.splice(begun_.end(), begun_, known);
            return known;
        }
        drop(known, dropped_);
    }
    const std::uint32_t count = fragmentsOf(fragment);
    Begun begun{fragment, 0, count, std::vector<bool>(count), {}, sizeof(Begun) + count / 8};
    bytes_ += begun.bytes;
    begun_.push_back(std::move(begun));
    return std::prev(begun_.end());
}

// The last one has just got something, and stays unless it alone is too much.
void Fragments::makeRoom(const WriterGuid& writer) {
    const auto isOfWriter = [&](const Begun& begun) { return begun.of.writer == writer; };
    auto ofWriter = static_cast<std::size_t>(std::ranges::count_if(begun_, isOfWriter));
    while (ofWriter > mostOfWriter || begun_.size() > most || bytes_ > mostBytes) {
        const bool hasOthers = ofWriter > 1;
        drop(hasOthers ? std::ranges::find_if(begun_, isOfWriter) : begun_.begin(), dropped_);
        if (begun_.empty()) return;
        if (hasOthers) --ofWriter;
    }
}

void Fragments::drop(Place place, std::uint64_t& count) {
    count += std::max<std::size_t>(place->messages.size(), 1);
    forget(place);
}

void Fragments::forget(Place place) {
    bytes_ -= place->bytes;
    begun_.erase(place);
}

}  // namespace cortex::comms::rtps
