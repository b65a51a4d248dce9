// SPDX-License-Identifier: Apache-2.0
#include "common/live_rule.hpp"

#include "common/image_items.hpp"

#include <algorithm>
#include <array>

namespace cortex::common {

namespace {

constexpr const char* fieldbus = "FieldbusDevice";

// Whether type `of` has the item, and the simplex is of that type.
bool isOf(const char* of, const Structure& structure, std::uint32_t simplex,
          std::string_view item) {
    const Type* type =
        structure.simplexes[simplex].layout->type->isA(of) ? structure.types->find(of) : nullptr;
    return type != nullptr && type->findData(item) != nullptr;
}

// Only where its values came says a count of zero anything, and of a lost agent only where nothing
// else is newer: it may have answered since.
bool neverAnswered(const comms::AgentImage& image, std::uint32_t simplex) {
    if (!image.came(simplex) || (image.lost() && image.isBehind(simplex))) return false;
    return image->structure().simplexes[simplex].layout->type->isA(fieldbus) &&
           itemOf<std::int64_t>(*image, simplex, "exchangeCount") == 0;
}

}  // namespace

bool isOfFramework(const Structure& structure, std::uint32_t simplex, std::string_view item) {
    static constexpr std::array types{"Simplex", "Active", "Activity", "Agent", "Cluster"};
    return std::ranges::any_of(
        types, [&](const char* each) { return isOf(each, structure, simplex, item); });
}

bool isOfAgent(const Structure& structure, std::uint32_t simplex, std::string_view item) {
    return isOfFramework(structure, simplex, item) || isOf(fieldbus, structure, simplex, item);
}

bool neverCame(const comms::AgentImage& image, std::uint32_t simplex, const DataItem& item) {
    static constexpr std::array ofAnswers{"age", "exchangeTimeLast", "exchangeTimeP99",
                                          "exchangeTimeMax"};
    if (item.constant || !image) return false;
    if (neverAnswered(image, simplex))
        return std::ranges::find(ofAnswers, item.name) != ofAnswers.end();
    return neverMeasured(image, simplex);
}

bool neverMeasured(const comms::AgentImage& image, std::uint32_t simplex) {
    if (!image || !image.came(simplex)) return false;
    const SimplexInfo& info = image->structure().simplexes[simplex];
    return info.role == Role::Observation && image->state(simplex).quality == Quality::Lost &&
           std::ranges::any_of(info.writers,
                               [&](std::uint32_t writer) { return neverAnswered(image, writer); });
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
    const bool told = image && isOfAgent(image->structure(), simplex, item.name);
    return told ? isHeard(agent, image, simplex) : isLive(agent, image, simplex, safe);
}

}  // namespace cortex::common
