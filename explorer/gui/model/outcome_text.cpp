// SPDX-License-Identifier: Apache-2.0
#include "model/outcome_text.hpp"

#include "model/plain_text.hpp"
#include "model/shown_time.hpp"
#include "model/value_text.hpp"

#include <QCoreApplication>
#include <cmath>

namespace cortex::gui {

namespace {

QString tell(const char* text) { return QCoreApplication::translate("Outcome", text); }

// When the window had the outcome.
QString timeOf(const CommandOutcome& outcome) {
    if (outcome.came == 0) return {};
    return QStringLiteral("  ") + timeAndZone(outcome.came, "HH:mm:ss.zzz");
}

QString doneText(const CommandOutcome& outcome, const Command* command) {
    const double seconds = std::chrono::duration<double>(outcome.answer.latency).count();
    const QString cycles = QCoreApplication::translate(
        "Outcome", "%n cycles", nullptr, static_cast<int>(outcome.answer.latencyCycles));
    QString text = tell("Done  %1, %2").arg(ageText(seconds), cycles) + timeOf(outcome);
    for (const auto& [name, value] : outcome.answer.response) {
        QString shown = QString::fromStdString(toText(value));
        if (command != nullptr) {
            for (const DataItem& item : command->response) {
                if (item.name == name) shown = valueText(item, value) + ' ' + unitText(item.unit);
            }
        }
        text += QStringLiteral("\n%1 = %2").arg(QString::fromStdString(name), shown.trimmed());
    }
    return text;
}

QString failureText(const CommandOutcome& outcome) {
    if (!outcome.problem.empty()) {
        return tell("Not sent: %1").arg(QString::fromStdString(outcome.problem));
    }
    const CallResult& answer = outcome.answer;
    if (answer.outcome == Outcome::Unknown) {
        return tell(
            "No answer came. The command may have been executed. Look at the state before "
            "you send it again.");
    }
    if (answer.reason == Reason::Restarted) {
        return tell("Not executed: the agent had started anew.");
    }
    if (answer.outcome == Outcome::Expired) {
        return tell("Not executed: it reached the agent too late.");
    }
    return QString::fromStdString(answer.text());
}

template <class T>
std::optional<T> firstOf(const AgentFrame& agent, std::uint32_t simplex, const char* name) {
    const ItemLayout* item = agent.structure->simplexes[simplex].layout->find(name);
    if (item == nullptr) return std::nullopt;
    const Value value = (*agent.image)->value(simplex, *item);
    const auto* all = std::get_if<std::vector<T>>(&value);
    return all != nullptr && !all->empty() ? std::optional<T>{all->front()} : std::nullopt;
}

}  // namespace

QString outcomeText(const CommandOutcome& outcome, const Command* command) {
    const CallResult& answer = outcome.answer;
    if (outcome.problem.empty() && answer.done()) return doneText(outcome, command);
    return failureText(outcome) + timeOf(outcome);
}

std::optional<ActivityNow> activityOf(const AgentFrame& agent, std::uint32_t simplex) {
    if (agent.lost() || !agent.came(simplex)) return std::nullopt;
    const auto command = firstOf<std::string>(agent, simplex, "activity");
    const auto requester = firstOf<std::string>(agent, simplex, "requester");
    const auto progress = firstOf<double>(agent, simplex, "progress");
    const auto outcome = firstOf<std::int64_t>(agent, simplex, "outcome");
    if (!command || !requester || !progress || !outcome) return std::nullopt;
    return ActivityNow{QString::fromStdString(*command), QString::fromStdString(*requester),
                       std::isfinite(*progress) ? *progress : 0,
                       *outcome == static_cast<std::int64_t>(Outcome::Running)};
}

}  // namespace cortex::gui
