// SPDX-License-Identifier: Apache-2.0
#include "io_places.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/type_model.hpp"

#include <cstdint>
#include <variant>

namespace cortex::modbus {
namespace {

// Constants of another agent are not known here.
void refuseRemote(const InputSimplex& simplex, const std::string& what) {
    if (!simplex.isRemote()) return;
    refuse(simplex, "belongs to another agent, so that its " + what +
                        " not known here; relate a simplex of this agent, and let a controller of "
                        "it follow the other one");
}

template <class T>
double constantOf(const IoPlace<T>& place, std::string_view item) {
    return place.isInGroup ? place.simplex.template array<const double>(item)[place.number]
                           : place.simplex.template data<const double>(item).get();
}

template <class T>
Scale constantsOf(const IoPlace<T>& place) {
    refuseRemote(place.simplex, "scale is");
    const Scale found{constantOf(place, "scale"), constantOf(place, "offset")};
    if (found.scale == 0) {
        refuse(place.simplex, "has the scale 0" + atPlace(place) +
                                  ", and no number would reach it; set what one count of the "
                                  "device stands for");
    }
    return found;
}

template <class T>
T safeOf(const IoPlace<const T>& place) {
    const DataItem* item = place.simplex.type().findData("value");
    if (item->safe.kind != Safe::Kind::Given) {
        refuse(place.simplex,
               "has no safe value that its type gives as such, and the device would not know what "
               "to give while nobody speaks for it; write safe=\"…\" at its item value");
    }
    return std::get<std::vector<T>>(item->safe.value)[place.number];
}

}  // namespace

void refuse(const InputSimplex& simplex, const std::string& why) {
    throw Error(simplex.path() + " (" + simplex.type().name + ") " + why);
}

void refuseBoth(const IoRules& rules) {
    throw Error(rules.device + ": a group is related by rule " + std::string{rules.group} +
                ", and single concepts by " + std::string{rules.singles} +
                ", but both begin at the same address; remove one of the two");
}

std::size_t countOf(const InputSimplex& group) {
    refuseRemote(group, "count and scale are");
    return static_cast<std::size_t>(group.data<const std::int64_t>("count").get());
}

Scale scaleOf(const IoPlace<const double>& place) { return constantsOf(place); }
Scale scaleOf(const IoPlace<double>& place) { return constantsOf(place); }

double safeValueOf(const IoPlace<const double>& place) { return safeOf(place); }
bool safeValueOf(const IoPlace<const bool>& place) { return safeOf(place); }

}  // namespace cortex::modbus
