// SPDX-License-Identifier: Apache-2.0
#include "loop/simplex_classes.hpp"

#include "cortex/core/system_findings.hpp"
#include "cortex/cs/simplex_cs.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cortex::cs {

bool hasTask(const SimplexInfo& info) { return !info.remote && info.layout->type->isA("Active"); }

namespace {

// ", and it extends A and B, which have one each": no class is taken by chance.
std::string orWhichOf(const Type& type, const TypeModel& types, const ClassRegistry* registry) {
    if (registry == nullptr) return "";
    const std::vector<std::string> classes = registry->classesFor(type, types);
    if (classes.size() < 2) return "";
    std::string text = ", and it extends " + classes.front();
    for (std::size_t i = 1; i < classes.size(); ++i) text += " and " + classes[i];
    return text + ", which have one each";
}

}  // namespace

Report missingClasses(AgentRuntime& agent, const ClassRegistry* registry) {
    Report report;
    const Structure& structure = agent.structure();
    for (const SimplexInfo& info : structure.simplexes) {
        if (info.role != Role::Active || info.remote || info.path == "/" + structure.agent)
            continue;
        const Simplex& simplex = agent.tree().at(info.path);
        if (hasTask(info) && dynamic_cast<const SimplexCS*>(&simplex) != nullptr) continue;
        const Type& type = *info.layout->type;
        report.error(info.path, finding::noClass, simplex.place(),
                     "no C++ class implements the active type " + type.name +
                         orWhichOf(type, agent.tree().types(), registry),
                     "load the plug-in that has it (--plugin FILE), or register a class derived "
                     "from SimplexCS for this type or for one that it extends");
    }
    return report;
}

void tellInheritedClasses(AgentRuntime& agent, const ClassRegistry* registry) {
    if (registry == nullptr) return;
    const auto& simplexes = agent.structure().simplexes;
    for (std::uint32_t i = 0; i < simplexes.size(); ++i) {
        const Type& type = *simplexes[i].layout->type;
        if (!hasTask(simplexes[i]) || registry->find(type.name) != nullptr) continue;
        for (const std::string& ancestor : registry->classesFor(type, agent.tree().types())) {
            Event event;
            event.simplex = i;
            event.text = EventText{type.name} << " has no class of its own and runs that of "
                                              << ancestor;
            agent.events().postOutside(event);
        }
    }
}

}  // namespace cortex::cs
