// SPDX-License-Identifier: Apache-2.0
#include "scene_reader.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/nearest_names.hpp"

#include "scene_parts.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

namespace cortex::physics {
namespace {

using Joined = RelatedSimplex::Joined;

std::string counted(std::size_t value) { return std::to_string(value); }

template <class Related>
std::vector<std::string> pathsOf(const std::vector<Related>& all) {
    std::vector<std::string> paths;
    for (const auto& each : all) paths.push_back(each.path());
    return paths;
}

std::optional<std::size_t> placeAmong(const std::string& path,
                                      const std::vector<std::string>& all) {
    const auto found = std::ranges::find(all, path);
    if (found == all.end()) return std::nullopt;
    return static_cast<std::size_t>(found - all.begin());
}

std::string nearestTo(const std::string& wrong, const std::vector<std::string>& valid) {
    const std::string names = nearestNames(wrong, valid);
    return names.empty() ? names : " (" + names + ")";
}

// Collects what is wrong, so that one start tells everything.
class SceneReader {
public:
    explicit SceneReader(const WorldRelations& world)
        : world_{world},
          observations_{pathsOf(world.observations)},
          statuses_{pathsOf(world.statuses)},
          owners_(world.observations.size()),
          statusOwners_(world.statuses.size()) {}

    SceneMap read() {
        refuseForeign();
        readManipulators();
        checkObservations();
        checkStatuses();
        for (const InputSimplex& arm : world_.arms) readCarrier(arm);
        for (const InputSimplex& body : world_.bodies) map_.scene.bodies.push_back(bodyOf(body));
        checkBodyPoses();
        if (!problems_.empty()) throw Error(problems_);
        map_.axes.insert(map_.axes.end(), openings_.begin(), openings_.end());
        return std::move(map_);
    }

private:
    void tell(const std::string& problem) {
        if (!problems_.empty()) problems_ += "\n";
        problems_ += world_.path + ": " + problem;
    }

    // What is of another agent has neither relations nor constants here, so nothing else is told.
    void refuseForeign() {
        const auto refuse = [this](const auto& all, const char* rule) {
            for (const auto& each : all) {
                if (each.isRemote())
                    tell(each.path() + " under rule '" + rule +
                         "' belongs to another agent, and its constants come when that is linked: "
                         "let the agent that has it compute the world");
            }
        };
        refuse(world_.manipulators, "manipulators");
        refuse(world_.arms, "arms");
        refuse(world_.bodies, "bodies");
        refuse(world_.observations, "observations");
        if (!problems_.empty()) throw Error(problems_);
    }

    void readManipulators() {
        for (const InputSimplex& each : world_.manipulators) {
            if (each.type().isA("Gripper"))
                readGripper(each);
            else if (each.type().isA("SerialManipulator") || each.type().isA("OneDofManipulator"))
                readArm(each);
            else
                tell(each.path() + " under rule 'manipulators' is a " + each.type().name +
                     ", and only a SerialManipulator, a OneDofManipulator and a Gripper can be "
                     "computed: leave it out, with its axes");
        }
    }

    // The place of each axis among the observations; what is not there is left out.
    std::vector<std::size_t> placesOfAxes(const InputSimplex& manipulator) {
        std::vector<std::size_t> places;
        const std::vector<Joined> axes = manipulator.related("axes"),
                                  demands = manipulator.related("demands");
        for (std::size_t i = 0; i < axes.size(); ++i) {
            const auto place = placeAmong(axes[i].path, observations_);
            if (!place) {
                tell("axis " + counted(i + 1) + " of " + manipulator.path() + " is " +
                     axes[i].path + ", which is not under rule 'observations'" +
                     nearestTo(axes[i].path, observations_) +
                     ": relate it there, and its demand at the same place of rule 'demands'");
                continue;
            }
            places.push_back(*place);
            owners_[*place].push_back(manipulator.path());
            if (i < demands.size()) checkDemand(manipulator, *place, i, demands[i].path);
        }
        return places;
    }

    void checkDemand(const InputSimplex& manipulator, std::size_t place, std::size_t axis,
                     const std::string& demand) {
        const std::string& related = world_.demands[place].path();
        if (related == demand) return;
        tell("number " + counted(place + 1) + " of rule 'observations' is " + observations_[place] +
             ", axis " + counted(axis + 1) + " of " + manipulator.path() + ", whose demand is " +
             demand + "; number " + counted(place + 1) + " of rule 'demands' is " + related +
             ": relate the two in the same order");
    }

    void readArm(const InputSimplex& manipulator) {
        Arm arm{manipulator.path()};
        for (const std::size_t place : placesOfAxes(manipulator)) {
            arm.joints.push_back(jointOf(world_.observations[place]));
            map_.axes.push_back(place);
        }
        armPaths_.push_back(manipulator.path());
        map_.scene.arms.push_back(std::move(arm));
    }

