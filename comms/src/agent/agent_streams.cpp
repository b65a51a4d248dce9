// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_streams.hpp"

#include "cortex/core/clock.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/path.hpp"

#include "wire/simplex_values.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::int64_t again = nsPerSecond / 10;

}  // namespace

AgentStreams::AgentStreams(AgentSelf& self, const Id& structureHash, Participant& participant)
    : self_{self},
      participant_{participant},
      structureHash_{structureHash},
      kept_{*self.access.images},
      streams_{Stream{topics::linkOf(self.name), 0}, Stream{topics::view5, 5},
               Stream{topics::view30, 30}, Stream{topics::view100, 100},
               Stream{topics::viewEvery, 0}} {
    const auto& simplexes = self.structure().simplexes;
    own_ = static_cast<std::uint32_t>(std::ranges::count(simplexes, false, &SimplexInfo::remote));
}

bool AgentStreams::everyCycle() const {
    return std::ranges::any_of(
        streams_, [](const Stream& each) { return each.isWanted() && each.rate == 0; });
}

std::int64_t AgentStreams::due() const {
    std::int64_t earliest = std::numeric_limits<std::int64_t>::max();
    for (const Stream& each : streams_) {
        if (each.isWanted() && each.rate != 0) earliest = std::min(earliest, each.due);
    }
    return earliest;
}

void AgentStreams::renew() {
    for (Stream& each : streams_) each.writer.reset();
}

void AgentStreams::update(const Peers& peers) {
    for (auto& wanted : wanted_) wanted.assign(own_, false);
    for (const auto& [name, peer] : peers) {
        if (!peer.heard) continue;
        addLinks(peer.current->interest, wanted_.front());
        for (const View& view : peer.current->interest.views) addView(view);
    }
    for (std::size_t i = 0; i < streams_.size(); ++i) open(streams_[i], wanted_[i]);
    kept_.want(streams_.back().isWanted());
}

void AgentStreams::addLinks(const Interest& interest, std::vector<bool>& wanted) {
    for (const std::string& path : interest.links) {
        const std::uint32_t simplex = self_.structure().find(path);
        if (simplex < own_) wanted[simplex] = true;  // the others belong to other agents
    }
}

void AgentStreams::addView(const View& view) {
    const auto stream = std::find_if(streams_.begin() + 1, streams_.end(),
                                     [&](const Stream& each) { return each.rate == view.rate; });
    if (stream == streams_.end()) {
        return self_.rejections.add("an interest in " + std::to_string(view.rate) + " Hz");
    }
    auto& wanted = wanted_[static_cast<std::size_t>(stream - streams_.begin())];
    for (const std::string& prefix : view.prefixes) addBelow(prefix, wanted);
}

// Simplexes are sorted by path. So those below a path are adjacent, and the path itself comes
// somewhere before them.
void AgentStreams::addBelow(const std::string& prefix, std::vector<bool>& wanted) {
    if (prefix.empty() || prefix.front() != '/') {
        return self_.rejections.add("an interest in what is no path");
    }
    const std::uint32_t itself = self_.structure().find(withoutEndSlashes(prefix));
    if (itself < own_) wanted[itself] = true;
    const std::string below = std::string{withoutEndSlashes(prefix)} + '/';
    const auto first = self_.structure().simplexes.begin();
    auto simplex = std::ranges::lower_bound(first, first + own_, below, {}, &SimplexInfo::path);
    for (; simplex != first + own_ && simplex->path.starts_with(below); ++simplex) {
        wanted[static_cast<std::size_t>(simplex - first)] = true;
    }
}

void AgentStreams::open(Stream& stream, const std::vector<bool>& wanted) {
    std::vector<std::uint32_t> simplexes;
    for (std::uint32_t i = 0; i < own_; ++i) {
        if (wanted[i]) simplexes.push_back(i);
    }
    if (simplexes != stream.simplexes) stream.block.cycle = 0;  // sends the newest cycle
    stream.simplexes = std::move(simplexes);
    if (stream.simplexes.empty() || stream.writer != nullptr) return;
    try {
        stream.writer = participant_.writer<Block>(stream.topic);
    } catch (const Error& error) {
        self_.event(Severity::Error, self_.simplex, error.what());
    }
    stream.block.agent = self_.id;
    stream.block.epoch = self_.epoch;
    stream.block.structureHash = structureHash_;
    stream.due = 0;
}

void AgentStreams::step(std::int64_t now) {
    const std::int64_t cycle = self_.access.newestCycle();
    Image image;
    for (Stream& stream : streams_) {
        if (&stream == &streams_.back() && !sendKept(now)) return;
        const bool due = stream.rate == 0 || now >= stream.due;
        if (!stream.isWanted() || !due) continue;
        if (stream.block.cycle >= cycle) {
            sayAgain(stream, now);
            continue;
        }
        if (!image) image = self_.access.newestImage();
        if (!image || image.cycle() == 0) return;
        write(stream, image, now);
        if (stream.rate == 0) continue;
        // The stream keeps to a grid of its own, which begins anew after a missed time.
        const std::int64_t interval = nsPerSecond / stream.rate;
        stream.due = std::max(stream.due + interval, now + interval / 2);
    }
}

// The newest image may have been sent already, without having been kept.
bool AgentStreams::sendKept(std::int64_t now) {
    Stream& every = streams_.back();
    for (std::size_t i = 0; i <= kept_.room(); ++i) {
        const Image image = kept_.next();
        if (!image) return true;
        if (every.isWanted() && image.cycle() > every.block.cycle) write(every, image, now);
    }
    return false;
}

// A view sends the last block again while the loop stands still or is slow. So a tool that begins
// to look sees it, and so does one that the last block did not reach. Links wait for the next
// cycle: their values would not become newer.
void AgentStreams::sayAgain(Stream& stream, std::int64_t now) {
    if (&stream == &streams_.front() || now < stream.againDue || stream.block.cycle == 0) return;
    stream.writer->write(stream.block);
    stream.againDue = now + again;
}

bool AgentStreams::repeatLinks() {
    Stream& links = streams_.front();
    if (!links.isWanted() || links.block.cycle == 0) return false;
    links.writer->write(links.block);
    return true;
}

void AgentStreams::write(Stream& stream, const Image& image, std::int64_t now) {
    Block& block = stream.block;
    ++block.sequenceNumber;
    block.cycle = image.cycle();
    block.nominalTime = image.nominalTime();
    block.wallClock = image.wallClock();
    block.simplexes.resize(stream.simplexes.size());
    for (std::size_t i = 0; i < stream.simplexes.size(); ++i) {
        const std::uint32_t simplex = stream.simplexes[i];
        readValues(simplex, *self_.structure().simplexes[simplex].layout, image.slice(simplex),
                   block.simplexes[i]);
    }
    stream.writer->write(block);
    stream.againDue = now + again;
}

}  // namespace cortex::comms
