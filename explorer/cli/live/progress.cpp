// SPDX-License-Identifier: Apache-2.0
#include "live/progress.hpp"

#include "live/live_values.hpp"

#include <cmath>
#include <iostream>

#include <unistd.h>

namespace cortex::cli {
namespace {

constexpr std::uint32_t looksPerSecond = 5;
constexpr std::chrono::seconds betweenLines{1};

}  // namespace

// Types with long commands extend Activity, which has these items.
Progress::Progress(Live& live, const FoundSimplex& simplex, const CommandTable::Entry& command)
    : live_{live},
      simplex_{simplex},
      command_{command.name},
      follows_{command.command != nullptr && command.command->isLong},
      onTerminal_{isatty(STDERR_FILENO) == 1} {
    for (const char* item : {"activity", "progress", "outcome"}) {
        follows_ = follows_ && simplex.info().layout->find(item) != nullptr;
    }
    if (follows_) live.view({simplex.info().path}, looksPerSecond);
}

Progress::~Progress() {
    if (onTerminal_ && !shown_.empty()) std::cerr << "\r\033[K" << std::flush;
}

// Nothing is shown of a command that ran before, or of somebody else's.
std::optional<long> Progress::percent() const {
    if (!follows_) return std::nullopt;
    const comms::AgentImage image = live_.mirror().image(simplex_.agent);
    const bool same = image && &image->structure() == simplex_.structure.get();
    if (!same || !isLive(image, simplex_.index)) return std::nullopt;
    const auto activity = common::itemOf<std::string>(*image, simplex_.index, "activity");
    const auto outcome = common::itemOf<std::int64_t>(*image, simplex_.index, "outcome");
    const auto share = common::itemOf<double>(*image, simplex_.index, "progress");
    if (!activity || !outcome || !share) return std::nullopt;
    const bool runs =
        *activity == command_ && *outcome == static_cast<std::int64_t>(Outcome::Running);
    if (!runs || !std::isfinite(*share)) return std::nullopt;
    return std::lround(*share * 100);
}

void Progress::look() {
    const auto now = std::chrono::steady_clock::now();
    if (!follows_ || now < next_) return;
    const std::optional<long> share = percent();
    if (!share) return;
    const std::string seen = command_ + ": " + std::to_string(*share) + " %";
    if (seen == shown_) return;
    shown_ = seen;
    if (onTerminal_) {
        std::cerr << "\r\033[K" << printable(seen) << std::flush;
    } else {
        std::cerr << printable(seen) << std::endl;
        next_ = now + betweenLines;
    }
}

}  // namespace cortex::cli
