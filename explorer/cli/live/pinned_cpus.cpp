// SPDX-License-Identifier: Apache-2.0
#include "live/pinned_cpus.hpp"

#include "cortex/core/labelled_value.hpp"

#include "live/top_data.hpp"

#include <utility>
#include <vector>

namespace cortex::cli {

void viewOwnSimplexes(Live& live) {
    std::vector<std::string> own;
    for (const auto& each : live.mirror().agents()) {
        const auto structure = live.mirror().structure(each.name);
        const std::uint32_t simplex = structure ? ownSimplex(*structure) : noSimplex;
        if (simplex != noSimplex) own.push_back(structure->simplexes[simplex].path);
    }
    live.view(std::move(own), 5);
    live.waitForValues();
}

std::string pinnedCpus(const Live& live, const std::string& agent) {
    const comms::AgentImage image = live.mirror().image(agent);
    const std::uint32_t own = image ? ownSimplex(image->structure()) : noSimplex;
    if (own == noSimplex || !image.came(own)) return {};
    const ItemLayout* item = image->structure().simplexes[own].layout->find("cpus");
    if (item == nullptr || item->item->kind != Kind::String || item->item->length != 1) return {};
    return toText(image->value(own, *item));
}

}  // namespace cortex::cli
