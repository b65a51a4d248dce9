// SPDX-License-Identifier: Apache-2.0
#include "mjcf.hpp"

#include "cortex/core/value.hpp"
#include "cortex/core/xml_text.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string_view>

#include <Eigen/Geometry>

namespace cortex::physics {
namespace {

// In place of a limit that there is not, where MuJoCo asks for both.
constexpr double farAway = 1e6;

std::string attribute(std::string_view name, std::string_view value) {
    return " " + std::string{name} + "=\"" + xmlAttribute(value) + '"';
}

std::string attribute(std::string_view name, std::initializer_list<double> values) {
    return attribute(name, toText(std::vector<double>{values}));
}

std::string attribute(std::string_view name, const Triple& values) {
    return attribute(name, {values[0], values[1], values[2]});
}

Eigen::Vector3d vector(const Triple& triple) { return {triple[0], triple[1], triple[2]}; }

Triple half(const Triple& edges) { return {edges[0] / 2, edges[1] / 2, edges[2] / 2}; }

bool hasVolume(const Triple& size) { return size[0] > 0 && size[1] > 0 && size[2] > 0; }

std::string quaternion(const Eigen::Quaterniond& turn) {
    return attribute("quat", {turn.w(), turn.x(), turn.y(), turn.z()});
}

// Roll, pitch, yaw about fixed axes.
std::string place(const Triple& position, const Triple& rotation) {
    const Eigen::Quaterniond turn = Eigen::AngleAxisd(rotation[2], Eigen::Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(rotation[1], Eigen::Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(rotation[0], Eigen::Vector3d::UnitX());
    return attribute("pos", position) + quaternion(turn);
}

// Two geoms touch if the kind of one is among those that the other meets. Kind 0 are bodies, kind
// k + 1 is arm k with all that it carries.
struct Touch {
    std::uint32_t kind = 1, meets = 1;
};

Touch touchOf(std::size_t arm) {
    constexpr auto all = static_cast<std::uint32_t>(std::numeric_limits<std::int32_t>::max());
    const std::uint32_t kind = std::uint32_t{2} << arm;
    return {kind, all & ~kind};
}

std::string attributes(const Touch& touch) {
    return attribute("contype", std::to_string(touch.kind)) +
           attribute("conaffinity", std::to_string(touch.meets));
}

std::string box(const Triple& middle, const Triple& edges, const Touch& touch) {
    if (!hasVolume(edges)) return {};
    return "<geom type=\"box\"" + attribute("pos", middle) + attribute("size", half(edges)) +
           attributes(touch) + "/>\n";
}

std::string inertial(double mass, const Triple& centre, const std::array<double, 6>& inertia) {
    return "<inertial" + attribute("mass", {mass}) + attribute("pos", centre) +
           attribute("fullinertia", toText(std::vector<double>(inertia.begin(), inertia.end()))) +
           "/>\n";
}

std::array<double, 6> inertiaOfBox(double mass, const Triple& edges) {
    const auto about = [&](double a, double b) { return mass * (a * a + b * b) / 12; };
    return {
        about(edges[1], edges[2]), about(edges[0], edges[2]), about(edges[0], edges[1]), 0, 0, 0};
}

struct Drive {  // what is in MuJoCo's joint beside its place
    double min, max, armature, damping, friction;
};

std::string jointElement(const std::string& name, bool isRotary, const Triple& direction,
                         const Drive& drive) {
    const bool limited = std::isfinite(drive.min) || std::isfinite(drive.max);
    std::string text =
        "<joint" + attribute("name", name) + attribute("type", isRotary ? "hinge" : "slide") +
        attribute("axis", direction) + attribute("limited", limited ? "true" : "false");
    if (limited) {
        text += attribute("range", {std::isfinite(drive.min) ? drive.min : -farAway,
                                    std::isfinite(drive.max) ? drive.max : farAway});
    }
    return text + attribute("armature", {drive.armature}) + attribute("damping", {drive.damping}) +
           attribute("frictionloss", {drive.friction}) + "/>\n";
}

// Halfway to the next joint; where that is at the same place, or there is none, where the mass is.
Triple middleOfLink(const Joint& joint, const Joint* next) {
    if (next == nullptr || next->origin == Triple{}) return joint.centre;
    return half(next->origin);
}

// The body of one jaw. It stands along the direction; its length is along the gripper's z axis, as
// far as that is across the direction.
std::string jaw(const Gripper& gripper, int number, const Touch& touch) {
    const Joint& opening = gripper.opening;
    const Eigen::Vector3d along = vector(opening.direction);
    const bool isAcross = std::abs(along.z()) < 0.99;
    const Eigen::Vector3d other = isAcross ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
    const Eigen::Vector3d length = (other - other.dot(along) * along).normalized();
    Eigen::Matrix3d turn;
    turn << along, length.cross(along), length;

    const double side = number == 1 ? 1 : -1;
    const Eigen::Vector3d middle =
        vector(gripper.jawPosition) + side * gripper.jawSize[0] / 2 * along;
    const double mass = opening.mass / 2;
    return "<body" + attribute("name", jawName(gripper, number)) +
           attribute("pos", {middle.x(), middle.y(), middle.z()}) +
           quaternion(Eigen::Quaterniond(turn)) + ">\n" +
           inertial(mass, {}, inertiaOfBox(mass, gripper.jawSize)) +
           jointElement(jawName(gripper, number), false, {side, 0, 0},
                        {opening.min / 2, opening.max / 2, 2 * opening.armature,
                         2 * opening.damping, opening.friction}) +
           "<geom type=\"box\"" + attribute("size", half(gripper.jawSize)) + attributes(touch) +
           " condim=\"4\"/>\n</body>\n";
}

std::string gripperBody(const Gripper& gripper, const Touch& touch) {
    return "<body" + attribute("name", gripper.path) +
           place(gripper.opening.origin, gripper.opening.originRotation) + ">\n" +
           inertial(gripper.mass, gripper.centre, gripper.inertia) +
           box(gripper.centre, gripper.size, touch) + jaw(gripper, 1, touch) +
           jaw(gripper, 2, touch) + "</body>\n";
}

std::string armBodies(const Scene& scene, std::size_t arm) {
    const std::vector<Joint>& joints = scene.arms[arm].joints;
    const Touch touch = touchOf(arm);
    std::string text, end;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const Joint& joint = joints[i];
        const Joint* next = i + 1 < joints.size() ? &joints[i + 1] : nullptr;
        text +=
            "<body" + attribute("name", joint.path) + place(joint.origin, joint.originRotation) +
            ">\n" + inertial(joint.mass, joint.centre, joint.inertia) +
            jointElement(joint.path, joint.isRotary, joint.direction,
                         {joint.min, joint.max, joint.armature, joint.damping, joint.friction}) +
            box(middleOfLink(joint, next), joint.size, touch);
        end += "</body>\n";
    }
    for (const Gripper& gripper : scene.grippers) {
        if (gripper.carrier == arm) text += gripperBody(gripper, touch);
    }
    return text + end;
}

std::string sceneBody(const Body& body) {
    const Triple edges = half(body.size);
    std::string geom = "<geom" + attribute("name", body.path);
    switch (body.shape) {
        case Body::Shape::Box:
            geom += " type=\"box\"" + attribute("size", edges);
            break;
        case Body::Shape::Cylinder:
            geom += " type=\"cylinder\"" + attribute("size", {edges[0], edges[2]});
            break;
        case Body::Shape::Sphere:
            geom += " type=\"sphere\"" + attribute("size", {edges[0]});
            break;
    }
    // Its friction counts against jaws and links, which have none of their own to state.
    geom += attribute("friction", {body.friction, 0.005, 0.0001}) + attributes(Touch{}) +
            attribute("condim", "4") + attribute("priority", "1");
    const std::string where = place(body.position, body.rotation);
    if (body.mass <= 0) return geom + where + "/>\n";
    return "<body" + attribute("name", body.path) + where + ">\n<freejoint" +
           attribute("name", body.path) + "/>\n" + geom + attribute("mass", {body.mass}) +
           "/>\n</body>\n";
}

std::string world(const Scene& scene) {
    std::string text = "<worldbody>\n";
    for (const Body& body : scene.bodies) text += sceneBody(body);
    for (std::size_t i = 0; i < scene.arms.size(); ++i) text += armBodies(scene, i);
    std::size_t kind = scene.arms.size();
    for (const Gripper& gripper : scene.grippers) {
        if (!gripper.carrier) text += gripperBody(gripper, touchOf(kind++));
    }
    return text + "</worldbody>\n";
}

// The first link of an arm stands on what is fixed.
std::string exclusions(const Scene& scene) {
    std::string text = "<contact>\n";
    for (const Arm& arm : scene.arms) {
        text += "<exclude body1=\"world\"" + attribute("body2", arm.joints.front().path) + "/>\n";
    }
    return text + "</contact>\n";
}

std::string couplings(const Scene& scene) {
    std::string equal, tendons;
    for (const Gripper& gripper : scene.grippers) {
        const std::string first = jawName(gripper, 1), second = jawName(gripper, 2);
        equal += "<joint" + attribute("joint1", first) + attribute("joint2", second) + "/>\n";
        tendons += "<fixed" + attribute("name", gripper.opening.path) + "><joint" +
                   attribute("joint", first) + " coef=\"1\"/><joint" + attribute("joint", second) +
                   " coef=\"1\"/></fixed>\n";
    }
    return "<equality>\n" + equal + "</equality>\n<tendon>\n" + tendons + "</tendon>\n";
}

std::string motor(const Joint& joint, std::string_view drives) {
    const bool limited = joint.effort > 0 && std::isfinite(joint.effort);
    return "<motor" + attribute("name", joint.path) + attribute(drives, joint.path) +
           attribute("ctrllimited", limited ? "true" : "false") +
           (limited ? attribute("ctrlrange", {-joint.effort, joint.effort}) : "") + "/>\n";
}

std::string motors(const Scene& scene) {
    std::string text = "<actuator>\n";
    for (const Arm& arm : scene.arms) {
        for (const Joint& joint : arm.joints) text += motor(joint, "joint");
    }
    for (const Gripper& gripper : scene.grippers) text += motor(gripper.opening, "tendon");
    return text + "</actuator>\n";
}

// The memory that MuJoCo has for all steps. Its own choice is 200 MB and more for 500 contacts.
std::string sizes(const Scene& scene) {
    std::size_t joints = 2 * scene.grippers.size(), moving = 0;
    for (const Arm& arm : scene.arms) joints += arm.joints.size();
    for (const Body& body : scene.bodies) moving += body.mass > 0 ? 1 : 0;
    const std::size_t freedoms = joints + 6 * moving;
    // Rows of constraints: of a contact, of limit and friction of a joint, of two coupled jaws.
    const std::size_t rows =
        4 * static_cast<std::size_t>(scene.contactLimit) + 2 * joints + scene.grippers.size();
    // Measured in piles of bodies: 3.5 times the square at most.
    const std::size_t scratch = 65536 + 8 * freedoms * freedoms + 16 * rows;
    return "<size" + attribute("nconmax", std::to_string(scene.contactLimit)) +
           attribute("njmax", std::to_string(rows)) + attribute("nstack", std::to_string(scratch)) +
           "/>\n";
}

}  // namespace

std::string jawName(const Gripper& gripper, int jaw) {
    return gripper.opening.path + '#' + std::to_string(jaw);
}

std::string mjcf(const Scene& scene) {
    return "<mujoco>\n<compiler angle=\"radian\"/>\n" + sizes(scene) + "<option" +
           attribute("timestep", {scene.timeStep}) + attribute("gravity", scene.gravity) +
           " cone=\"elliptic\" impratio=\"100\" solver=\"Newton\" iterations=\"50\""
           " tolerance=\"1e-10\">\n<flag energy=\"enable\" multiccd=\"enable\"/>\n</option>\n" +
           // Four times as hard as MuJoCo's own: a gripper would sink into what it holds by
           // millimetres. Steps of more than half of this time take a softer one. More than one
           // point of contact of a pair of round bodies, so that a cylinder stands still.
           "<default><geom solref=\"0.005 1\" solimp=\"0.95 0.99 0.001\"/></default>\n" +
           world(scene) + exclusions(scene) + couplings(scene) + motors(scene) + "</mujoco>\n";
}

}  // namespace cortex::physics
