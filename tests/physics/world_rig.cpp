// SPDX-License-Identifier: Apache-2.0
#include "world_rig.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/event.hpp"
#include "cortex/toolkit/classes.hpp"

#include "mujoco_world.hpp"

#include <algorithm>
#include <variant>

namespace cortex::physics::test {

void addWorldClasses(ClassRegistry& classes) {
    toolkit::addClasses(classes);
    classes.add<MujocoWorld>("MujocoWorld");
}

WorldRig::WorldRig(const Entries& entries, std::chrono::microseconds cycle)
    : TestPlant{worldModel(), cycle, "rig"} {
    addWorldClasses(classes());
    for (const SystemDescription::SimplexEntry& each : entries) add(each);
    cluster().addEventSink([told = told_](const Event& event, const Structure&) {
        if (event.severity < Severity::Warning) return;
        const std::lock_guard lock{told->mutex};
        told->text += std::string{event.text.view()} + "\n";
    });
    start();
}

std::vector<double> WorldRig::array(const std::string& path, const std::string& item) {
    return std::get<std::vector<double>>(cluster().image().value(path, item));
}

bool WorldRig::set(const std::string& path, const std::string& item, const Value& value) {
    return call(path, "set", {{item, value}}).done();
}

CallResult WorldRig::moveTo(const std::string& controller, const std::vector<double>& pose) {
    std::vector<double> places(16);
    std::ranges::copy(pose, places.begin());
    set(controller, "pose", Value{places});
    return call(controller, "moveTo");
}

std::string WorldRig::told() {
    cluster().agent().events().flush();
    const std::lock_guard lock{told_->mutex};
    return told_->text;
}

}  // namespace cortex::physics::test
