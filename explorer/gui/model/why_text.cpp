// SPDX-License-Identifier: Apache-2.0
#include "model/why_text.hpp"

#include "model/fault_text.hpp"
#include "model/plain_text.hpp"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>

namespace cortex::gui {

namespace {

constexpr int mostCauses = 4;

QString sayWhy(const char* text) { return QCoreApplication::translate("Why", text); }

QString pathOf(const Frame& frame, Place place) {
    return QString::fromStdString(frame.info(place).path);
}

// "/control/hold (Active, lost)".
QString named(const Frame& frame, Place place) {
    const AgentFrame& agent = frame.agents[place.agent];
    QStringList how;
    if (const auto state = agent.state(place.simplex)) how << QLatin1String{name(*state)};
    const Quality quality = agent.lost() ? Quality::Lost : agent.quality(place.simplex);
    if (quality != Quality::Good && !agent.rests(place.simplex)) {
        how << QLatin1String{name(quality)};
    }
    const QString path = pathOf(frame, place);
    return how.isEmpty() ? path : QStringLiteral("%1 (%2)").arg(path, how.join(", "));
}

// What made it not good, as its agent says; null: itself, or it is good.
const SimplexInfo* saidCause(const Frame& frame, Place place) {
    const AgentFrame& agent = frame.agents[place.agent];
    if (!agent.came(place.simplex) || agent.quality(place.simplex) == Quality::Good) return nullptr;
    const std::uint32_t cause = (*agent.image)->state(place.simplex).cause;
    const auto& all = agent.structure->simplexes;
    return cause < all.size() && cause != place.simplex ? &all[cause] : nullptr;
}

// One of another agent is looked for there.
std::optional<Place> placeOf(const Frame& frame, Place seenFrom, const SimplexInfo& info) {
    if (info.remote) return frame.find(info.path);
    return Place{seenFrom.agent, frame.agents[seenFrom.agent].structure->find(info.path)};
}

QString causesOf(const Frame& frame, Place place) {
    QStringList causes;
    const SimplexInfo* cause = saidCause(frame, place);
    while (cause != nullptr && causes.size() < mostCauses) {
        const auto next = placeOf(frame, place, *cause);
        const QString text =
            next ? named(frame, *next)
                 : sayWhy("%1, which is not heard").arg(QString::fromStdString(cause->path));
        if (causes.contains(text)) break;
        causes << text;
        if (!next) break;
        place = *next;
        cause = saidCause(frame, place);
    }
    return causes.join(QStringLiteral(" ← "));
}

// That which has ended has a sentence of its own.
QString notGoodBecause(const Frame& frame, Place place) {
    if (frame.goneInput(place)) return {};
    const QString causes = causesOf(frame, place);
    if (causes.isEmpty()) return {};
    if (lostInput(frame, place)) return sayWhy("Input lost: %1.").arg(causes);
    return sayWhy("Quality %1 because of %2.")
        .arg(QLatin1String{name(frame.agents[place.agent].quality(place.simplex))}, causes);
}

QString writersOf(const Frame& frame, Place place) {
    QStringList writers;
    for (const std::uint32_t each : frame.info(place).writers) {
        writers << named(frame, {place.agent, each});
    }
    return writers.join(sayWhy(", "));
}

// A demand whose writer is at rest, or has lost an input, has its safe values.
QString staleBecause(const Frame& frame, Place place) {
    const common::StaleDemand demand = frame.agents[place.agent].stale(place.simplex);
    if (demand.why.empty()) return {};
    return (demand.safe ? sayWhy("Safe values, as %1.") : sayWhy("Stale, as %1."))
        .arg(plainText(demand.why));
}

// "lifter2 has it in Fault −7: the axis does not follow."
QString faultsOfOthers(const Frame& frame, Place place, const comms::Contested& contest,
                       const StateTimes& times) {
    QString text;
    for (std::uint32_t i = 0; i < frame.agents.size(); ++i) {
        const AgentFrame& agent = frame.agents[i];
        if (i == place.agent || !agent.structure) continue;
        const std::uint32_t simplex = agent.structure->find(contest.path);
        if (simplex == noSimplex || agent.state(simplex) != State::Fault) continue;
        const QString why = faultText(frame, {i, simplex}, times).text;
        text += sayWhy(" %1 has it in Fault%2%3.")
                    .arg(QString::fromStdString(agent.status.name), faultCode(agent, simplex),
                         why.isEmpty() ? QString{} : QStringLiteral(": ") + why);
    }
    return text;
}

}  // namespace

QString whyText(const Frame& frame, Place place) {
    QStringList sentences;
    const QString writers = writersOf(frame, place);
    if (!writers.isEmpty()) sentences << sayWhy("Written by %1.").arg(writers);
    const QString stale = staleBecause(frame, place);
    sentences << (stale.isEmpty() ? notGoodBecause(frame, place) : stale);
    sentences.removeAll({});
    return sentences.join(' ');
}

std::optional<std::string> lostInput(const Frame& frame, Place place) {
    const AgentFrame& agent = frame.agents[place.agent];
    if (agent.lost() || agent.quality(place.simplex) != Quality::Lost) return {};
    for (int step = 0; step < mostCauses; ++step) {
        const SimplexInfo* cause = saidCause(frame, place);
        if (cause == nullptr) return {};
        if (cause->remote) return cause->path;
        place.simplex = agent.structure->find(cause->path);
    }
    return {};
}

// The sentence of all tools. Of a lost agent nothing is claimed any more.
QString claimsText(const Frame& frame, Place place, const StateTimes& times) {
    const comms::Contested* contest = frame.contestOf(frame.info(place).path);
    if (contest == nullptr || frame.agents[place.agent].lost()) return {};
    QString text = QString::fromStdString(contest->text) + '.';
    text.front() = text.front().toUpper();
    return text + faultsOfOthers(frame, place, *contest, times);
}

}  // namespace cortex::gui
