// SPDX-License-Identifier: Apache-2.0
#include "views/agent_details.hpp"

#include "model/agent_text.hpp"
#include "model/loop_metrics.hpp"
#include "model/plain_text.hpp"
#include "model/value_text.hpp"
#include "views/agreement_table.hpp"
#include "views/counter_table.hpp"
#include "views/lease_table.hpp"
#include "views/loop_table.hpp"
#include "views/loop_trend.hpp"
#include "widgets/link.hpp"
#include "widgets/tab_row.hpp"
#include "widgets/text_label.hpp"

#include <QHBoxLayout>
#include <QPushButton>
#include <QScrollArea>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <cstddef>

namespace cortex::gui {

namespace {

constexpr qint64 digitsEvery = 100;  // ms: what changes faster cannot be read

enum AgentTab { LoopTab, TrendTab, LeaseTab, AgreementTab };
constexpr std::array partsOfAgent{"loop", "trend", "leases", "agreement"};

QString separated(const QStringList& parts) { return parts.join(QStringLiteral(" · ")); }

QString factsOf(const AgentFrame& agent) {
    QStringList facts;
    const auto add = [&](const QString& text) {
        if (!text.isEmpty()) facts << text;
    };
    add(stateWord(agent.status));
    add(rateText(agent.status));
    add(threadText(agent));
    return separated(facts);
}

// Whatever changes it is shown at once.
std::string knownOf(const AgentFrame& agent) {
    const bool came = agent.own() != noSimplex && agent.came(agent.own());
    return agent.status.state + (agent.structure ? "+" : "") + (came ? "+" : "");
}

QString lostText(const AgentFrame& agent) {
    if (agent.status.ended)
        return AgentDetails::tr("It has ended. Values are the last ones, in brackets.");
    return AgentDetails::tr("It is not heard for %1. Values are the last ones, in brackets.")
        .arg(ageText(agent.status.age));
}

QString agreementText(const AgentFrame& agent, const AgreementTable& table) {
    if (!agent.structure) return AgentDetails::tr("Not known: its types have not all come.");
    if (!table.count()) return AgentDetails::tr("Comparing…");
    if (table.compared() == 0) return AgentDetails::tr("There is no other agent to agree with.");
    const QString with = AgentDetails::tr("Compared with %n other agents", nullptr,
                                          static_cast<int>(table.compared()));
    if (*table.count() == 0)
        return AgentDetails::tr("%1: all types that both have agree.").arg(with);
    const QString rest =
        *table.count() > AgreementTable::most
            ? ' ' + AgentDetails::tr("The first %1 are shown.").arg(countText(AgreementTable::most))
            : QString{};
    return AgentDetails::tr("%1. What contradicts is not linked; what differs is.").arg(with) +
           rest;
}

}  // namespace

AgentDetails::AgentDetails(QWidget* parent)
    : QWidget{parent},
      name_{new TextLabel{TextSize::Title, true}},
      facts_{new TextLabel{TextSize::Text, false, &Tokens::ink2}},
      troubles_{new TextLabel{TextSize::Text, true, &Tokens::warnText}},
      open_{new Link{tr("Open its simplex")}},
      plot_{new QPushButton{tr("Plot duty and jitter")}},
      tabs_{new TabRow},
      pages_{new QStackedWidget},
      loop_{new LoopTable},
      counters_{new CounterTable},
      trend_{new LoopTrend},
      leases_{new LeaseTable},
      leaseNote_{new TextLabel{TextSize::Text, false, &Tokens::ink2}},
      agreement_{new AgreementTable},
      agreementNote_{new TextLabel{TextSize::Text, false, &Tokens::ink2}} {
    auto* rows = new QVBoxLayout{this};
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(0);
    rows->addWidget(makeHeader());
    rows->addWidget(tabs_);
    rows->addWidget(pages_, 1);
    for (int i = 0; i <= AgreementTab; ++i) tabs_->addTab({});
    tabs_->setAccessibleName(tr("What to show of the agent"));
    pages_->addWidget(makeLoopPage());
    pages_->addWidget(trend_);
    pages_->addWidget(makePage(*leases_, *leaseNote_));
    pages_->addWidget(makePage(*agreement_, *agreementNote_));
    pages_->setMinimumHeight(1);
    connect(tabs_, &QTabBar::currentChanged, pages_, &QStackedWidget::setCurrentIndex);
    connect(plot_, &QPushButton::clicked, this, &AgentDetails::plot);
    connect(open_, &Link::clicked, this, [this] { Q_EMIT opened('/' + agent_); });
}

QWidget* AgentDetails::makeHeader() {
    auto* header = new QWidget;
    auto* rows = new QVBoxLayout{header};
    rows->setContentsMargins(Look::units(4), Look::units(2), Look::units(4), Look::units(1));
    rows->setSpacing(Look::units(1));
    auto* row = new QHBoxLayout;
    row->setSpacing(Look::units(3));
    row->addWidget(name_);
    row->addStretch(1);
    row->addWidget(open_);
    row->addWidget(plot_);
    rows->addLayout(row);
    auto* second = new QHBoxLayout;
    second->setSpacing(Look::units(3));
    second->addWidget(facts_);
    troubles_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);  // they have what is left
    second->addWidget(troubles_, 1);
    rows->addLayout(second);
    return header;
}

