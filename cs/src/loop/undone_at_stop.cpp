// SPDX-License-Identifier: Apache-2.0
// What a stop leaves undone, in words.
#include "loop/cluster_loop.hpp"

namespace cortex::cs {

void ClusterLoop::tellUnsafe() {
    if (cycle_ == 0) return;
    for (const TaskDemands::OnTheWay& each : runner_.demands().onTheWay()) {
        const bool isTaken = each.unconnected == noSimplex;
        Event event;
        event.cycle = cycle_;
        event.time = lastNominal_;
        event.simplex = each.simplex;
        event.severity = isTaken ? Severity::Error : Severity::Warning;
        if (each.way) {
            const auto& [item, value, safe] = *each.way;
            event.text << item->name << " is ";
            event.text.apart(value, safe);
            if (!item->unit.empty()) event.text << " " << item->unit;
            event.text << ", its safe value ";
            event.text.apart(safe, value);
            event.text << " was not ";
        } else {
            event.text << "its safe values were not ";
        }
        if (isTaken) {
            event.text << "reached within the stopTimeout of " << options_.stopTimeout << " s";
            unsafe_.push_back(agent_.structure().simplexes[each.simplex].path + ": " +
                              std::string{event.text.view()});
        } else {
            event.text << (each.way ? "waited for: " : "sent: ")
                       << agent_.structure().simplexes[each.unconnected].path
                       << " is not connected";
        }
        agent_.events().postOutside(event);
    }
}

std::vector<std::string> ClusterLoop::notFollowed() const {
    std::vector<std::string> lines = group_.notFollowed();
    lines.insert(lines.end(), unsafe_.begin(), unsafe_.end());
    return lines;
}

}  // namespace cortex::cs
