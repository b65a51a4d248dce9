// SPDX-License-Identifier: Apache-2.0
#include "window/control_news.hpp"

#include "model/holders.hpp"
#include "model/permission.hpp"
#include "session/lease.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <map>
#include <utility>

namespace cortex::gui {

namespace {

QString inNews(const char* text) { return QCoreApplication::translate("ControlNews", text); }

// "/drive", "everything of mixer and robot".
QString gainText(const comms::LeaseClient::Asked& asked) {
    std::map<std::string, QStringList> agents;
    for (const auto& each : asked.gives) agents[each.prefix] << QString::fromStdString(each.agent);
    QStringList parts;
    for (const auto& [prefix, of] : agents) {
        parts << (prefix == "/" ? inNews("%1 of %2").arg(scopeText(prefix), joined(of))
                                : scopeText(prefix));
    }
    return joined(parts);
}

QString cannotBeAsked(const QString& name) {
    return inNews("%1 cannot be asked, as it does not say who uses it.").arg(name);
}

}  // namespace

void ControlNews::refresh(const Frame& frame) {
    const Control& control = frame.control;
    if (!control.asked.empty()) {
        row_ = question(control);
        key_ = {};
        return;
    }
    const bool asks = !control.asking.prefix.empty();
    row_ = notice(frame);
    if (asks) row_ = {asking(frame), inNews("Withdraw"), {}, Act::Withdraw, {}, {}};
    key_ = asks ? Key{0, row_.text} : Key{control.told + 1, {}};
    if (key_ == closed_) row_ = {};
}

void ControlNews::close() {
    if (row_.act == Act::Grant) return;
    closed_ = key_;
    row_ = {};
}

ControlNews::Row ControlNews::question(const Control& control) {
    const auto& first = control.asked.front();
    const QString scope = scopeText(first.prefix), gain = gainText(first);
    Row row{inNews("%1 asks for %2.").arg(wholeNameOf(control, first.tool), scope),
            inNews("Hand over"),
            inNews("Refuse"),
            Act::Grant,
            first.prefix,
            first};
    if (gain != scope) row.text += ' ' + inNews("Hand over gives %1.").arg(gain);
    const auto more = control.asked.size() - 1;
    if (more > 0)
        row.text += ' ' + (more == 1 ? inNews("1 more asks.") : inNews("%1 more ask.").arg(more));
    return row;
}

QString ControlNews::asking(const Frame& frame) {
    const Control& control = frame.control;
    QStringList asked, refused, silent;
    for (const auto& each : control.asking.holders) {
        const QString name = wholeNameOf(control, each.name);
        (each.person.empty() ? silent : each.refused ? refused : asked) << name;
    }
    const QString scope = scopeText(control.asking.prefix);
    QStringList parts;
    parts << (asked.isEmpty() ? inNews("Asking for %1.").arg(scope)
                              : inNews("Asking %1 for %2.").arg(joined(asked), scope));
    if (!refused.isEmpty()) parts << inNews("Refused by %1.").arg(joined(refused));
    if (!silent.isEmpty()) parts << cannotBeAsked(joined(silent));
    return parts.join(' ');
}

ControlNews::Row ControlNews::notice(const Frame& frame) {
    const Control& control = frame.control;
    if (std::exchange(told_, control.told) != control.told) seen_.clear();
    if (!control.refused.empty()) return refusal(frame);
    Row row{QString::fromStdString(control.notice), {}, {}, Act::None, {}, {}};
    if (row.text.isEmpty()) return row;
    const auto isFreeNow = [&](const std::string& each) { return isFree(frame, each); };
    if (!control.handed.empty() && std::ranges::all_of(control.handed, isFreeNow)) {
        QStringList scopes;
        for (const std::string& each : control.handed) scopes << scopeText(each);
        row.text += ' ' + inNews("Nobody holds it now: %1 is free.").arg(joined(scopes));
    }
    row.prefix = control.sought.empty() ? control.last : control.sought;
    if (!control.asks.empty() || !canBeTaken(frame, row.prefix)) return row;
    row.act = Act::Take;
    row.remedy = (row.prefix == control.last ? inNews("Take %1 again") : inNews("Take %1"))
                     .arg(scopeText(row.prefix));
    return row;
}

// A refusal follows the leases: it says who holds a part by now, or that nobody else does. What an
// agent said in words stays until it shows who that is.
ControlNews::Row ControlNews::refusal(const Frame& frame) {
    const Control& control = frame.control;
    const std::string& prefix = control.refused;
    QStringList lines;
    for (const AgentFrame& agent : frame.agents) {
        if (agent.lost() || !hasBelow(agent, prefix)) continue;
        const std::string& name = agent.status.name;
        if (const auto lease = leaseOfOthers(agent, prefix, control.self)) {
            seen_.insert(name);
            lines << inNews("%1: %2 holds %3, and must release it or hand it over.")
                         .arg(QString::fromStdString(name), wholeNameOf(control, lease->holder),
                              QString::fromStdString(lease->prefix));
        }
    }
    for (const Control::Refusal& each : control.refusals) {
        if (!seen_.contains(each.agent))
            lines << QString::fromStdString(each.agent + ": " + each.why + ".");
    }
    Row row{{}, {}, {}, Act::None, prefix, {}};
    if (lines.isEmpty()) {
        lines << inNews("Nobody else holds a part of it any longer.");
        row.act = Act::Take;
        row.remedy = inNews("Take %1").arg(scopeText(prefix));
    } else if (const QString ask = askText(frame, prefix); !ask.isEmpty()) {
        row.act = Act::Ask;
        row.remedy = inNews("%1 for it").arg(ask);
    } else if (const auto holders = holdersAt(frame, prefix); !holders.empty()) {
        lines << cannotBeAsked(wholeNameOf(control, holders.front()));
    }
    row.text = QString::fromStdString(control.notice) + ' ' + lines.join(' ');
    if (!control.asks.empty()) row.remedy.clear();
    return row;
}

}  // namespace cortex::gui