QWidget* AgentDetails::makeLoopPage() {
    auto* content = new QWidget;
    auto* rows = new QVBoxLayout{content};
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(Look::units(2));
    rows->addWidget(loop_);
    rows->addWidget(counters_);
    rows->addStretch(1);
    auto* area = new QScrollArea;
    area->setFrameShape(QFrame::NoFrame);
    area->setWidgetResizable(true);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    area->setFocusPolicy(Qt::NoFocus);  // what is in it has the keyboard
    area->setWidget(content);
    return area;
}

QWidget* AgentDetails::makePage(QWidget& table, TextLabel& note) {
    auto* page = new QWidget;
    auto* rows = new QVBoxLayout{page};
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(0);
    auto* indented = new QHBoxLayout;
    indented->setContentsMargins(Look::units(2), Look::units(1), Look::units(2), 0);
    indented->addWidget(&note);
    indented->addStretch(1);
    rows->addLayout(indented);
    rows->addWidget(&table, 1);
    return page;
}

void AgentDetails::show(const std::string& agent) {
    if (agent == agent_) return;
    agent_ = agent;
    shown_.invalidate();
}

QString AgentDetails::part() const {
    return QLatin1String{partsOfAgent[static_cast<std::size_t>(tabs_->currentIndex())]};
}

void AgentDetails::openPart(const QString& name) {
    const auto found = std::ranges::find_if(
        partsOfAgent, [&](const char* each) { return name == QLatin1String{each}; });
    if (found != partsOfAgent.end())
        tabs_->setCurrentIndex(static_cast<int>(found - partsOfAgent.begin()));
}

void AgentDetails::takeFocus() { tabs_->setFocus(Qt::OtherFocusReason); }

void AgentDetails::plot() {
    const std::string path = '/' + agent_;
    Q_EMIT plotWanted({{{}, path, "dutyCycleLast", 0}, {{}, path, "jitterP99", 0}});
}

void AgentDetails::refresh(const Frame& frame, const LoopHistory& history) {
    name_->show(QString::fromStdString(agent_));
    const auto agent = std::ranges::find(frame.agents, agent_,
                                         [](const AgentFrame& each) { return each.status.name; });
    if (agent == frame.agents.end()) return showNothing();
    const auto known = knownOf(*agent);
    if (known == known_ && shown_.isValid() && shown_.elapsed() < digitsEvery) return;
    const bool anew = !shown_.isValid() || epoch_ != agent->status.epoch;
    shown_.start();
    epoch_ = agent->status.epoch;
    known_ = known;
    loop_->show(loopMetrics(*agent), anew);
    counters_->show(*agent, history);
    tell(*agent);
    refreshPages(frame, *agent);
    trend_->show(*agent, frame, history, anew);
}

// It is forgotten: another one is chosen in the table.
void AgentDetails::showNothing() {
    facts_->show(tr("It is not heard."), &Tokens::ink2);
    troubles_->show({});
    open_->setEnabled(false);
    plot_->setEnabled(false);
    tabs_->hide();
    pages_->hide();
}

void AgentDetails::tell(const AgentFrame& agent) {
    facts_->show(factsOf(agent), agent.status.overloaded ? &Tokens::warnText : &Tokens::ink2);
    QStringList lines = troublesOf(agent.status);
    if (agent.lost()) lines.prepend(lostText(agent));
    troubles_->show(separated(lines), agent.lost() ? &Tokens::dataText : &Tokens::warnText);
    open_->setEnabled(agent.own() != noSimplex);
    plot_->setEnabled(agent.own() != noSimplex);
    tabs_->show();
    pages_->show();
}

void AgentDetails::refreshPages(const Frame& frame, const AgentFrame& agent) {
    const auto title = [](const QString& text, const QString& count) {
        return QStringLiteral("%1  %2").arg(text, count);
    };
    leases_->show(frame, agent);
    agreement_->show(frame, agent);
    const auto disagreements = agreement_->count();
    tabs_->setTabText(LoopTab, tr("Loop"));
    tabs_->setTabText(TrendTab, tr("Last ten minutes"));
    tabs_->setTabText(LeaseTab, title(tr("Leases"), QString::number(leases_->count())));
    tabs_->setTabText(AgreementTab,
                      title(tr("Agreement with others"),
                            disagreements ? QString::number(*disagreements) : QStringLiteral("…")));
    const bool known = agent.own() != noSimplex && agent.came(agent.own()) && !agent.lost();
    leaseNote_->show(leases_->count() > 0 ? QString{}
                     : known              ? tr("Nobody holds a part of it.")
                                          : tr("Not known who holds a part of it."));
    agreementNote_->show(agreementText(agent, *agreement_));
}

}  // namespace cortex::gui
