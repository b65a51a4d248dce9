// SPDX-License-Identifier: Apache-2.0
#include "drive/fieldbus_view.hpp"

#include "cortex/explorer/small_plot.hpp"
#include "cortex/explorer/theme.hpp"

#include "drive/link_row.hpp"
#include "motion/labels.hpp"

#include <QPointer>
#include <QScrollArea>
#include <QVBoxLayout>

namespace cortex::explorer {

namespace {

constexpr double enoughPast = 5;  // s

// "12,004 exchanges; the last one took 412 µs, the longest 3,870 µs".
QString exchangesOf(const SimplexNow& device) {
    return FieldbusView::tr(
               "%1 exchanges were answered. The last one took %2 µs, 99 % of them no "
               "more than %3 µs, the longest %4 µs.")
        .arg(device.text("exchangeCount"), device.text("exchangeTimeLast"),
             device.text("exchangeTimeP99"), device.text("exchangeTimeMax"));
}

}  // namespace

FieldbusView::FieldbusView(std::string path)
    : path_{std::move(path)},
      link_{new LinkRow{path_, false}},
      times_{new Sentence},
      age_{new SmallPlot{tr("age of the last answer"), tr("ms")}} {
    age_->addLine(tr("age"));
    age_->setAccessibleName(tr("Age of the last answer during the last ten seconds"));
    auto* content = new QWidget;
    auto* rows = new QVBoxLayout{content};
    rows->setContentsMargins(0, 0, 0, units(2));
    rows->setSpacing(units(2));
    auto* below = new QVBoxLayout;
    below->setContentsMargins(units(3), 0, units(3), 0);
    times_->keepLines(2);
    below->addWidget(times_);
    below->addWidget(age_, 1);
    rows->addWidget(link_);
    rows->addLayout(below, 1);
    auto* area = new QScrollArea;
    area->setWidget(content);
    area->setWidgetResizable(true);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    area->setFocusPolicy(Qt::NoFocus);
    area->setMinimumHeight(1);
    area->setAccessibleName(tr("Link"));
    auto* all = new QVBoxLayout{this};
    all->setContentsMargins(0, 0, 0, 0);
    all->addWidget(area);
    connect(link_, &LinkRow::reconnectWanted, this, &FieldbusView::reconnect);
}

void FieldbusView::reconnect() {
    link_->say(tr("Reconnect: sending"));
    send({path_, "reconnect"}, [row = QPointer<LinkRow>{link_}](const Answer& answer) {
        if (row) row->say(tr("Reconnect: %1").arg(answer.text));
    });
}

void FieldbusView::refresh(const SystemNow& now) {
    const SimplexNow device = now.at(path_);
    link_->refresh(now, whyNot(path_, "reconnect"));
    times_->say(exchangesOf(device));
    now_ = SmallPlot::clock();
    if (began_ == 0) began_ = now_;
    const auto loss = device.number("lossTime");
    age_->setLimits(std::nullopt, loss ? std::optional{*loss * 1000} : std::nullopt);
    age_->put(0, now_, device.live() ? device.number("age") : std::nullopt);
    age_->setNow(now_);
}

bool FieldbusView::settled() const { return now_ - began_ >= enoughPast; }

}  // namespace cortex::explorer
