// SPDX-License-Identifier: Apache-2.0
#include "mirror_endpoints.hpp"

#include "ids.hpp"
#include "security_identity.hpp"

#include <utility>

namespace cortex::comms {
namespace {

constexpr std::chrono::milliseconds presencePeriod{100};

const Topic& viewTopic(std::uint32_t rate) {
    switch (rate) {
        case 5:
            return topics::view5;
        case 30:
            return topics::view30;
        case 100:
            return topics::view100;
        default:
            return topics::viewEvery;
    }
}

Presence presenceOf(const Sender& tool) {
    Presence presence;
    presence.name = tool.nameText();
    presence.agent = agentId(presence.name);
    presence.host = tool.host.data();
    presence.epoch = tool.epoch;
    presence.role = "tool";
    presence.state = "running";
    presence.majors = {1};
    return presence;
}

}  // namespace

MirrorEndpoints::MirrorEndpoints(const NetworkOptions& options, const Sender& tool,
                                 MirrorInbox& inbox)
    : tool_{tool},
      inbox_{inbox},
      participant_{options, std::string{tool.nameText()}},
      self_{presenceOf(tool)} {
    if (participant_.identity() != nullptr) self_.security = securityOn;
    presences_ = participant_.reader<Presence>(
        topics::presence, [this](Presence&& sample) { inbox_.push(std::move(sample)); },
        [this](const Id& agent) { inbox_.push(Withdrawn{agent}); });
    models_ = participant_.reader<Model>(
        topics::model, [this](Model&& sample) { inbox_.push(std::move(sample)); });
}

MirrorEndpoints::~MirrorEndpoints() {
    if (presence_) presence_->dispose(self_);
}

// Before anything of us can matter to an agent: that we are here.
void MirrorEndpoints::speak() {
    if (presence_) return;
    presence_ = participant_.writer<Presence>(topics::presence);
    presence_->write(self_);
}

void MirrorEndpoints::view(const MirrorView& view) {
    if (view.prefixes.empty()) {
        blocks_.reset();
        viewRate_.reset();
        return;
    }
    speak();
    if (!model_) model_ = participant_.writer<Model>(topics::model);
    if (viewRate_ == view.rate) return;
    viewRate_ = view.rate;
    blocks_.reset();
    blocks_ = participant_.reader<Block>(
        viewTopic(view.rate), [this](Block&& sample) { inbox_.push(std::move(sample)); });
}

void MirrorEndpoints::command() {
    if (commands_) return;
    speak();
    answers_ = participant_.reader<Answer>(
        topics::answer, [this](Answer&& sample) { inbox_.push(std::move(sample)); });
    commands_ = participant_.writer<Command>(topics::command);
}

bool MirrorEndpoints::write(const Command& command) {
    if (participant_.identity() == nullptr) return commands_->write(command);
    Command proven = command;
    participant_.identity()->sign(proven);
    return commands_->write(proven);
}

void MirrorEndpoints::listen() {
    if (events_) return;
    events_ = participant_.reader<EventMessage>(
        topics::event, [this](EventMessage&& sample) { inbox_.push(std::move(sample)); });
}

void MirrorEndpoints::tell(const MirrorAgents& agents, const MirrorView& view, Moment now) {
    if (presence_ && now - spoke_ >= presencePeriod) {
        presence_->write(self_);
        spoke_ = now;
    }
    if (!model_) return;
    for (const auto& [name, agent] : agents.all()) {
        Interest interest;
        interest.target = name;
        interest.targetEpoch = agent.model.epoch();
        // What it has is not known at first: asked all the same, its values come with its model.
        const bool mayShow = agent.tables || (!agent.structure && !view.prefixes.empty());
        if (mayShow) interest.views.push_back({view.rate, view.prefixes});
        want(name, std::move(interest));
    }
}

void MirrorEndpoints::want(const std::string& agent, Interest interest) {
    const auto told = told_.find(agent);
    if (told == told_.end() ? interest.views.empty() : told->second == interest) return;
    told_[agent] = interest;
    Model model;
    model.agent = self_.name;
    model.id = modelId(self_.name, "interest", agent);
    model.epoch = self_.epoch;
    model.interests.push_back(std::move(interest));
    model_->write(model);
}

}  // namespace cortex::comms
