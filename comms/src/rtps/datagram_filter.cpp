// SPDX-License-Identifier: Apache-2.0
#include "rtps/datagram_filter.hpp"

#include "rtps/announcement.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace cortex::comms::rtps {
namespace {

constexpr std::int64_t interval = 1'000'000'000;  // ns, between two reports of one kind
constexpr std::int64_t longestGap = 4096;         // Fast DDS takes memory for each number of it
constexpr std::int64_t whileOfOne = 8'000'000;    // ns, within which a sample or gap is said once

// Of a DATA_FRAG whose content was judged.
Fragment fragmentOf(const Submessage& submessage, const WriterGuid& writer, bool comesAgain) {
    const bool little = submessage.little();
    const Bytes body = submessage.body;
    return {writer,
            readNumber(body.subspan(12), little),
            readU32(body.subspan(20), little),
            readU16(body.subspan(24), little),
            readU16(body.subspan(26), little),
            readU32(body.subspan(28), little),
            comesAgain};
}

Prefix prefixAt(Bytes bytes) {
    Prefix prefix;
    std::copy_n(bytes.begin(), prefix.size(), prefix.begin());
    return prefix;
}

WriterGuid guidOf(const Prefix& prefix, Bytes entity) {
    WriterGuid guid;
    std::ranges::copy(prefix, guid.begin());
    std::copy_n(entity.begin(), 4, guid.begin() + prefix.size());
    return guid;
}

// The datagram without a part of it: what stood behind moves to the front.
Bytes takenOut(Bytes datagram, Bytes part) {
    const auto behind =
        datagram.subspan(static_cast<std::size_t>(&part.back() - &datagram.front()) + 1);
    std::ranges::copy(behind, part.begin());
    return datagram.first(datagram.size() - part.size());
}

// In the open: what is signed as a whole stays as it is.
bool hasFragments(Bytes datagram) {
    bool has = false;
    for (std::size_t at = headerSize; at < datagram.size();) {
        const Submessage submessage = cutSubmessage(datagram.subspan(at)).submessage;
        if (submessage.kind == Kind::SignedPrefix) return false;
        has = has || submessage.kind == Kind::DataFragments;
        at += submessage.whole.size();
    }
    return has;
}

// A sample or a gap has no count: said again after a while, it is another statement. A participant
// announces itself with the same number until something changes.
std::uint32_t sayingOf(std::int64_t now) { return static_cast<std::uint32_t>(now / whileOfOne); }

std::string textOf(std::uint32_t address) {
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8) {
        text += std::to_string(address >> shift & 0xff) + (shift > 0 ? "." : "");
    }
    return text;
}

}  // namespace

DatagramFilter::Admitted DatagramFilter::admit(Bytes datagram, std::uint32_t address,
                                               std::int64_t now) {
    const std::lock_guard lock{mutex_};
    const Refusal refusal = judge(datagram, address, now);
    if (refusal != Refusal::None) {
        if (isCounted(refusal)) note(refusal, 1, address);
        return {};
    }
    const std::uint64_t dropped = fragments_.dropped(), incomplete = fragments_.incomplete();
    std::vector<Message> whole = takeFragments(datagram, now);
    if (fragments_.dropped() > dropped)
        note(Refusal::Unfinished, fragments_.dropped() - dropped, address);
    if (fragments_.incomplete() > incomplete)
        note(Refusal::Incomplete, fragments_.incomplete() - incomplete, address);
    return {std::move(whole), datagram.size()};
}

void DatagramFilter::note(Refusal refusal, std::uint64_t count, std::uint32_t address) {
    Dropped& dropped = dropped_[static_cast<std::size_t>(refusal)];
    dropped.count += count;
    dropped.address = address;
}

// Framing and content of everything come first, so that nothing is noted of a datagram that is
// dropped for them. Fast DDS verifies what is signed before it reads it; changed, it would not be
// what was signed.
Refusal DatagramFilter::judge(Bytes& datagram, std::uint32_t address, std::int64_t now) {
    if (!hasHeader(datagram)) return Refusal::Framing;
    SecureOrder order;
    for (std::size_t at = headerSize; at < datagram.size();) {
        const auto [submessage, refusal] = cutSubmessage(datagram.subspan(at));
        if (refusal != Refusal::None) return refusal;
        if (submessage.kind >= Kind::FirstOfVendors) {
            if (order.isOpen()) return Refusal::Framing;
            datagram = takenOut(datagram, submessage.whole);
            continue;
        }
        if (!order.admits(submessage)) return Refusal::Framing;
        const bool isVerified = order.isSigned() && !isOfSecurity(submessage.kind);
        const Refusal found = isVerified ? Refusal::None : judgeContent(submessage);
        if (found != Refusal::None) return found;
        at += submessage.whole.size();
    }
    if (order.isOpen()) return Refusal::Framing;
    const Prefix sender = prefixAt(datagram.subspan(senderAt));
    const Refusal found = participants_.judge(sender, address, now);
    if (found != Refusal::None || order.isSigned()) return found;
    return judgeNumbers(datagram, sender, address, now);
}

