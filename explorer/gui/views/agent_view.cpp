// SPDX-License-Identifier: Apache-2.0
#include "views/agent_view.hpp"

#include "style/look.hpp"
#include "views/agent_details.hpp"
#include "views/agent_table.hpp"

#include <QVBoxLayout>
#include <algorithm>

namespace cortex::gui {

namespace {

constexpr double shareOfTable = 0.4;  // of the height, at most

}  // namespace

AgentView::AgentView(QWidget* parent)
    : QWidget{parent}, table_{new AgentTable}, details_{new AgentDetails} {
    auto* rows = new QVBoxLayout{this};
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(0);
    rows->addWidget(table_);
    rows->addWidget(details_, 1);
    details_->hide();
    setAutoFillBackground(true);
    connect(table_, &AgentTable::chosen, this, &AgentView::choose);
    connect(table_, &AgentTable::itemActivated, details_, &AgentDetails::takeFocus);
    connect(details_, &AgentDetails::opened, this, &AgentView::opened);
    connect(details_, &AgentDetails::plotWanted, this, &AgentView::plotWanted);
}

void AgentView::choose(const std::string& agent) {
    table_->choose(agent);
    details_->show(agent);
}

// The first one is chosen until the user chooses another.
void AgentView::refresh(const Frame& frame) {
    history_.add(frame);
    if (!isVisible()) return;
    if (details_->agent().empty() && !frame.agents.empty())
        choose(frame.agents.front().status.name);
    table_->refresh(frame);
    details_->setVisible(!details_->agent().empty());
    if (details_->isVisible()) details_->refresh(frame, history_);
    fitTable();
}

// As high as its rows, so that most is left for what is chosen; not while the pointer is in it.
void AgentView::fitTable() {
    if (!underMouse() || rows_ == 0) rows_ = table_->topLevelItemCount();
    const int most = static_cast<int>(height() * shareOfTable);
    table_->setFixedHeight(details_->isVisible() ? std::min(table_->heightOf(rows_), most)
                                                 : height());
}

QJsonObject AgentView::saved() const {
    return {{QStringLiteral("agent"), QString::fromStdString(details_->agent())},
            {QStringLiteral("part"), details_->part()}};
}

void AgentView::restore(const QJsonObject& saved) {
    choose(saved[QStringLiteral("agent")].toString().toStdString());
    details_->openPart(saved[QStringLiteral("part")].toString());
}

}  // namespace cortex::gui
