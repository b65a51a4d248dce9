// SPDX-License-Identifier: Apache-2.0
#include "motion/demand_bar.hpp"

#include "motion/labels.hpp"
#include "motion/row_columns.hpp"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QPushButton>
#include <algorithm>

namespace cortex::explorer {

DemandBar::DemandBar(QWidget* parent)
    : QWidget{parent},
      copy_{new QPushButton{tr("Copy current")}},
      discard_{new QPushButton{tr("Discard")}},
      halt_{new QPushButton{tr("Halt")}},
      move_{new QPushButton{tr("Move")}},
      note_{new Sentence{Tone::Quiet}},
      answer_{new Sentence} {
    copy_->setToolTip(tr("Enters where the axes are now"));
    discard_->setToolTip(tr("Forgets what was entered and not sent"));
    halt_->setToolTip(tr("Brings all axes to rest"));
    move_->setMinimumSize(units(2 * buttonWide + buttonGap), units(buttonHigh));
    auto* buttons = new QHBoxLayout;
    for (QPushButton* each : {copy_, discard_, halt_}) buttons->addWidget(each);
    buttons->addStretch(1);
    auto* grid = new QGridLayout{this};
    grid->setContentsMargins(units(4), units(2), units(4), units(2));
    grid->addLayout(buttons, 0, 0);
    grid->addWidget(note_, 1, 0);
    grid->addWidget(move_, 0, 1, 2, 1, Qt::AlignTop);
    grid->addWidget(answer_, 2, 0, 1, 2);
    grid->setColumnStretch(0, 1);
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
}

void DemandBar::forget(std::size_t axes) { edits_.assign(axes, {}); }

void DemandBar::enter(std::size_t axis, std::optional<double> demand) {
    if (axis < edits_.size()) edits_[axis] = {true, demand};
}

void DemandBar::discard() { forget(edits_.size()); }

int DemandBar::edited() const {
    return static_cast<int>(std::ranges::count(edits_, true, &Edit::edited));
}

bool DemandBar::isWrong() const {
    return std::ranges::any_of(edits_,
                               [](const Edit& each) { return each.edited && !each.demand; });
}

void DemandBar::show(const QString& action, const QString& whyNot, const QString& note) {
    if (move_->text() != action) move_->setText(action);
    move_->setEnabled(whyNot.isEmpty());
    move_->setToolTip(whyNot);
    discard_->setEnabled(edited() > 0);
    note_->say(whyNot.isEmpty() ? note : whyNot);
}

void DemandBar::say(const QString& answer) { answer_->say(answer); }

QString DemandBar::answer() const { return answer_->text(); }

}  // namespace cortex::explorer
