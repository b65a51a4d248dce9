// SPDX-License-Identifier: Apache-2.0
#include "model/holders.hpp"

#include "cortex/core/path.hpp"

#include "common/person_name.hpp"
#include "model/plain_text.hpp"
#include "session/lease.hpp"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>
#include <set>

namespace cortex::gui {

namespace {

constexpr int longestInButton = 20;  // letters

QString shown(const std::string& name) { return isolatedText(common::shownName(name)); }

QString nameWith(const std::string& name, const std::string& person) {
    return person.empty() ? shown(name) : QStringLiteral("%1 (%2)").arg(shown(person), shown(name));
}

}  // namespace

QString wholeNameOf(const Control& control, const std::string& holder) {
    return nameWith(holder, common::personOf(control.tools, holder));
}

QString shortNameOf(const Control& control, const std::string& holder) {
    const std::string person = common::personOf(control.tools, holder);
    const auto same = std::ranges::count(control.tools, person, &comms::ToolStatus::person);
    return shown(person.empty() || same > 1 || person == control.person ? holder : person);
}

QString ownName(const Control& control) { return nameWith(control.self, control.person); }

QString cutName(const QString& name, int letters) {
    return name.size() <= letters ? name : name.left(letters - 1) + QStringLiteral("…");
}

QString joined(const QStringList& names) {
    if (names.size() < 2) return names.join(QString{});
    return QCoreApplication::translate("Holders", "%1 and %2")
        .arg(names.mid(0, names.size() - 1).join(QStringLiteral(", ")), names.back());
}

std::vector<std::string> holdersAt(const Frame& frame, const std::string& prefix) {
    std::set<std::string> holders;
    for (const AgentFrame& agent : frame.agents) {
        if (agent.lost() || !hasBelow(agent, prefix)) continue;
        for (const comms::ShownLease& each : leasesOf(agent)) {
            const bool meets = isAtOrBelow(prefix, each.prefix) || isAtOrBelow(each.prefix, prefix);
            if (meets && each.holder != frame.control.self) holders.insert(each.holder);
        }
    }
    return {holders.begin(), holders.end()};
}

std::vector<std::string> canBeAsked(const Frame& frame, const std::string& prefix) {
    auto holders = holdersAt(frame, prefix);
    std::erase_if(holders, [&](const std::string& each) {
        return common::personOf(frame.control.tools, each).empty();
    });
    return holders;
}

QString askText(const Frame& frame, const std::string& prefix) {
    const auto asked = canBeAsked(frame, prefix);
    if (asked.empty()) return {};
    if (asked.size() > 1)
        return QCoreApplication::translate("Holders", "Ask %1 people").arg(asked.size());
    return QCoreApplication::translate("Holders", "Ask %1")
        .arg(cutName(shortNameOf(frame.control, asked.front()), longestInButton)
                 .replace('&', QLatin1String{"&&"}));
}

QStringList uncontrolled(const Frame& frame, const std::string& prefix) {
    QStringList names;
    for (const AgentFrame& agent : frame.agents) {
        const bool has = prefix == "/" || hasBelow(agent, prefix);
        if (!has || agent.status.ended || frame.control.covers(agent.status.name, prefix)) continue;
        names << QString::fromStdString(agent.status.name);
    }
    return names;
}

bool canBeTaken(const Frame& frame, const std::string& prefix) {
    bool any = false;
    for (const AgentFrame& agent : frame.agents) {
        if (agent.lost() || !hasBelow(agent, prefix)) continue;
        if (frame.control.covers(agent.status.name, prefix)) continue;
        if (leaseOfOthers(agent, prefix, frame.control.self)) return false;
        any = true;
    }
    return any;
}

bool isFree(const Frame& frame, const std::string& prefix) {
    bool any = false;
    for (const AgentFrame& agent : frame.agents) {
        if (agent.status.ended || !hasBelow(agent, prefix)) continue;
        if (agent.isSilent() || !agent.came(agent.own())) return false;
        if (leaseOfOthers(agent, prefix, {})) return false;
        any = true;
    }
    return any;
}

}  // namespace cortex::gui
