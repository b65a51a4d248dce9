// SPDX-License-Identifier: Apache-2.0
#include "dds/repeats.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
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
constexpr std::uint32_t participants = 0x000100c2;
struct Builtin {
    std::uint32_t writer, reader;
    const char* topic;
};
constexpr std::array discovery{Builtin{0x000003c2, 0x000003c7, "DCPSPublication"},
                               Builtin{0x000004c2, 0x000004c7, "DCPSSubscription"}};

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

// The reader's is before the writer's, after 8 octets of DATA, 4 of HEARTBEAT and ACKNACK.
std::uint32_t writerOf(const Submessage& each) { return each.entity(each.kind() == data ? 12 : 8); }

std::uint32_t numberOf(const Repeats::Entity& entity) {
    std::uint32_t number = 0;
    for (const std::uint8_t octet : entity.value) number = number << 8 | octet;
    return number;
}

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

Repeats::Repeats(const Prefix& ours, std::optional<Clock::duration> interval)
    : ours_{ours}, interval_{interval} {
    if (!interval_) return;
    for (const Builtin& each : discovery) writers_[each.writer] = each.topic;
}

bool Repeats::concerns(Datagram sent) {
    const auto each = withoutInfo(sent);
    if (!each) return false;
    if (each->kind() == data) return writerOf(*each) == participants;
    if (each->kind() != heartbeat) return false;
    const auto next = each->next();
    return !next || next->kind() >= ofVendor;
}

bool Repeats::needless(Datagram sent, const void* socket, const Locator& to,
                       Clock::time_point now) {
    const auto each = withoutInfo(sent);
    if (each->kind() == data) {
        return announcedEnough(each->octets.first(each->size()), socket, to, now);
    }
    const std::uint32_t writer = writerOf(*each);
    const std::int64_t last = each->sequence(20);
    const std::lock_guard lock{mutex_};
    const auto living = livesAt_.find(to);
    if (living == livesAt_.end() || !writers_.contains(writer)) return false;
    return std::ranges::all_of(
        living->second, [&](const Prefix& who) { return others_.at(who).has(writer, last); });
}

bool Repeats::Other::has(EntityNumber writer, std::int64_t last) const {
    for (auto each = next.lower_bound({writer, 0}); each != next.end(); ++each) {
        if (each->first.first != writer) break;
        if (each->second <= last) return false;
    }
    return true;
}

bool Repeats::announcedEnough(Datagram submessage, const void* socket, const Locator& to,
                              Clock::time_point now) {
    if (!interval_) return false;
    const bool toAll = eprosima::fastrtps::rtps::IPLocator::isMulticast(to);
    const std::size_t content = std::hash<std::string_view>{}(
        {reinterpret_cast<const char*>(submessage.data()), submessage.size()});
    const std::lock_guard lock{mutex_};
    if (announced_.size() >= mostAddresses) announced_.clear();
    Announced& last = announced_.try_emplace({to, socket}, Announced{content, now}).first->second;
    if (last.content != content) last = {content, now};
    last.paidUntil = std::max(last.paidUntil, now);
    if (last.paidUntil > now + ((toAll ? firstAnnouncements : atOnce) - 1) * *interval_)
        return true;
    last.paidUntil += *interval_;
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
        const std::int64_t next = each->number(20) == 0 ? each->sequence(12) : 0;  // or lacks some
        const std::lock_guard lock{mutex_};
        const auto other = others_.find(prefixAt(received.subspan(prefixInHeader)));
        if (other == others_.end()) continue;
        const auto has = other->second.next.find({writerOf(*each), each->entity(4)});
        if (has != other->second.next.end()) has->second = next;
    }
}

void Repeats::newcomer(const Prefix& who, const std::vector<Locator>& at) {
    const std::lock_guard lock{mutex_};
    Other& other = others_[who] = {};
    for (const Builtin& each : discovery) {
        other.topicOf[each.reader] = each.topic;
        other.next[{each.writer, each.reader}] = 0;
    }
    for (const Locator& address : at) {
        livesAt_[address].insert(who);
        const auto begin = announced_.lower_bound({address, nullptr});
        announced_.erase(begin, std::find_if(begin, announced_.end(), [&](const auto& each) {
                             return each.first.first != address;
                         }));
    }
}

void Repeats::gone(const Prefix& who) {
    const std::lock_guard lock{mutex_};
    others_.erase(who);
    for (auto each = livesAt_.begin(); each != livesAt_.end();) {
        each->second.erase(who);
        each = each->second.empty() ? livesAt_.erase(each) : std::next(each);
    }
}

void Repeats::readerFound(const Guid& reader, const std::string& topic) {
    const std::lock_guard lock{mutex_};
    const auto other = others_.find(reader.guidPrefix);
    if (other == others_.end()) return;
    const EntityNumber number = numberOf(reader.entityId);
    other->second.topicOf[number] = topic;
    for (const auto& [writer, its] : writers_) {
        if (its == topic) other->second.next[{writer, number}] = 0;
    }
}

void Repeats::readerGone(const Guid& reader) {
    const std::lock_guard lock{mutex_};
    const auto other = others_.find(reader.guidPrefix);
    if (other == others_.end()) return;
    const EntityNumber number = numberOf(reader.entityId);
    other->second.topicOf.erase(number);
    std::erase_if(other->second.next,
                  [&](const auto& each) { return each.first.second == number; });
}

void Repeats::writerMade(const Entity& ours, const std::string& topic) {
    const std::lock_guard lock{mutex_};
    const EntityNumber number = numberOf(ours);
    writers_[number] = topic;
    for (auto& [who, other] : others_) {
        for (const auto& [reader, its] : other.topicOf) {
            if (its == topic) other.next[{number, reader}] = 0;
        }
    }
}

void Repeats::writerGone(const Entity& ours) {
    const std::lock_guard lock{mutex_};
    const EntityNumber number = numberOf(ours);
    writers_.erase(number);
    for (auto& [who, other] : others_) {
        std::erase_if(other.next, [&](const auto& each) { return each.first.first == number; });
    }
}

}  // namespace cortex::comms