// A gap that goes further than its writer did passes if the writer goes on behind it in the same
// datagram: what Fast DDS sends to a new reader of a writer that took samples back. What announces
// an endpoint of a foreign topic becomes a gap.
Refusal DatagramFilter::judgeNumbers(Bytes& datagram, Prefix sender, std::uint32_t address,
                                     std::int64_t now) {
    bool isForUs = true;
    std::optional<WriterGuid> ofGap;
    for (std::size_t at = headerSize; at < datagram.size();) {
        const Submessage submessage = cutSubmessage(datagram.subspan(at)).submessage;
        at += submessage.whole.size();
        if (submessage.kind == Kind::InfoSource) sender = prefixAt(submessage.body.subspan(8));
        if (submessage.kind == Kind::InfoDestination) {
            const Prefix destination = prefixAt(submessage.body);
            isForUs = destination == us_ || destination == Prefix{};
        }
        if (!isForUs) continue;
        const Refusal found = judgeNumber(submessage, sender, address, now);
        if (found != Refusal::None) {
            if (submessage.kind != Kind::Gap || ofGap) return found;
            ofGap = guidOf(sender, submessage.body.subspan(4));
        } else if (submessage.kind == Kind::Data) {
            if (ofGap == guidOf(sender, submessage.body.subspan(8))) ofGap.reset();
            if (announcementIn(submessage).says != Announcement::IsForeign) continue;
            const Bytes rest = becomeGap(submessage);
            at -= rest.size();
            if (!rest.empty()) datagram = takenOut(datagram, rest);
        }
    }
    return ofGap ? Refusal::Number : Refusal::None;
}

Refusal DatagramFilter::judgeNumber(const Submessage& submessage, const Prefix& sender,
                                    std::uint32_t address, std::int64_t now) {
    const auto unless = [](bool good) { return good ? Refusal::None : Refusal::Number; };
    const Bytes body = submessage.body;
    const bool little = submessage.little();
    switch (submessage.kind) {
        case Kind::Data:
            if (!numbers_.admits(guidOf(sender, body.subspan(8)),
                                 readNumber(body.subspan(12), little), sayingOf(now), now))
                return Refusal::Number;
            if (const std::int64_t named = domainIn(submessage); named >= 0 && named != domain_)
                return Refusal::Domain;
            if (const Refusal found = places_.judge(submessage, sender, address, now);
                found != Refusal::None)
                return found;
            return judgeEndpoint(submessage, sender, now);
        case Kind::DataFragments: {
            const WriterGuid writer = guidOf(sender, body.subspan(8));
            auto* const known = fragmented_.find(writer);
            if (known == nullptr) return Refusal::Fragment;
            known->met = now;
            return unless(numbers_.admits(writer, readNumber(body.subspan(12), little),
                                          readU32(body.subspan(20), little), now));
        }
        case Kind::Heartbeat:
            return unless(admitsHeartbeat(submessage, sender, now));
        case Kind::Gap:
            return unless(admitsGap(submessage, sender, now));
        case Kind::AckNack: {
            const auto* const sent = sent_.find(guidOf(us_, body.subspan(4)));
            if (sent != nullptr && readNumber(body.subspan(8), little) > sent->value + 1)
                return Refusal::Number;
            askFromTheBeginning(submessage, sender, now);
            return Refusal::None;
        }
        default:
            return Refusal::None;
    }
}

// A participant that announces a group for discovery is told of endpoints there, which comes back
// to who says it.
bool DatagramFilter::isEcho(const Submessage& data, const Prefix& sender) const {
    if (sender != us_) return false;
    const auto* const sent = sent_.find(guidOf(us_, data.body.subspan(8)));
    return sent != nullptr && readNumber(data.body.subspan(12), data.little()) <= sent->value;
}

