// SPDX-License-Identifier: Apache-2.0
#include "wire/relationship_ages.hpp"

#include "cortex/core/value.hpp"

#include "wire/presence_extras.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>

namespace cortex::comms {
namespace {

bool readAge(std::vector<SimplexMessage>& simplexes, const std::string& text) {
    std::istringstream in{text};
    std::string path, rule, target, seconds, more;
    if (!(in >> path >> rule >> target >> seconds) || in >> more) return false;
    const std::optional<double> age = toFloat(seconds);
    const auto simplex = std::ranges::find(simplexes, path, &SimplexMessage::path);
    if (!age || !std::isfinite(*age) || *age <= 0 || simplex == simplexes.end()) return false;
    const auto isIt = [&](const Relationship& each) {
        return each.rule == rule && each.target == target;
    };
    const auto found = std::ranges::find_if(simplex->relationships, isIt);
    if (found == simplex->relationships.end()) return false;
    found->maxAge = *age;
    return true;
}

}  // namespace

void writeAges(Model& sample) {
    for (const SimplexMessage& simplex : sample.simplexes) {
        for (const Relationship& each : simplex.relationships) {
            if (each.maxAge == 0) continue;
            sample.extras.push_back(
                {ageOfRelationship,
                 simplex.path + ' ' + each.rule + ' ' + each.target + ' ' + toText(each.maxAge)});
        }
    }
}

bool readAges(std::vector<SimplexMessage>& simplexes, const std::vector<Extra>& extras) {
    return std::ranges::all_of(extras, [&](const Extra& extra) {
        return extra.name != ageOfRelationship || readAge(simplexes, extra.value);
    });
}

}  // namespace cortex::comms
