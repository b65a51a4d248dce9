// SPDX-License-Identifier: Apache-2.0
#include "views/loop_trend.hpp"

#include "style/look.hpp"

#include <QVBoxLayout>

namespace cortex::gui {

LoopTrend::LoopTrend(QWidget* parent) : QWidget{parent}, rows_{new QVBoxLayout{this}} {
    rows_->setContentsMargins(Look::units(4), Look::units(2), Look::units(4), Look::units(2));
    rows_->setSpacing(Look::units(2));
    begin();
}

// Plots forget nothing but what is old, so another agent has plots of its own.
void LoopTrend::begin() {
    delete duty_;
    delete jitter_;
    duty_ = new explorer::SmallPlot{tr("Duty cycle"), QStringLiteral("%")};
    jitter_ = new explorer::SmallPlot{tr("Jitter"), QStringLiteral("µs")};
    duty_->addLine(tr("last cycle"));
    jitter_->addLine(tr("p99"));
    duty_->setLimits(std::nullopt, 100);
    for (explorer::SmallPlot* each : {duty_, jitter_}) {
        each->setSpan(LoopHistory::span);
        rows_->addWidget(each, 1);
    }
    until_ = 0;
}

void LoopTrend::show(const AgentFrame& agent, const Frame& frame, const LoopHistory& history,
                     bool anew) {
    if (anew) begin();
    for (const LoopHistory::Moment& each : history.of(agent)) {
        if (each.time <= until_) continue;
        duty_->put(0, each.time, each.duty);
        jitter_->put(0, each.time, each.jitter);
        until_ = each.time;
    }
    for (explorer::SmallPlot* each : {duty_, jitter_}) each->setNow(frame.seconds);
}

}  // namespace cortex::gui
