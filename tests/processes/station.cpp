// SPDX-License-Identifier: Apache-2.0
#include "processes/station.hpp"

#include "comms/inbox.hpp"
#include "support/patience.hpp"

#include <algorithm>
#include <chrono>

namespace cortex::test {

Station::Station() : mirror_{"station", comms::loopback()} {
    mirror_.onEvent([this](const AgentEvent& event) {
        const std::lock_guard lock{mutex_};
        events_.push_back(event);
    });
    mirror_.view({"/"});
}

bool Station::waitFor(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        images_ = mirror_.waitForImage(images_, std::chrono::milliseconds{20});
    }
    return true;
}

std::string Station::stateOf(const std::string& agent) const {
    for (const comms::AgentStatus& each : mirror_.agents()) {
        if (each.name == agent) return each.state;
    }
    return "";
}

std::int64_t Station::epochOf(const std::string& agent) const {
    for (const comms::AgentStatus& each : mirror_.agents()) {
        if (each.name == agent) return each.epoch;
    }
    return 0;
}

std::int64_t Station::cycleOf(const std::string& agent) const {
    const comms::AgentImage image = mirror_.image(agent);
    return image ? image->cycle() : -1;
}

std::int64_t Station::stampOf(const std::string& path) const {
    const comms::AgentImage image = imageOf(path);
    return image ? image->state(image->structure().find(path)).cycle : -1;
}

comms::AgentImage Station::imageOf(const std::string& path) const {
    const auto owner = mirror_.ownerOf(path);
    if (!owner) return {};
    comms::AgentImage image = mirror_.image(*owner);
    if (!image || !mirror_.age(*owner, image->structure().find(path))) return {};  // not come yet
    return image;
}

std::optional<std::int64_t> Station::number(const std::string& path,
                                            const std::string& item) const {
    const comms::AgentImage image = imageOf(path);
    if (!image) return std::nullopt;
    return image->get<std::int64_t>(path, item);
}

double Station::real(const std::string& path, const std::string& item) const {
    const comms::AgentImage image = imageOf(path);
    return image ? image->get<double>(path, item) : 0;
}

std::vector<double> Station::reals(const std::string& path, const std::string& item) const {
    const comms::AgentImage image = imageOf(path);
    if (!image) return {};
    return std::get<std::vector<double>>(image->value(path, item));
}

std::vector<double> Station::demands() const {
    std::vector<double> positions;
    for (int i = 1; i <= 7; ++i) {
        positions.push_back(real("/arm/lbr/demands/" + std::to_string(i), "position"));
    }
    return positions;
}

void Station::mark() {
    const std::lock_guard lock{mutex_};
    marked_ = events_.size();
}

std::vector<AgentEvent> Station::events() const {
    const std::lock_guard lock{mutex_};
    return {events_.begin() + static_cast<std::ptrdiff_t>(marked_), events_.end()};
}

std::optional<AgentEvent> Station::event(const std::string& path, const std::string& part) const {
    for (AgentEvent& each : events()) {
        if (each.path == path && each.text.find(part) != std::string::npos) return std::move(each);
    }
    return std::nullopt;
}

}  // namespace cortex::test
