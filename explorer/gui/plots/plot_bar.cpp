// SPDX-License-Identifier: Apache-2.0
#include "plots/plot_bar.hpp"

#include "plots/plot_range.hpp"
#include "plots/time_ticks.hpp"
#include "style/look.hpp"
#include "widgets/flow_layout.hpp"
#include "widgets/text_label.hpp"

#include <QMenu>
#include <QPushButton>
#include <array>

namespace cortex::gui {

namespace {

constexpr std::array spans{1.0, 5.0, 10.0, 20.0, 60.0, 120.0, 300.0, 600.0};  // s

QString spanText(double seconds) {
    if (seconds >= 60) return PlotBar::tr("%1 min").arg(seconds / 60, 0, 'g', 3);
    return PlotBar::tr("%1 s").arg(seconds, 0, 'g', 3);
}

}  // namespace

PlotBar::PlotBar(QWidget* parent)
    : QWidget{parent},
      follow_{new QPushButton{tr("Follow")}},
      hold_{new QPushButton{tr("Hold")}},
      span_{new QPushButton},
      cursors_{new QPushButton{tr("Cursors")}},
      statistics_{new QPushButton{tr("Statistics")}},
      legend_{new QPushButton{tr("Legend")}},
      held_{new TextLabel{TextSize::Note, false, &Tokens::warnText}},
      notice_{new TextLabel{TextSize::Note, false, &Tokens::warnText}} {
    auto* row = new FlowLayout{2};
    setLayout(row);
    QSizePolicy policy{QSizePolicy::Preferred, QSizePolicy::Fixed};
    policy.setHeightForWidth(true);
    setSizePolicy(policy);
    for (QPushButton* each : {follow_, hold_, cursors_, statistics_, legend_}) {
        each->setCheckable(true);
    }
    follow_->setToolTip(tr("F or End"));
    hold_->setToolTip(tr("Space"));
    cursors_->setToolTip(tr("C"));
    auto* menu = new QMenu{span_};
    for (const double each : spans) {
        connect(menu->addAction(spanText(each)), &QAction::triggered, this,
                [this, each] { Q_EMIT spanWanted(each); });
    }
    span_->setMenu(menu);
    span_->setAccessibleName(tr("Span"));
    auto* save = new QPushButton{tr("Export…")};
    auto* kinds = new QMenu{save};
    const auto kind = [&](const QString& text, const QString& name) {
        connect(kinds->addAction(text), &QAction::triggered, this,
                [this, name] { Q_EMIT exportWanted(name); });
    };
    kind(tr("CSV: every cycle that is visible"), QStringLiteral("csv"));
    kind(tr("PNG"), QStringLiteral("png"));
    kind(tr("SVG"), QStringLiteral("svg"));
    save->setMenu(kinds);
    for (QWidget* each : std::initializer_list<QWidget*>{
             follow_, hold_, span_, cursors_, statistics_, legend_, save, held_, notice_}) {
        row->addWidget(each);
    }
    for (TextLabel* each : {held_, notice_}) each->setMinimumHeight(Look::units(9));
    held_->keepWhole();
    notice_->keepWhole();
    held_->hide();
    notice_->hide();
    connect(follow_, &QPushButton::clicked, this, &PlotBar::followWanted);
    connect(hold_, &QPushButton::clicked, this, &PlotBar::holdWanted);
    connect(cursors_, &QPushButton::clicked, this, &PlotBar::cursorsWanted);
    connect(statistics_, &QPushButton::clicked, this, &PlotBar::statisticsWanted);
    connect(legend_, &QPushButton::clicked, this, &PlotBar::legendWanted);
}

void PlotBar::show(const PlotRange& range, const Shown& shown) {
    follow_->setChecked(range.follows());
    hold_->setChecked(!range.follows());
    cursors_->setChecked(shown.cursors);
    statistics_->setChecked(shown.statistics);
    legend_->setChecked(shown.legend);
    const QString span = tr("Span %1").arg(spanText(range.span()));
    if (span_->text() != span) span_->setText(span);
    const bool held = !range.follows() && range.known();
    if (held) {
        held_->show(tr("Held at %1, %2 s behind now")
                        .arg(momentText(range.shown().to))
                        .arg(range.behind(), 0, 'f', 1));
    }
    held_->setVisible(held);
}

void PlotBar::say(const QString& notice) {
    notice_->show(notice);
    notice_->setVisible(!notice.isEmpty());
}

}  // namespace cortex::gui
