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

template <class T>
const T* oneOf(const Value& value) {
    const auto* all = std::get_if<std::vector<T>>(&value);
    return all != nullptr && all->size() == 1 ? &all->front() : nullptr;
}

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
    const auto value = [&](const char* item) {
        return image->value(simplex_.index, *simplex_.info().layout->find(item));
    };
    const Value activities = value("activity"), outcomes = value("outcome"),
                shares = value("progress");
    const auto* activity = oneOf<std::string>(activities);
    const auto* outcome = oneOf<std::int64_t>(outcomes);
    const auto* share = oneOf<double>(shares);
    if (activity == nullptr || outcome == nullptr || share == nullptr) return std::nullopt;
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
