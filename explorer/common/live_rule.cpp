// SPDX-License-Identifier: Apache-2.0
#include "common/live_rule.hpp"

#include <algorithm>
#include <array>

namespace cortex::common {

bool isOfFramework(const Structure& structure, std::uint32_t simplex, std::string_view item) {
    static constexpr std::array types{"Simplex", "Active", "Activity", "Agent", "Cluster"};
    const Type& own = *structure.simplexes[simplex].layout->type;
    return std::ranges::any_of(types, [&](const char* each) {
        const Type* type = own.isA(each) ? structure.types->find(each) : nullptr;
        return type != nullptr && type->findData(item) != nullptr;
    });
}

bool runs(const comms::AgentStatus& agent) {
    return agent.state != "lost" && agent.standstill.empty();
}

bool isHeard(const comms::AgentStatus& agent, const comms::AgentImage& image,
             std::uint32_t simplex) {
    return runs(agent) && image && !image.lost() && image.came(simplex);
}

bool isLive(const comms::AgentStatus& agent, const comms::AgentImage& image, std::uint32_t simplex,
            bool safe) {
    return isHeard(agent, image, simplex) &&
           (safe || image->state(simplex).quality == Quality::Good);
}

bool isLive(const comms::AgentStatus& agent, const comms::AgentImage& image, std::uint32_t simplex,
            bool safe, const DataItem& item) {
    if (item.constant) return true;
    const bool framework = image && isOfFramework(image->structure(), simplex, item.name);
    return framework ? isHeard(agent, image, simplex) : isLive(agent, image, simplex, safe);
}

}  // namespace cortex::common