// Fast DDS keeps for ever an announcement that names none, or an endpoint of its own participant.
Refusal DatagramFilter::judgeEndpoint(const Submessage& submessage, const Prefix& sender,
                                      std::int64_t now) {
    const auto [says, endpoint] = announcementIn(submessage);
    if (says == Announcement::Nothing) return Refusal::None;
    if (says == Announcement::IsGone) {
        endpoints_.remove(endpoint);
        return Refusal::None;
    }
    if (says == Announcement::Unclear) return Refusal::Parameters;
    if (std::ranges::equal(us_, std::span{endpoint}.first<12>()))
        return isEcho(submessage, sender) ? Refusal::Echo : Refusal::Parameters;
    if (says == Announcement::IsForeign) return Refusal::None;  // it goes no further
    return endpoints_.admits(endpoint, participants_, now) ? Refusal::None : Refusal::Endpoints;
}

// Each fragment becomes a message of its own: a header, the time if there is one, the fragment.
std::vector<Message> DatagramFilter::takeFragments(Bytes& datagram, std::int64_t now) {
    std::vector<Message> whole;
    if (!hasFragments(datagram)) return whole;
    bool isForUs = true;
    Message front(datagram.begin(), datagram.begin() + headerSize);
    for (std::size_t at = headerSize; at < datagram.size();) {
        const Submessage submessage = cutSubmessage(datagram.subspan(at)).submessage;
        const Bytes body = submessage.body;
        if (submessage.kind == Kind::DataFragments && isForUs) {
            const WriterGuid writer =
                guidOf(prefixAt(Bytes{front}.subspan(senderAt)), body.subspan(8));
            Message message = front;
            message.insert(message.end(), submessage.whole.begin(), submessage.whole.end());
            for (Message& each :
                 fragments_.add(fragmentOf(submessage, writer, fragmented_.find(writer)->value),
                                std::move(message), now))
                whole.push_back(std::move(each));
            datagram = takenOut(datagram, submessage.whole);
            continue;
        }
        at += submessage.whole.size();
        if (submessage.kind == Kind::InfoSource)
            std::copy_n(body.begin() + 8, Prefix{}.size(), front.begin() + senderAt);
        if (submessage.kind == Kind::InfoDestination)
            isForUs = prefixAt(body) == us_ || prefixAt(body) == Prefix{};
        if (submessage.kind == Kind::InfoTimestamp) {
            front.resize(headerSize);
            front.insert(front.end(), submessage.whole.begin(), submessage.whole.end());
        }
    }
    return whole;
}

bool DatagramFilter::admitsHeartbeat(const Submessage& heartbeat, const Prefix& sender,
                                     std::int64_t now) {
    const bool little = heartbeat.little();
    const WriterGuid writer = guidOf(sender, heartbeat.body.subspan(4));
    const Bytes first = heartbeat.body.subspan(8);
    const std::int64_t last = readNumber(heartbeat.body.subspan(16), little);
    if (!numbers_.admits(writer, last, readU32(heartbeat.body.subspan(24), little), now))
        return false;
    writeNumber(first, little, numbers_.stepTo(writer, readNumber(first, little)));
    return true;
}

bool DatagramFilter::admitsGap(const Submessage& gap, const Prefix& sender, std::int64_t now) {
    const bool little = gap.little();
    const WriterGuid writer = guidOf(sender, gap.body.subspan(4));
    const std::int64_t start = readNumber(gap.body.subspan(8), little);
    const Bytes base = gap.body.subspan(16), bits = gap.body.subspan(24);
    const std::int64_t end = readNumber(base, little);
    if (end - start > longestGap) {
        writeNumber(base, little, start + longestGap);
        writeU32(bits, little, 0);
    }
    return numbers_.admits(writer, end - 1, sayingOf(now), now);
}

bool DatagramFilter::isSilent(const Prefix& participant, std::int64_t now) const {
    const std::lock_guard lock{mutex_};
    return participants_.isSilent(participant, now);
}

bool DatagramFilter::skips(const WriterGuid& writer, std::int64_t now) const {
    const std::lock_guard lock{mutex_};
    return numbers_.areSkipped(writer, now);
}

