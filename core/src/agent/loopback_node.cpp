// SPDX-License-Identifier: Apache-2.0
#include "agent/loopback_node.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace cortex {

LoopbackAgent::LoopbackAgent(const AgentAccess& access)
    : access_{access}, pipe_{access, 256}, calls_{access}, notes_{256}, lostSenders_{64} {
    const auto& simplexes = access.structure->simplexes;
    for (std::uint32_t i = 0; i < simplexes.size(); ++i) {
        if (!simplexes[i].remote) continue;
        links_.push_back(std::make_unique<Link>());
        links_.back()->simplex = i;
    }
}

bool LoopbackAgent::owns(std::string_view path) const {
    const std::uint32_t index = access_.structure->find(path);
    return index != noSimplex && !access_.structure->simplexes[index].remote;
}

void LoopbackAgent::loseSender(const Sender& sender) {
    if (Sender* place = lostSenders_.free()) {
        *place = sender;
        lostSenders_.push();
    }
}

void LoopbackAgent::note(Severity severity, std::uint32_t simplex, std::string_view text) {
    if (Note* place = notes_.free()) {
        *place = {severity, simplex, text};
        notes_.push();
    }
}

void LoopbackAgent::bind(const std::shared_ptr<LoopbackAgent>& other) {
    const Structure& ours = *access_.structure;
    const Structure& theirs = *other->access_.structure;
    for (const auto& link : links_) {
        const SimplexInfo& info = ours.simplexes[link->simplex];
        if (!other->owns(info.path)) continue;
        const Bound* before = link->bound.load();
        if (before != nullptr && before->owner->open_.load()) {
            note(Severity::Error, link->simplex,
                 other->name() + " claims it as well; " + before->owner->name() + " stays linked");
            continue;
        }
        auto bound = std::make_unique<Bound>();
        bound->owner = other;
        bound->theirs = theirs.find(info.path);
        bound->binding = compileLink(*info.layout, *theirs.simplexes[bound->theirs].layout,
                                     *ours.types, *theirs.types);
        bound->binding.period = other->access_.period * theirs.writtenEvery(bound->theirs);
        for (const Finding& finding : bound->binding.findings.findings) {
            note(finding.severity, link->simplex, finding.text());
        }
        if (bound->binding.usable) link->bound.store(bound.get(), std::memory_order_release);
        bounds_.push_back(std::move(bound));
    }
}

void LoopbackAgent::close() {
    open_.store(false);
    while (readers_.load() != 0) std::this_thread::sleep_for(std::chrono::microseconds{50});
    for (const auto& link : links_) link->bound.store(nullptr);
    bounds_.clear();  // our own loop has ended
}

void LoopbackAgent::read(Inbox& inbox) {
    for (const auto& link : links_) readLink(*link, inbox);
    for (std::size_t i = 0; i < notes_.size(); ++i) {
        const Note* note = notes_.front();
        if (note == nullptr) break;
        inbox.event(note->severity, EventKind::Agent, note->simplex, note->text);
        notes_.pop();
    }
    for (std::size_t i = 0; i < lostSenders_.size(); ++i) {
        const Sender* sender = lostSenders_.front();
        if (sender == nullptr) break;
        inbox.senderLost(*sender);
        lostSenders_.pop();
    }
    pipe_.read(inbox);
    calls_.read(inbox);
}

void LoopbackAgent::readLink(Link& link, Inbox& inbox) {
    const Bound* bound = link.bound.load(std::memory_order_acquire);
    if (bound == nullptr) return;
    // Counted first, then asked: close() sets open_ first, then waits for the count.
    LoopbackAgent& owner = *bound->owner;
    owner.readers_.fetch_add(1);
    const bool heard = owner.open_.load() && owner.connected_.load() && connected_.load();
    if (heard) readFrom(*bound, link, inbox);
    owner.readers_.fetch_sub(1);
    if (!heard && std::exchange(link.live, false)) inbox.linkLost(link.simplex);
}

// Without a new cycle of its owner there is no fresh sample.
void LoopbackAgent::readFrom(const Bound& bound, Link& link, Inbox& inbox) {
    const Image image = bound.owner->access_.newestImage();
    if (!image || image.cycle() == 0) return;
    if (link.live && image.cycle() == link.lastCycle) return;
    if (std::exchange(link.seen, &bound) != &bound) {
        inbox.linkConstants(link.simplex, bound.binding, image.constants(bound.theirs));
    }
    const Slice slice = image.slice(bound.theirs);
    inbox.link(link.simplex, bound.binding, slice, image.nominalTime() - slice.state->time);
    link.lastCycle = image.cycle();
    link.live = true;
}

// What a cut agent answers is lost.
void LoopbackAgent::write(Outbox& outbox) {
    calls_.write(outbox);
    if (connected_.load()) return pipe_.write(outbox);
    OutsideAnswer answer;
    while (outbox.nextAnswer(answer)) {
    }
}

}  // namespace cortex
