// SPDX-License-Identifier: Apache-2.0
#include "physics.hpp"

#include "cortex/core/error.hpp"

#include "mjcf.hpp"
#include "mujoco_errors.hpp"
#include "mujoco_model.hpp"
#include "mujoco_places.hpp"
#include "scene_checks.hpp"
#include "servo.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

namespace cortex::physics {
namespace {

// MuJoCo makes a text of the first warning alone, and allocates for it; so it begins behind that.
constexpr int toldAlready = 1 << 20;
constexpr double wholeStrain = 1 - 1e-9;  // of the greatest acceleration of a servo

// A warning of MuJoCo, and what it means here: text before and after a path.
struct Meaning {
    mjtWarning warning;
    Trouble trouble;
    const char* before;
    std::vector<std::string> MujocoPlaces::* paths = nullptr;  // that its number counts
    const char* after = "";
};

// The likelier cause comes first.
constexpr const char* gentler =
    "' left all measure; take a smaller timeStep, or gentler demands, or look at what pushes it";
constexpr std::array meanings{
    Meaning{mjWARN_CONTACTFULL, Trouble::TooManyContacts,
            "more contacts than contactLimit; raise it, or look for what stands in each other"},
    Meaning{mjWARN_CNSTRFULL, Trouble::TooManyContacts,
            "more constraints than there is room for; look for what stands in each other"},
    Meaning{mjWARN_BADCTRL, Trouble::Diverged, "what the demand of '", &MujocoPlaces::ofMotor,
            "' asks for is no usable effort; correct what writes it"},
    Meaning{mjWARN_INERTIA, Trouble::Diverged, "the inertia that '", &MujocoPlaces::ofVelocity,
            "' moves is next to none; look at the masses and inertias from there on"},
    Meaning{mjWARN_BADQPOS, Trouble::Diverged, "the position of '", &MujocoPlaces::ofPosition,
            gentler},
    Meaning{mjWARN_BADQVEL, Trouble::Diverged, "the velocity of '", &MujocoPlaces::ofVelocity,
            gentler},
    Meaning{mjWARN_BADQACC, Trouble::Diverged, "the acceleration of '", &MujocoPlaces::ofVelocity,
            gentler}};

std::string checkedText(const Scene& scene) {
    std::string all;
    for (const std::string& finding : findings(scene)) all += (all.empty() ? "" : "\n") + finding;
    if (!all.empty()) throw Error(all);
    return mjcf(scene);
}

template <class T>
std::span<T> spanOf(T* first, int count) {
    return {first, static_cast<std::size_t>(count)};
}

}  // namespace

struct Physics::Implementation {
    // What a gripper that is braked goes on with: its last demand before.
    struct Grip {
        double position = 0, force = 0;

        void keep(Archive& archive) { archive & position & force; }
    };

    // What the next step reads.
    struct State {
        std::vector<double> positions{}, velocities{}, warmStart{};
        std::vector<Grip> grips{};  // of all drives, as most scenes are small
        double time = 0;
    };

    explicit Implementation(const Scene& scene);

    void save(State& state) const;
    void putBack(const State& state);
    // Of one joint, or of both jaws of a gripper.
    double value(const mjtNum* values, int DrivePlace::Slide::* which, const DrivePlace& at) const;
    DriveInput input(const DrivePlace& drive) const;
    JointDemand demand(std::size_t place, double sinceBegin);
    double acceleration(const DrivePlace& drive, const JointDemand& demand) const;
    double effort(const DrivePlace& drive, const JointDemand& demand) const;
    void actuate(double sinceBegin);
    Trouble warned();
    Trouble advance();
    void begin();

    std::string text;
    MujocoModel model;
    MujocoData data;
    MujocoPlaces places;
    std::vector<Grip> grips{};
    State start{}, before{};
    double energy = 0, startEnergy = 0;
    int contacts = 0, startContacts = 0;
    MujocoText why{};
    // Of the step that is done: of each drive, and of each of MuJoCo's freedoms.
    std::vector<JointDemand> demands{};
    std::vector<double> accelerations{}, torques{};
    std::vector<double> strains{};  // of each drive: 1, or 0

