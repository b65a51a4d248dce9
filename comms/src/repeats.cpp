// SPDX-License-Identifier: Apache-2.0
#include "repeats.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <string_view>

#include <fastrtps/utils/IPLocator.h>

namespace cortex::comms {
namespace {

// RTPS 2.2, 9.3 and 9.4.
constexpr std::size_t prefixInHeader = 8, messageHeader = 20, submessageHeader = 4;
constexpr std::uint8_t acknack = 0x06, heartbeat = 0x07, infoTimestamp = 0x09;
constexpr std::uint8_t infoDestination = 0x0e, data = 0x15;
constexpr std::uint8_t littleEndianFlag = 0x01;
constexpr std::uint8_t ofVendor = 0x80;  // Fast DDS ends each datagram with its count of them
constexpr std::uint32_t participants = 0x000100c2, publications = 0x000003c2;
constexpr std::uint32_t subscriptions = 0x000004c2;

constexpr int firstAnnouncements = 5;  // to all, a tenth of a second after another
constexpr std::size_t mostAddresses = 10'000;

// One of a datagram; what lies beyond its end reads as 0.
struct Submessage {
    Repeats::Datagram octets;  // and all that follow

    std::uint8_t at(std::size_t i) const { return i < octets.size() ? octets[i] : 0; }
    std::uint8_t kind() const { return at(0); }
    std::uint32_t number(std::size_t i) const {
        std::uint32_t value = 0;
        const bool little = (at(1) & littleEndianFlag) != 0;
        for (std::size_t k = 0; k < 4; ++k) value = value << 8 | at(little ? i + 3 - k : i + k);
        return value;
    }
    std::int64_t sequence(std::size_t i) const {
        return static_cast<std::int64_t>(std::uint64_t{number(i)} << 32 | number(i + 4));
    }
    std::uint32_t entity(std::size_t i) const {
        return std::uint32_t{at(i)} << 24 | std::uint32_t{at(i + 1)} << 16 |
               std::uint32_t{at(i + 2)} << 8 | at(i + 3);
    }
    std::size_t size() const {
        const bool little = (at(1) & littleEndianFlag) != 0;
        const std::size_t length = little ? at(2) + 256U * at(3) : at(3) + 256U * at(2);
        const std::size_t all = submessageHeader + length;
        return length == 0 || all > octets.size() ? octets.size() : all;
    }
    std::optional<Submessage> next() const {
        if (size() == octets.size()) return std::nullopt;
        return Submessage{octets.subspan(size())};
    }
};

std::optional<Submessage> firstOf(Repeats::Datagram datagram) {
    if (datagram.size() <= messageHeader) return std::nullopt;
    return Submessage{datagram.subspan(messageHeader)};
}

// Of DATA 12 octets after its beginning, of HEARTBEAT and ACKNACK 8.
std::uint32_t writerOf(const Submessage& each) { return each.entity(each.kind() == data ? 12 : 8); }

std::optional<Submessage> withoutInfo(Repeats::Datagram datagram) {
    auto each = firstOf(datagram);
    while (each && (each->kind() == infoTimestamp || each->kind() == infoDestination)) {
        each = each->next();
    }
    return each;
}

Repeats::Prefix prefixAt(Repeats::Datagram octets) {
    Repeats::Prefix prefix;
    std::copy_n(octets.begin(), Repeats::Prefix::size, prefix.value);
    return prefix;
}

}  // namespace

bool Repeats::concerns(Datagram sent) {
    const auto each = withoutInfo(sent);
    if (!each) return false;
    const std::uint32_t writer = writerOf(*each);
    if (each->kind() == data) return writer == participants;
    if (each->kind() != heartbeat) return false;
    const auto next = each->next();
    return (writer == publications || writer == subscriptions) &&
           (!next || next->kind() >= ofVendor);
}

bool Repeats::needless(Datagram sent, const void* socket, const Locator& to,
                       Clock::time_point now) {
    const auto each = withoutInfo(sent);
    if (each->kind() == data) {
        return announcedEnough(each->octets.first(each->size()), socket, to, now);
    }
    const std::lock_guard lock{mutex_};
    const auto who = livesAt_.find(to);
    if (who == livesAt_.end()) return false;
    const Has& has = has_.at(who->second);
    return each->sequence(20) <
           (writerOf(*each) == publications ? has.publications : has.subscriptions);
}

bool Repeats::announcedEnough(Datagram submessage, const void* socket, const Locator& to,
                              Clock::time_point now) {
    const bool toAll = eprosima::fastrtps::rtps::IPLocator::isMulticast(to);
    const std::size_t content = std::hash<std::string_view>{}(
        {reinterpret_cast<const char*>(submessage.data()), submessage.size()});
    const std::lock_guard lock{mutex_};
    if (announced_.size() >= mostAddresses) announced_.clear();
    Announced& last = announced_.try_emplace({to, socket}, Announced{content, now}).first->second;
    if (last.content != content) last = {content, now};
    last.paidUntil = std::max(last.paidUntil, now);
    if (last.paidUntil > now + ((toAll ? firstAnnouncements : atOnce) - 1) * interval_) return true;
    last.paidUntil += interval_;
    return false;
}

void Repeats::heard(Datagram received) {
    std::optional<Prefix> to;
    for (auto each = firstOf(received); each; each = each->next()) {
        if (each->kind() == infoDestination) {
            if (each->octets.size() < submessageHeader + Prefix::size) return;
            to = prefixAt(each->octets.subspan(submessageHeader));
        }
        if (each->kind() != acknack || to != ours_) continue;
        const std::uint32_t writer = writerOf(*each);
        if (writer != publications && writer != subscriptions) continue;
        const std::int64_t next = each->number(20) == 0 ? each->sequence(12) : 0;  // or lacks some
        const std::lock_guard lock{mutex_};
        const auto has = has_.find(prefixAt(received.subspan(prefixInHeader)));
        if (has == has_.end()) continue;
        (writer == publications ? has->second.publications : has->second.subscriptions) = next;
    }
}

void Repeats::newcomer(const Prefix& who, const Locator& at) {
    const std::lock_guard lock{mutex_};
    has_[who] = {};
    livesAt_[at] = who;
    const auto begin = announced_.lower_bound({at, nullptr});
    announced_.erase(begin, std::find_if(begin, announced_.end(),
                                         [&](const auto& each) { return each.first.first != at; }));
}

void Repeats::gone(const Prefix& who) {
    const std::lock_guard lock{mutex_};
    has_.erase(who);
    std::erase_if(livesAt_, [&](const auto& each) { return each.second == who; });
}

}  // namespace cortex::comms
