// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_endpoints.hpp"

#include "security/security_identity.hpp"
#include "wire/ids.hpp"
#include "wire/presence_extras.hpp"
#include "wire/presence_interval.hpp"

#include <utility>

namespace cortex::comms {
namespace {

// By stream.
const std::array<const Topic*, viewRates.size()> viewTopics{&topics::viewEvery, &topics::view100,
                                                            &topics::view30, &topics::view5};

Presence presenceOf(const Sender& tool) {
    Presence presence;
    presence.name = tool.nameText();
    presence.agent = agentId(presence.name);
    presence.host = tool.host.data();
    presence.epoch = tool.epoch;
    presence.role = "tool";
    presence.state = "running";
    presence.majors = {1};
    presence.interval = shortestInterval;
    return presence;
}

}  // namespace

MirrorEndpoints::MirrorEndpoints(const NetworkOptions& options, const Sender& tool,
                                 MirrorInbox& inbox)
    : tool_{tool},
      inbox_{inbox},
      participant_{options, std::string{tool.nameText()}, Participant::Speaks::WhenTold},
      self_{presenceOf(tool)} {
    if (participant_.identity() != nullptr) self_.security = securityOn;
    presences_ = participant_.reader<Presence>(
        topics::presence, [this](Presence&& sample) { inbox_.push(std::move(sample)); },
        [this](const Id& agent) { inbox_.push(Withdrawn{agent}); });
    models_ = participant_.reader<Model>(
        topics::model, [this](Model&& sample) { inbox_.push(std::move(sample)); });
    participant_.speak();
}

MirrorEndpoints::~MirrorEndpoints() {
    participant_.stopListening();
    if (!presence_) return;
    self_.state = "stopping";
    presence_->write(self_);
    presence_->dispose(self_);
}

// An agent must know of this tool before it can act on anything else of it.
void MirrorEndpoints::speak() {
    if (presence_) return;
    presence_ = participant_.writer<Presence>(topics::presence);
    presence_->write(self_);
}

void MirrorEndpoints::view(const MirrorView& view, bool summarised) {
    if (view == view_ && summarised == (summaries_ != nullptr)) return;
    view_ = view;
    const bool looks = summarised || !view.empty();
    if (looks) speak();
    viewSummaries(summarised);
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        if (view.prefixes[i].empty()) {
            blocks_[i].reset();
        } else if (!blocks_[i]) {
            blocks_[i] = participant_.reader<Block>(*viewTopics[i], [this, i](Block&& sample) {
                inbox_.push(StreamBlock{std::move(sample), i});
            });
        }
    }
    if (looks && !interests_) interests_ = participant_.writer<Interest>(topics::interest);
    if (!interests_) return;
    Interest interest;
    interest.agent = self_.agent;
    interest.name = self_.name;
    interest.epoch = self_.epoch;
    for (std::size_t i = 0; i < viewRates.size(); ++i) {
        if (!view.prefixes[i].empty()) interest.views.push_back({viewRates[i], view.prefixes[i]});
    }
    if (summarised) interest.extras.push_back({summaries, "1"});
    interests_->write(interest);
}

void MirrorEndpoints::viewSummaries(bool wanted) {
    if (!wanted) {
        summaries_.reset();
    } else if (!summaries_) {
        summaries_ = participant_.reader<Summary>(
            topics::summary, [this](Summary&& sample) { inbox_.push(std::move(sample)); });
    }
}

void MirrorEndpoints::command() {
    if (commands_) return;
    speak();
    answers_ = participant_.reader<Answer>(
        topics::answerTo(self_.name), [this](Answer&& sample) { inbox_.push(std::move(sample)); });
    commands_ = participant_.writer<Command>(topics::command);
    renewExtras();
}

void MirrorEndpoints::say(const ToolWords& words) {
    if (words == words_) return;
    words_ = words;
    speak();
    renewExtras();
}

void MirrorEndpoints::renewExtras() {
    self_.extras = words_.extras();
    if (commands_) self_.extras.push_back({commandsOthers, "1"});
    presence_->write(self_);
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

void MirrorEndpoints::hearPast() {
    if (past_) return;
    past_ = participant_.reader<PastMessage>(topics::past, [this](PastMessage&& sample) {
        if (sample.tool == tool_.nameText()) inbox_.push(std::move(sample));
    });
}

void MirrorEndpoints::announce(const MirrorAgents& agents, Moment now) {
    if (presence_ && (now - spoke_).count() >= self_.interval) {
        self_.interval = intervalAmong(presence_->readers());
        presence_->write(self_);
        spoke_ = now;
    }
    const bool stood = (now - std::exchange(announced_, now)).count() > leaseOfParticipant / 2;
    if (agents.missesAny() || stood) participant_.announce();
}

}  // namespace cortex::comms