    struct {  // what step() was asked for
        int steps = 0;
        std::span<const JointDemand> demands{};
        ServoOptions options{};
    } asked{};
};

Physics::Implementation::Implementation(const Scene& scene)
    : text{checkedText(scene)},
      model{loadModel(text)},
      data{makeData(*model)},
      places{scene, *model} {
    for (const DrivePlace& drive : places.drives) {
        const double share = drive.isGripper ? 0.5 : 1;
        data->qpos[drive.first.position] = share * drive.start;
        if (drive.isGripper) data->qpos[drive.second.position] = share * drive.start;
        grips.push_back({drive.start, 0});
    }
    demands.resize(grips.size());
    strains.resize(grips.size());
    accelerations.resize(static_cast<std::size_t>(model->nv));
    torques = accelerations;
    start.positions.resize(static_cast<std::size_t>(model->nq));
    start.velocities.resize(static_cast<std::size_t>(model->nv));
    start.warmStart.resize(static_cast<std::size_t>(model->nv));
    start.grips = grips;
    save(start);
    before = start;
    const auto look = [](void* argument) {
        auto* const in = static_cast<Implementation*>(argument);
        mj_forward(in->model.get(), in->data.get());
    };
    if (!guarded(look, this, why)) throw Error("MuJoCo cannot begin: " + std::string{why.data()});
    startEnergy = data->energy[0] + data->energy[1];
    startContacts = data->ncon;
    begin();
}

void Physics::Implementation::begin() {
    putBack(start);
    energy = startEnergy;
    contacts = startContacts;
}

void Physics::Implementation::save(State& state) const {
    std::copy_n(data->qpos, model->nq, state.positions.begin());
    std::copy_n(data->qvel, model->nv, state.velocities.begin());
    std::copy_n(data->qacc_warmstart, model->nv, state.warmStart.begin());
    std::ranges::copy(grips, state.grips.begin());
    state.time = data->time;
}

// At rest. All else in MuJoCo's data is computed anew in each step.
void Physics::Implementation::putBack(const State& state) {
    data->pstack = 0;  // an error may have left something on it
    std::ranges::copy(state.positions, data->qpos);
    std::fill_n(data->qvel, model->nv, 0);
    std::ranges::copy(state.warmStart, data->qacc_warmstart);
    std::fill_n(data->qacc, model->nv, 0);
    std::fill_n(data->actuator_force, model->nu, 0);
    std::ranges::copy(state.grips, grips.begin());
    std::ranges::fill(strains, 0);
    data->time = state.time;
}

double Physics::Implementation::value(const mjtNum* values, int DrivePlace::Slide::* which,
                                      const DrivePlace& at) const {
    return values[at.first.*which] + (at.isGripper ? values[at.second.*which] : 0);
}

DriveInput Physics::Implementation::input(const DrivePlace& drive) const {
    constexpr auto velocity = &DrivePlace::Slide::velocity;
    const double load =
        value(data->qfrc_bias, velocity, drive) - value(data->qfrc_passive, velocity, drive);
    return {value(data->qpos, &DrivePlace::Slide::position, drive),
            value(data->qvel, velocity, drive),
            drive.isGripper ? load / 2 : load,  // its effort acts on each jaw
            drive.isGripper ? drive.inertia : data->qM[drive.mass], drive.limit};
}

// What a drive is to do at this time of the cycle.
JointDemand Physics::Implementation::demand(std::size_t place, double sinceBegin) {
    JointDemand demand = asked.demands[place];
    if (demand.braked) demand.velocity = demand.effort = 0;
    if (places.drives[place].limitsForce) {
        Grip& grip = grips[place];
        if (!demand.braked) grip = {demand.position, demand.effort};
        demand.position = grip.position;
        demand.effort = grip.force;
    }
    demand.position += demand.velocity * sinceBegin;
    return demand;
}

double Physics::Implementation::acceleration(const DrivePlace& drive,
                                             const JointDemand& demand) const {
    const ServoOptions& options = asked.options;
    const double step = model->opt.timestep;
    return servoAcceleration(
        input(drive), demand,
        demand.braked ? loop(brakeRate, 1, step)
                      : loop(2 * std::numbers::pi * options.bandwidth, options.dampingRatio, step));
}

double Physics::Implementation::effort(const DrivePlace& drive, const JointDemand& demand) const {
    const DriveInput in = input(drive);
    if (drive.limitsForce) {
        return gripEffort(in, demand, gripForce(demand.effort, drive.leastForce, drive.limit),
                          model->opt.timestep);
    }
    const double wanted = acceleration(drive, demand);
    const bool carries = demand.braked || asked.options.gravityCompensation;
    return within((drive.isGripper ? drive.inertia * wanted
                                   : torques[static_cast<std::size_t>(drive.first.velocity)]) +
                      (carries ? in.load : 0) + demand.effort +
                      0 * wanted,  // what is no number stays none
                  drive.limit);
}

// The torques of an arm are those that give each axis the acceleration that its own loop wants: an
// axis alone would shake others that it is coupled to, as explicit steps can only follow so fast.
void Physics::Implementation::actuate(double sinceBegin) {
    for (std::size_t i = 0; i < places.drives.size(); ++i) {
        const DrivePlace& drive = places.drives[i];
        demands[i] = demand(i, sinceBegin);
        const DriveInput in = input(drive);
        const double wanted = acceleration(drive, demands[i]);
        strains[i] = std::abs(wanted) * in.inertia >= in.limit * wholeStrain ? 1 : 0;
        if (drive.isGripper) continue;
        accelerations[static_cast<std::size_t>(drive.first.velocity)] =
            std::isfinite(wanted) ? wanted : 0;
    }
    mj_mulM(model.get(), data.get(), torques.data(), accelerations.data());
    for (std::size_t i = 0; i < places.drives.size(); ++i)
        data->ctrl[places.drives[i].motor] = effort(places.drives[i], demands[i]);
}

// What MuJoCo counted since the begin of step(). Where it begins anew, it counts from 0.
Trouble Physics::Implementation::warned() {
    for (const Meaning& meaning : meanings) {
        const mjWarningStat& counted = data->warning[meaning.warning];
        if (counted.number == 0 || counted.number == toldAlready) continue;
        const char* path = "";
        if (meaning.paths != nullptr)
            path = (places.*meaning.paths)[static_cast<std::size_t>(counted.lastinfo)].c_str();
        std::snprintf(why.data(), why.size(), "%s%s%s", meaning.before, path, meaning.after);
        return meaning.trouble;
    }
    return Trouble::None;
}

Trouble Physics::Implementation::advance() {
    std::ranges::fill(data->warning, mjWarningStat{0, toldAlready});
    for (int i = 0; i < asked.steps; ++i) {
        mj_step1(model.get(), data.get());
        actuate(i * model->opt.timestep);
        mj_step2(model.get(), data.get());
        if (const Trouble trouble = warned(); trouble != Trouble::None) return trouble;
    }
    contacts = data->ncon;
    energy = data->energy[0] + data->energy[1];
    return Trouble::None;
}

Physics::Physics(const Scene& scene) : implementation_{std::make_unique<Implementation>(scene)} {}
Physics::~Physics() = default;
Physics::Physics(Physics&&) noexcept = default;
Physics& Physics::operator=(Physics&&) noexcept = default;

const std::string& Physics::mjcf() const { return implementation_->text; }
std::size_t Physics::joints() const { return implementation_->places.drives.size(); }
std::size_t Physics::movingBodies() const { return implementation_->places.bodies.size(); }
int Physics::contacts() const { return implementation_->contacts; }
double Physics::energy() const { return implementation_->energy; }
const char* Physics::why() const { return implementation_->why.data(); }

JointState Physics::joint(std::size_t place) const {
    const Implementation& in = *implementation_;
    const DrivePlace& drive = in.places.drives[place];
    constexpr auto velocity = &DrivePlace::Slide::velocity;
    return {in.value(in.data->qpos, &DrivePlace::Slide::position, drive),
            in.value(in.data->qvel, velocity, drive), in.value(in.data->qacc, velocity, drive),
            in.data->actuator_force[drive.motor], in.strains[place] > 0};
}

double Physics::load(std::size_t place) const {
    return implementation_->input(implementation_->places.drives[place]).load;
}

// MuJoCo has the angular velocity of a free body in the frame of that body.
BodyState Physics::body(std::size_t place) const {
    const Implementation& in = *implementation_;
    const BodyPlace& at = in.places.bodies[place];
    const mjtNum* const position = in.data->qpos + at.position;
    const mjtNum* const velocity = in.data->qvel + at.velocity;
    BodyState state;
    std::copy_n(position, 3, state.position.begin());
    state.rotation = {position[4], position[5], position[6], position[3]};
    std::copy_n(velocity, 3, state.linearVelocity.begin());
    mju_rotVecQuat(state.angularVelocity.data(), velocity + 3, position + 3);
    return state;
}

Trouble Physics::step(double seconds, int steps, std::span<const JointDemand> demands,
                      const ServoOptions& options) {
    Implementation& in = *implementation_;
    if (!(seconds > 0) || steps < 1) return Trouble::None;
    in.model->opt.timestep = seconds / steps;
    in.asked = {steps, demands, options};
    in.save(in.before);

    struct Call {
        Implementation& in;
        Trouble trouble = Trouble::Error;
    } call{in};
    const auto advance = [](void* argument) {
        auto* const to = static_cast<Call*>(argument);
        to->trouble = to->in.advance();
    };
    if (!guarded(advance, &call, in.why)) call.trouble = Trouble::Error;
    if (call.trouble != Trouble::None) in.putBack(in.before);
    return call.trouble;
}

void Physics::reset() { implementation_->begin(); }

void Physics::keep(Archive& archive) {
    Implementation& in = *implementation_;
    const mjModel& model = *in.model;
    archive.version("Physics", 1);
    archive& spanOf(in.data->qpos, model.nq) & spanOf(in.data->qvel, model.nv) &
        spanOf(in.data->qacc_warmstart, model.nv) & in.data->time & in.grips;
    // What is shown of the last step.
    archive& spanOf(in.data->qacc, model.nv) & spanOf(in.data->actuator_force, model.nu) &
        in.strains & in.contacts & in.energy;
}

}  // namespace cortex::physics
