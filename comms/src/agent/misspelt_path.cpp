// SPDX-License-Identifier: Apache-2.0
#include "agent/misspelt_path.hpp"

#include "cortex/core/nearest_names.hpp"

namespace cortex::comms {

std::string MisspeltPath::hint(const std::string& path, const Peers& peers) {
    std::string text;
    std::set<std::string>& asked = asked_[path];
    std::erase_if(asked, [&](const std::string& each) { return !peers.contains(each); });
    for (const auto& [name, peer] : peers) {
        const bool known = peer.agent && peer.heard && peer.current && peer.model().complete();
        if (!known || !asked.insert(name).second) continue;
        const std::string nearest = nearestNames(path, peer.model().paths());
        if (nearest.empty()) continue;
        text += (text.empty() ? "" : "; ") + name + " has no such simplex, " + nearest;
    }
    return text;
}

}  // namespace cortex::comms
