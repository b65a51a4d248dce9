// SPDX-License-Identifier: Apache-2.0
#include "views/agreement_table.hpp"

#include "cortex/core/agreement.hpp"

#include "model/plain_text.hpp"
#include "widgets/rows.hpp"

namespace cortex::gui {

namespace {

QString side(const std::string& text) {
    return text.empty() ? AgreementTable::tr("nothing") : plainText(text);
}

}  // namespace

AgreementTable::AgreementTable(QWidget* parent) : QTreeWidget{parent} {
    setUpRows(*this);
    setRootIsDecorated(false);
    setAccessibleName(tr("Agreement with others"));
    setHeaderLabels({tr("What"), tr("With"), tr("Type"), tr("Item"), tr("Here"), tr("There")});
    keepWidths(*this, {30, 28, 36, 40, 44});
}

void AgreementTable::show(const Frame& frame, const AgentFrame& agent) {
    if (agent_ != agent.status.name || structures_ != frame.structures) {
        clear();
        agent_ = agent.status.name;
        structures_ = frame.structures;
        next_ = compared_ = 0;
        found_ = 0;
        done_ = agent.structure == nullptr;
    }
    if (done_) return;
    while (next_ < frame.agents.size()) {
        const AgentFrame& other = frame.agents[next_++];
        if (!other.structure || other.status.name == agent_) continue;
        ++compared_;
        return compare(agent, other);
    }
    done_ = true;
}

// What contradicts stands above what only differs.
void AgreementTable::compare(const AgentFrame& agent, const AgentFrame& other) {
    const auto found = cortex::compare(*agent.structure->types, *other.structure->types);
    for (const bool contradictions : {true, false}) {
        for (const Disagreement& each : found) {
            if (each.contradiction != contradictions || ++found_ > most) continue;
            auto* row = new QTreeWidgetItem{
                this,
                {contradictions ? tr("contradiction") : tr("difference"),
                 QString::fromStdString(other.status.name), plainText(each.type),
                 plainText(each.item), side(each.ours), side(each.theirs)}};
            if (contradictions) row->setForeground(0, Look::colours().warnText);
        }
    }
    tellWhole(*this);
}

std::optional<int> AgreementTable::count() const {
    return done_ ? std::optional{found_} : std::nullopt;
}

}  // namespace cortex::gui
