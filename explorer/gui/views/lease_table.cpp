// SPDX-License-Identifier: Apache-2.0
#include "views/lease_table.hpp"

#include "model/holders.hpp"
#include "model/plain_text.hpp"
#include "model/shown_time.hpp"
#include "model/value_text.hpp"
#include "widgets/rows.hpp"

#include <utility>

namespace cortex::gui {

namespace {

constexpr int sinceColumn = 2;

QStringList leaseTexts(const Frame& frame, const comms::ShownLease& lease) {
    return {plainText(lease.prefix), wholeNameOf(frame.control, lease.holder),
            shownTimeText(lease.since, "yyyy-MM-dd HH:mm:ss"), wholeAgeText(lease.seconds),
            lease.holder == frame.control.self ? LeaseTable::tr("you") : QString{}};
}

QStringList noLeaseTexts(const std::string& prefix) {
    return {plainText(prefix), LeaseTable::tr("nobody"), {}, {}, {}};
}

}  // namespace

LeaseTable::LeaseTable(QWidget* parent) : QTreeWidget{parent} {
    setUpRows(*this);
    setRootIsDecorated(false);
    setAccessibleName(tr("Leases"));
    setHeaderLabels({tr("Part"), tr("Held by"), QString{}, tr("For"), {}});
    keepWidths(*this, {50, 60, 44, 24});
}

void LeaseTable::show(const Frame& frame, const AgentFrame& agent) {
    const QString since = tr("Since (%1)").arg(zoneName(frame.utc));
    if (headerItem()->text(sinceColumn) != since) headerItem()->setText(sinceColumn, since);
    std::vector<comms::ShownLease> leases;
    if (agent.image) leases = comms::leasesOf(agent.status, *agent.image);
    std::vector<std::string> prefixes;
    for (const comms::ShownLease& each : leases) prefixes.push_back(each.prefix);
    const bool same = std::exchange(agent_, agent.status.name) == agent.status.name;
    const std::vector<int> places = order_.update(prefixes, same && isUsed(*this));
    count_ = static_cast<int>(leases.size());
    const int rows = static_cast<int>(places.size());
    while (topLevelItemCount() > rows) delete takeTopLevelItem(topLevelItemCount() - 1);
    while (topLevelItemCount() < rows) new QTreeWidgetItem{this};
    for (int row = 0; row < rows; ++row) {
        const int place = places[static_cast<std::size_t>(row)];
        const QStringList texts = place == HeldOrder::gone
                                      ? noLeaseTexts(order_.key(row))
                                      : leaseTexts(frame, leases[static_cast<std::size_t>(place)]);
        for (int column = 0; column < texts.size(); ++column)
            setCell(*topLevelItem(row), column, texts[column]);
    }
    for (int column = 0; column < columnCount(); ++column) growToFit(*this, column);
}

}  // namespace cortex::gui