    void readGripper(const InputSimplex& manipulator) {
        gripperPaths_.push_back(manipulator.path());
        Gripper gripper = gripperOf(manipulator);
        const std::vector<Joined> axes = manipulator.related("axes");
        if (axes.size() != 1 || !axes.front().type->isA("LinearAxisConcept"))
            tell(manipulator.path() +
                 " is a gripper, so a world needs one axis of it, a LinearAxisConcept that is the "
                 "opening between its jaws; under its rule 'axes' there is something else");
        for (const std::size_t place : placesOfAxes(manipulator)) {
            gripper.opening = jointOf(world_.observations[place]);
            openings_.push_back(place);
        }
        map_.statuses.push_back(statusOf(manipulator, gripper.limitsForce));
        map_.scene.grippers.push_back(std::move(gripper));
    }

    std::optional<std::size_t> statusOf(const InputSimplex& manipulator, bool& limitsForce) {
        for (const Joined& status : manipulator.related("status")) {
            limitsForce = true;
            const auto place = placeAmong(status.path, statuses_);
            if (place) {
                statusOwners_[*place].push_back(manipulator.path());
                return place;
            }
            tell(manipulator.path() + " has the status " + status.path +
                 ", which is not under rule 'statuses'" + nearestTo(status.path, statuses_) +
                 ": relate it there, as nobody else writes it");
        }
        return std::nullopt;
    }

    void checkObservations() {
        for (std::size_t i = 0; i < owners_.size(); ++i) {
            if (owners_[i].empty())
                tell(observations_[i] +
                     " under rule 'observations' is an axis of no manipulator of this world: "
                     "relate that one under rule 'manipulators', or leave axis and demand out");
            else
                refuseTwo(observations_[i] + " under rule 'observations' is an axis of ",
                          owners_[i], ": leave one of the two out");
        }
    }

    void checkStatuses() {
        for (std::size_t i = 0; i < statusOwners_.size(); ++i) {
            if (statusOwners_[i].empty())
                tell(statuses_[i] +
                     " under rule 'statuses' is the status of no gripper of this world: relate it "
                     "under rule 'status' of its gripper, or leave it out");
            else
                refuseTwo(statuses_[i] + " under rule 'statuses' is the status of ",
                          statusOwners_[i], ": give each a status of its own");
        }
    }

    void refuseTwo(const std::string& what, const std::vector<std::string>& owners,
                   const char* remedy) {
        if (owners.size() > 1) tell(what + owners[0] + " and of " + owners[1] + remedy);
    }

    void readCarrier(const InputSimplex& arm) {
        const auto carrier = partOf(arm, "manipulator", "SerialManipulator", armPaths_);
        const auto place = partOf(arm, "gripper", "gripper", gripperPaths_);
        if (!carrier || !place) return;
        for (std::size_t i = 0; i < map_.scene.grippers.size(); ++i) {
            if (i != *place && map_.scene.grippers[i].carrier == carrier)
                tell(armPaths_[*carrier] + " carries two grippers, " + gripperPaths_[i] + " and " +
                     gripperPaths_[*place] + ", the latter by " + arm.path() +
                     " under rule 'arms': leave one of the two out");
        }
        auto& its = map_.scene.grippers[*place].carrier;
        if (its && its != carrier)
            tell(gripperPaths_[*place] + " is carried by two manipulators, " + armPaths_[*its] +
                 " and " + armPaths_[*carrier] + ", the latter by " + arm.path() +
                 " under rule 'arms': leave one of the two out");
        its = carrier;
    }

    // Of an Arm: the place of its manipulator or of its gripper.
    std::optional<std::size_t> partOf(const InputSimplex& arm, const char* rule, const char* what,
                                      const std::vector<std::string>& all) {
        for (const Joined& part : arm.related(rule)) {
            if (const auto place = placeAmong(part.path, all)) return place;
            tell(arm.path() + " under rule 'arms' has as its " + rule + " " + part.path +
                 ", which is no " + what + " under rule 'manipulators'" +
                 nearestTo(part.path, all) + ": relate it there, or leave the arm out");
        }
        return std::nullopt;
    }

    void checkBodyPoses() {
        std::size_t moving = 0;
        for (const Body& body : map_.scene.bodies) moving += body.mass > 0 ? 1 : 0;
        const std::size_t poses = world_.bodyPoses.size();
        if (poses == 0 || poses == moving) return;
        tell("rule 'bodyPoses' has " + counted(poses) + ", and " + counted(moving) +
             " under rule 'bodies' have a mass: relate one for each of them, in their order, or "
             "none at all");
    }

    const WorldRelations& world_;
    const std::vector<std::string> observations_, statuses_;
    // Paths of the manipulators that have it, of each observation and of each status.
    std::vector<std::vector<std::string>> owners_, statusOwners_;
    std::vector<std::string> armPaths_, gripperPaths_;
    std::vector<std::size_t> openings_;  // places of the grippers' axes
    SceneMap map_;
    std::string problems_;
};

}  // namespace

SceneMap readScene(const WorldRelations& world) { return SceneReader{world}.read(); }

}  // namespace cortex::physics
