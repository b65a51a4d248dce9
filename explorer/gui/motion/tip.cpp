// SPDX-License-Identifier: Apache-2.0
#include "motion/tip.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <vector>

namespace cortex::explorer {

namespace {

// Angles about the fixed axes x, y, z, in this order, of a unit quaternion x y z w. Where pitch is
// a right angle, roll and yaw turn about one axis, and roll is 0. Source: J. Craig, Introduction to
// Robotics, 2.8.
std::array<double, 3> rollPitchYaw(double x, double y, double z, double w) {
    const double sine = std::clamp(2 * (w * y - z * x), -1.0, 1.0);
    if (std::abs(sine) > 1 - 1e-9) {
        const double both = 2 * std::atan2(z, w);
        return {0, std::asin(sine), std::remainder(both, 2 * std::acos(-1.0))};
    }
    return {std::atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)), std::asin(sine),
            std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))};
}

// The constant in which the tips of these two differ.
QString differingTip(const SimplexNow& one, const SimplexNow& other) {
    for (const char* item : {"tipPosition", "tipRotation"}) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (one.number(item, i) != other.number(item, i)) return QLatin1String{item};
        }
    }
    return {};
}

// Where the tip of these axes is computed: by kinematics of just these, and of this tip if there
// are any.
void findPose(Tip& tip, const SystemNow& now, const SimplexNow& controller) {
    const auto axes = controller.related("axes");
    if (axes.empty()) return;
    for (const std::string& each : now.at(axes.front()).relatedBy("axes")) {
        const SimplexNow kinematics = now.at(each);
        const Type* type = kinematics.type();
        if (type == nullptr || !type->isA("ForwardKinematics")) continue;
        const auto tips = kinematics.related("tip");
        if (kinematics.related("axes") != axes || tips.empty()) continue;
        const QString another = differingTip(kinematics, controller);
        if (!tip.pose.empty() && !another.isEmpty()) continue;
        tip.pose = tips.front();
        tip.kinematics = each;
        tip.another = another;
        if (another.isEmpty()) return;
    }
}

std::optional<double> lengthOf(const SimplexNow& simplex, const char* item) {
    double squares = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto number = simplex.number(item, i);
        if (!number) return std::nullopt;
        squares += *number * *number;
    }
    return std::sqrt(squares);
}

void readPlace(Tip& tip, const SimplexNow& pose) {
    std::array<double, 4> turned{};
    bool known = true;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto number = pose.number("rotation", i);
        known = known && number;
        turned[i] = number.value_or(0);
    }
    const auto angles = rollPitchYaw(turned[0], turned[1], turned[2], turned[3]);
    for (std::size_t i = 0; i < 3; ++i) {
        tip.at[i] = pose.number("position", i);
        tip.at[i + 3] = known ? std::optional{angles[i]} : std::nullopt;
    }
}

// What the type calls the number that the item has.
QString label(const SimplexNow& simplex, const char* item) {
    const auto number = simplex.number(item);
    const Type* type = simplex.type();
    const DataItem* data = type != nullptr ? type->findData(item) : nullptr;
    if (!number || data == nullptr) return {};
    const auto found = data->labels.find(static_cast<std::int64_t>(*number));
    return found == data->labels.end() ? QString{} : QString::fromStdString(found->second);
}

}  // namespace

QString tipMotionName(int motion) {
    if (motion == tipElbow) return QCoreApplication::translate("Motion", "elbow");
    const QString letter{QStringLiteral("XYZ").at(motion % 3)};
    return turns(motion) ? QStringLiteral("R") + letter : letter;
}

Tip tipOf(const SystemNow& now, const std::string& controller) {
    const SimplexNow simplex = now.at(controller);
    const auto axes = simplex.related("axes");
    Tip tip;
    std::size_t counted = 0;
    for (int i = 0; i < tipElbow; ++i) {
        const auto at = static_cast<std::size_t>(i);
        tip.moves[at] = simplex.text("directions", at) == QLatin1String{"true"};
        counted += tip.moves[at] ? 1 : 0;
    }
    tip.moves[tipElbow] = axes.size() > counted;  // an axis is to spare
    findPose(tip, now, simplex);
    return tip;
}

void refresh(Tip& tip, const SystemNow& now, const std::string& controller) {
    const SimplexNow simplex = now.at(controller), pose = now.at(tip.pose);
    for (int i = 0; i < tipMotions; ++i) {
        tip.most[static_cast<std::size_t>(i)] = simplex.number(i == tipElbow ? "elbowSpeed"
                                                               : turns(i)    ? "angularSpeed"
                                                                             : "linearSpeed");
    }
    tip.holdTime = simplex.number("holdTime").value_or(0);
    tip.frame = label(simplex, "frame");
    const bool computes = simplex.live();
    tip.heldBack = computes ? label(simplex, "heldBack") : QString{};
    tip.singularDistance = computes ? simplex.number("singularDistance") : std::nullopt;
    tip.live = pose.live();
    const bool known = tip.live && tip.another.isEmpty();
    tip.speed = {known ? lengthOf(pose, "linearVelocity") : std::nullopt,
                 known ? lengthOf(pose, "angularVelocity") : std::nullopt};
    readPlace(tip, pose);
}

Order tipOrder(const std::string& controller, int motion, double velocity) {
    if (motion == tipElbow) return {controller, "elbow", {{"velocity", velocity}}};
    std::array<std::vector<double>, 2> velocities{std::vector(3, 0.0), std::vector(3, 0.0)};
    velocities[turns(motion) ? 1 : 0][static_cast<std::size_t>(motion % 3)] = velocity;
    return {controller, "jog", {{"linear", velocities[0]}, {"angular", velocities[1]}}};
}

}  // namespace cortex::explorer
