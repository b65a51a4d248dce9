// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace cortex::gui {

// What is in Fault, beyond its limits or lost, of everything that is heard, whatever is shown.
class Abnormal {
public:
    enum Kind { Fault, Outside, Lost, KindCount };

    struct Found {
        std::string path;
        Place place;  // as long as the structures of frames are the same
    };

    void update(const Frame& frame);

    int count(Kind kind) const { return counts_[kind]; }
    // Of a lost agent one stands for all.
    const std::vector<Found>& found(Kind kind) const { return found_[kind]; }
    std::uint64_t looked() const { return looked_; }  // changes when it has looked again
    // The path of the next one, or of the one before; after the last comes the first. Of a lost
    // agent one path stands for all. Empty: there is none.
    std::string next(const std::string& path, bool back = false,
                     std::optional<Kind> kind = {}) const;

private:
    void add(Kind kind, const AgentFrame& agent, Place place);
    void findOutside(const AgentFrame& agent, std::uint32_t index);

    std::array<int, KindCount> counts_{};
    std::array<std::vector<Found>, KindCount> found_;
    std::uint64_t structures_ = 0, looked_ = 0;
    std::size_t come_ = 0;
    int frames_ = 0, looks_ = 0;
};

}  // namespace cortex::gui
