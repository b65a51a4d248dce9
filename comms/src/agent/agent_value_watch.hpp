// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/event.hpp"

#include "agent/agent_self.hpp"
#include "agent/allowance.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cortex::comms {

// Keeps in the memory of the past which values of this agent changed their state: the quality of a
// simplex, a value that is outside its limits or within them again, a label, a switch. It looks
// five times a second; what changes and comes back between two looks is not seen. What changes all
// the time is told ten times and then once a second, with the number of changes that are left out.
// The loop does nothing for it. Communication thread only.
class AgentValueWatch {
public:
    explicit AgentValueWatch(AgentSelf& self);

    void step(std::int64_t now);  // ns of monotonicNow()

private:
    enum class Sort : std::uint8_t { Quality, Limits, Labels, Switch };
    // In each simplex of one type.
    struct Watched {
        Sort sort;
        const ItemLayout* layout;  // null: the quality
        std::uint32_t length;      // elements
    };
    // In one simplex.
    struct Subject {
        Allowance allowance;
        std::uint32_t changes = 0;  // of elements, since it was told last
    };
    // What is looked at just now.
    struct View {
        const Image& image;
        Slice slice;
        std::uint32_t simplex;
        const Watched& watched;
        std::span<std::int64_t> seen, told;  // by element: as it is, and as the memory knows it
    };

    void add(const TypeLayout& layout);
    void look(const Image& image, std::int64_t now);
    static std::uint32_t observe(const View& view);  // the number of changes
    void tell(const View& view, Subject& subject, std::int64_t now);
    static bool isWorse(const View& view, std::size_t element);
    static EventText say(const View& view, std::size_t element);
    void keep(const View& view, std::uint32_t changes);
    void keep(const Image& image, Severity severity, const std::string& path,
              const EventText& text);
    void tellLeftOut(const Image& image, std::int64_t now);

    AgentSelf& self_;
    std::vector<std::vector<Watched>> types_;
    std::vector<std::uint32_t> typeOf_;  // by own simplex, into types_
    std::vector<Subject> subjects_;      // by simplex, then what is watched
    // The same, then by element: a quality, a number, or whether it is true or outside.
    std::vector<std::int64_t> seen_, told_;
    Allowance qualities_, values_, rest_;
    std::uint64_t leftOut_ = 0;  // changes
    std::int64_t cycle_ = 0;     // of the last image that was looked at; 0: none
    bool waits_ = false;         // something is still to be told
    std::int64_t due_ = 0;
};

}  // namespace cortex::comms
