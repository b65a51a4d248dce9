// SPDX-License-Identifier: Apache-2.0
// A plug-in with the class of one type. CMake builds it several times, each time with one thing
// that a host must refuse.
#include "cortex/core/registry.hpp"

#ifndef PUMP_HASH
#define PUMP_HASH ""
#endif

namespace {

class Pump final : public cortex::Simplex {
public:
    using Simplex::Simplex;
};

[[maybe_unused]] void addClasses(cortex::ClassRegistry& registry) {
    registry.add<Pump>("Pump");
#ifndef PUMP_UNREGISTERED
    registry.add<Pump>("Turbine");
#endif
#ifdef PUMP_UNSTATED
    registry.add<Pump>("Valve");
#endif
}

}  // namespace

#ifdef PUMP_DESCRIPTION

extern "C" __attribute__((visibility("default"))) const cortex::PluginDescription* cortexPlugin() {
    static const cortex::PluginDescription::ImplementedType types[] = {
        {"Pump", ""}, {"Turbine", ""}, {nullptr, nullptr}};
    static const cortex::PluginDescription description{PUMP_DESCRIPTION, types, addClasses};
    return &description;
}

#elif !defined(PUMP_SILENT)

CORTEX_PLUGIN(addClasses, {"Pump", PUMP_HASH}, {"Turbine", "not in every ontology"})

#endif
