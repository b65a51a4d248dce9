// SPDX-License-Identifier: Apache-2.0
// What stands at the end of the header: its agent, age, quality and task.
#include "model/item_of.hpp"
#include "model/value_text.hpp"
#include "model/why_text.hpp"
#include "views/simplex_header.hpp"
#include "widgets/text_label.hpp"

#include <QPushButton>

namespace cortex::gui {

namespace {

// Nothing of it changes by itself, so that its age says nothing.
bool neverChanges(const SimplexInfo& info) {
    return info.role != Role::Active && info.writers.empty();
}

// "task 2.3 µs of 1 ms".
QString taskText(const AgentFrame& agent, std::uint32_t simplex) {
    const auto time = itemOf<double>(agent, simplex, "taskTime");
    if (!time || agent.lost()) return {};
    const double period =
        static_cast<double>(agent.status.period) * agent.structure->simplexes[simplex].every;  // ns
    return SimplexHeader::tr("task %1 µs of %2 ms")
        .arg(*time, 0, 'f', 1)
        .arg(period * 1e-6, 0, 'g', 4);
}

}  // namespace

// In fewer words where there is little room.
bool SimplexHeader::isTerse() const { return brief_ || Look::isLow(*this); }

QString SimplexHeader::factsOf(const QString& agent, const QString& age) const {
    const QString name = isTerse() ? agent : tr("agent %1").arg(agent);
    return age.isEmpty() ? name : tr("%1, %2 old").arg(name, age);
}

QString SimplexHeader::qualityText(Quality quality) const {
    const QString word{QLatin1String{name(quality)}};
    return isTerse() ? word : tr("quality %1").arg(word);
}

// What rests writes nothing, or nothing writes it: that it is not good is as it should be.
QString SimplexHeader::restText(bool isData) const {
    if (isTerse()) return tr("at rest");
    return isData ? tr("at rest: not written") : tr("at rest: writes nothing");
}

QString SimplexHeader::waitingText() const {
    return isTerse() ? tr("no values yet") : tr("waiting for the first values");
}

void SimplexHeader::refreshAgent(const Frame& frame, Place place) {
    const AgentFrame& agent = frame.agents[place.agent];
    const auto age = agent.age(place.simplex);
    const Excuse excuse = frame.excuse(place);
    agentName_ = QString::fromStdString(agent.status.name);
    const bool ages = agent.lost() || (excuse != Excuse::Rests && !neverChanges(frame.info(place)));
    agent_->show(factsOf(agentName_, age && ages ? ageText(*age) : QString{}));
    const bool came = agent.came(place.simplex);
    const Quality quality = agent.lost() ? Quality::Lost : agent.quality(place.simplex);
    const bool amiss = came && quality != Quality::Good && excuse == Excuse::None;
    const bool lacks = quality == Quality::Lost && lostInput(frame, place);
    const QString said = lacks ? tr("input lost") : qualityText(quality);
    const bool rests = excuse == Excuse::Rests;
    quality_->show(!came   ? waitingText()
                   : rests ? restText(!hasStates_)
                           : said,
                   amiss ? &Tokens::dataText : &Tokens::ink2);
    quality_->explain(rests
                          ? tr("In Standby nothing is written, so the values are those of before: "
                               "quality %1. That is as it should be.")
                                .arg(QLatin1String{name(quality)})
                          : QString{});
    task_->show(taskText(agent, place.simplex));
    dismiss_->setVisible(agent.lost());
}

}  // namespace cortex::gui
