// SPDX-License-Identifier: Apache-2.0
#include "views/lease_table.hpp"

#include "model/plain_text.hpp"
#include "model/value_text.hpp"
#include "widgets/rows.hpp"

namespace cortex::gui {

LeaseTable::LeaseTable(QWidget* parent) : QTreeWidget{parent} {
    setUpRows(*this);
    setRootIsDecorated(false);
    setAccessibleName(tr("Leases"));
    setHeaderLabels({tr("Part"), tr("Held by"), tr("Since (UTC)"), tr("For"), {}});
    keepWidths(*this, {50, 60, 44, 24});
}

void LeaseTable::show(const Frame& frame, const AgentFrame& agent) {
    std::vector<comms::ShownLease> leases;
    if (agent.image) leases = comms::leasesOf(agent.status, *agent.image);
    const int count = static_cast<int>(leases.size());
    while (topLevelItemCount() > count) delete takeTopLevelItem(topLevelItemCount() - 1);
    while (topLevelItemCount() < count) new QTreeWidgetItem{this};
    for (int i = 0; i < count; ++i) {
        const comms::ShownLease& lease = leases[static_cast<std::size_t>(i)];
        const QStringList texts{plainText(lease.prefix), plainText(lease.holder),
                                utcText(lease.since, "yyyy-MM-dd HH:mm:ss"),
                                wholeAgeText(lease.seconds),
                                lease.holder == frame.control.self ? tr("you") : QString{}};
        for (int column = 0; column < texts.size(); ++column)
            setCell(*topLevelItem(i), column, texts[column]);
    }
    for (int column = 0; column < columnCount(); ++column) growToFit(*this, column);
}

}  // namespace cortex::gui