// Who lost us and meets us anew asks again for the announcements of our endpoints. To Fast DDS 2.9
// they are acknowledged, and it sends them again only to who asks from number 0 on. Its reader does
// so only if no heartbeat came first. It must answer, so the final flag goes.
void DatagramFilter::askFromTheBeginning(const Submessage& ackNack, const Prefix& sender,
                                         std::int64_t now) {
    const Bytes body = ackNack.body, base = body.subspan(8), bits = body.subspan(16);
    const std::uint32_t writer = readU32(body.subspan(4), false);
    if (writer != announcesWriters && writer != announcesReaders) return;
    const bool little = ackNack.little();
    const Bytes countAt = bits.subspan(4 + (readU32(bits, little) + 31) / 32 * 4);
    const std::uint32_t count = readU32(countAt, little);
    const WriterGuid key = guidOf(sender, body.subspan(4));
    const std::int64_t from = readNumber(base, little);
    auto* const known = asked_.find(key);
    if (known == nullptr) {
        asked_.placeFor(key) = {key, now, {count, from}};
        return;
    }
    Asked& last = known->value;
    if (static_cast<std::int32_t>(count - last.count) <= 0) return;
    const bool goesBack = from < last.base;
    known->met = now;
    last = {count, goesBack ? 0 : from};
    if (!goesBack) return;
    writeNumber(base, little, 0);
    writeU32(bits, little, 0);
    writeU32(bits.subspan(4), little, count);
    ackNack.whole[1] &= static_cast<std::uint8_t>(~2);
}

void DatagramFilter::noteSent(Bytes datagram, std::int64_t now) {
    if (!hasHeader(datagram)) return;
    const std::lock_guard lock{mutex_};
    for (std::size_t at = headerSize; at < datagram.size();) {
        const auto [submessage, refusal] = cutSubmessage(datagram.subspan(at));
        if (refusal != Refusal::None || !isLongEnough(submessage)) return;
        const bool isData = submessage.kind == Kind::Data || submessage.kind == Kind::DataFragments;
        if (isData || submessage.kind == Kind::Heartbeat) {
            const WriterGuid writer = guidOf(us_, submessage.body.subspan(isData ? 8 : 4));
            const std::int64_t number =
                readNumber(submessage.body.subspan(isData ? 12 : 16), submessage.little());
            if (auto* const known = sent_.find(writer)) {
                known->met = now;
                known->value = std::max(known->value, number);
            } else {
                sent_.placeFor(writer) = {writer, now, number};
            }
        }
        at += submessage.whole.size();
    }
}

void DatagramFilter::allowFragments(const WriterGuid& writer, bool comesAgain, std::int64_t now) {
    const std::lock_guard lock{mutex_};
    if (fragmented_.find(writer) == nullptr) {
        fragmented_.placeFor(writer) = {writer, now, comesAgain};
    }
}

std::uint64_t DatagramFilter::dropped(Refusal reason) const {
    const std::lock_guard lock{mutex_};
    return dropped_[static_cast<std::size_t>(reason)].count;
}

std::string DatagramFilter::lastSender(Refusal reason) const {
    const std::lock_guard lock{mutex_};
    return textOf(dropped_[static_cast<std::size_t>(reason)].address);
}

std::uint64_t DatagramFilter::dropped() const {
    const std::lock_guard lock{mutex_};
    std::uint64_t all = 0;
    for (const Dropped& each : dropped_) all += each.count;
    return all;
}

std::string DatagramFilter::summary() const {
    std::string text;
    const std::lock_guard lock{mutex_};
    for (std::size_t i = 0; i < refusals; ++i) {
        if (dropped_[i].count == 0) continue;
        text += (text.empty() ? "" : "; ") + std::to_string(dropped_[i].count) + " as " +
                wordsOf(static_cast<Refusal>(i));
    }
    return text;
}

std::vector<std::string> DatagramFilter::takeReports(std::int64_t now) {
    std::vector<std::string> reports;
    const std::lock_guard lock{mutex_};
    for (std::size_t i = 0; i < refusals; ++i) {
        Dropped& dropped = dropped_[i];
        if (dropped.count == dropped.reported || now - dropped.told < interval) continue;
        const std::uint64_t count = dropped.count - std::exchange(dropped.reported, dropped.count);
        dropped.told = now;
        reports.push_back(std::to_string(count) +
                          (count == 1 ? " datagram was dropped: " : " datagrams were dropped: ") +
                          wordsOf(static_cast<Refusal>(i)) + "; the last came from " +
                          textOf(dropped.address));
    }
    return reports;
}

}  // namespace cortex::comms::rtps
