// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cortex::gui {

// A command that is repeated while a button is down.
struct HeldCommand {
    std::string path, command;
    comms::Mirror::Arguments arguments;
    std::optional<comms::Mirror::Arguments> atEnd;  // the same command, once
    std::chrono::milliseconds every{}, budget{};
};

// A hold that ended by itself.
struct HoldEnd {
    std::uint64_t number = 0;
    std::string why;
};

// Repeats what is held. Session thread.
class Holds {
public:
    using Moment = std::chrono::steady_clock::time_point;

    explicit Holds(comms::Mirror& mirror) : mirror_{mirror} {}

    void begin(std::uint64_t number, HeldCommand command);
    void change(std::uint64_t number, comms::Mirror::Arguments arguments);
    void end(std::uint64_t number, const Frame& frame);
    // Sends what is due. `alive`: when the window's thread was seen last. Gives the holds that
    // ended by themselves.
    std::vector<HoldEnd> step(const Frame& frame, Moment now, Moment alive);
    bool any() const { return !held_.empty(); }

private:
    struct Sent {
        std::uint64_t number = 0;  // the mirror's
        Moment at{};
    };
    struct Held {
        std::uint64_t number = 0;
        HeldCommand command;
        std::vector<Sent> sent;  // and not yet answered
        Moment due{};
        // The last one that was executed was so at this moment or later; at first when it began.
        Moment executed{};
    };
    std::string whyNot(Held& held, const Frame& frame, Moment now, Moment alive);
    std::string whyNotAnswered(Held& held, Moment now);
    void abandon(const Held& held);
    void sayEnd(Held& held, const Frame& frame);

    comms::Mirror& mirror_;
    std::vector<Held> held_;
    std::vector<HoldEnd> troubles_;  // ends that could not be sent
};

}  // namespace cortex::gui
