// SPDX-License-Identifier: Apache-2.0
#include "cortex/cs/simplex_cs.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"

#include "tasks/task_thread.hpp"

#include <cstddef>
#include <memory>
#include <string>

namespace cortex::cs {

void SimplexCS::fault(std::int64_t code, std::string_view text) {
    if (thread_ == nullptr) throw Error(path() + ": fault() is for hooks; to refuse, throw");
    if (code <= 0) {
        throw Error("fault code " + std::to_string(code) +
                    " is not above 0, as a simplex's own are: " + std::string{text});
    }
    enterFault(code, text);
}

void SimplexCS::enterFault(std::int64_t code, std::string_view text, std::string_view brief) {
    if (pending_.fault) return;
    pending_.fault = true;
    thread_->faultCode = code;
    thread_->text = EventText{text};
    thread_->brief = EventText{brief.empty() ? text : brief};
}

void SimplexCS::setQuality(Quality quality, std::int64_t measuredAt) {
    if (thread_ == nullptr) return;  // not in a tick
    pending_.quality = true;
    quality_ = quality;
    thread_->measuredAt = measuredAt == thisCycle ? thread_->loop->nominalTime : measuredAt;
}

void SimplexCS::event(Severity severity, const EventText& text) {
    if (thread_ == nullptr) return;  // not in a tick
    runtime().post(*thread_->loop, severity, EventKind::Message, index(), text);
}

namespace {

void refuseUnderClock(const Simplex& simplex, bool underClock) {
    if (!underClock) return;
    throw Error(simplex.path() + ": a clock runs its loop, so nobody knows when it is between " +
                "two cycles; state is saved and restored under a manual trigger");
}

void requireFit(const Simplex& simplex, const Archive& archive, const char* otherwise) {
    if (!archive.problem()) return;
    throw Error(simplex.path() + ": " + std::string{archive.problem()->view()} + "; " + otherwise);
}

}  // namespace

const std::string& SimplexCS::filesFolder() const { return runtime().options().files; }

std::vector<std::byte> SimplexCS::savedState() {
    refuseUnderClock(*this, runtime().writersRefused());
    Archive measured;
    keep(measured);
    std::vector<std::byte> bytes(measured.size());
    Archive archive{bytes, runtime().nominalTime()};
    keep(archive);
    requireFit(*this, archive, "keep() hands over more than before");
    return bytes;
}

void SimplexCS::restoreState(std::span<const std::byte> saved) {
    refuseUnderClock(*this, runtime().writersRefused());
    Archive check{saved, Archive::Purpose::Check};
    keep(check);
    check.finish();
    requireFit(*this, check, "nothing was restored");
    Archive archive{saved, Archive::Purpose::Restore, runtime().nominalTime()};
    keep(archive);
}

}  // namespace cortex::cs
