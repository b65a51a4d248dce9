// SPDX-License-Identifier: Apache-2.0
#include "motion/demand_bar.hpp"

#include "motion/labels.hpp"
#include "motion/row_columns.hpp"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QPushButton>
#include <algorithm>

namespace cortex::explorer {

namespace {

constexpr double wideBar = 180;    // units; from here on the texts stand beside the buttons
constexpr double lowWindow = 175;  // units; below it each text has one line

}  // namespace

DemandBar::DemandBar(QWidget* parent)
    : QWidget{parent},
      copy_{new QPushButton{tr("Copy current")}},
      discard_{new QPushButton{tr("Discard")}},
      halt_{new QPushButton{tr("Halt")}},
      move_{new QPushButton{tr("Move")}},
      note_{new Sentence{Tone::Quiet}},
      answer_{new Sentence},
      texts_{new QWidget},
      grid_{new QGridLayout{this}} {
    copy_->setToolTip(tr("Enters where the axes are now"));
    discard_->setToolTip(tr("Forgets what was entered and not sent"));
    halt_->setToolTip(tr("Brings all axes to rest"));
    move_->setMinimumSize(units(2 * buttonWide + buttonGap), units(buttonHigh));
    auto* buttons = new QHBoxLayout;
    buttons->setSpacing(units(2));
    for (QPushButton* each : {copy_, discard_, halt_}) buttons->addWidget(each);
    auto* texts = new QVBoxLayout{texts_};
    texts->setContentsMargins(0, 0, 0, 0);
    texts->setSpacing(0);
    for (Sentence* each : {note_, answer_}) {
        each->setAlignment(Qt::AlignTop | Qt::AlignLeft);
        texts->addWidget(each);
    }
    texts->addStretch(1);
    grid_->setContentsMargins(units(4), units(1), units(4), units(1));
    grid_->setHorizontalSpacing(units(4));
    grid_->setVerticalSpacing(units(1));
    grid_->addLayout(buttons, 0, 0);
    grid_->addWidget(move_, 0, 1);
    grid_->setColumnStretch(2, 1);
    arrange();
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
}

// Beside the buttons; below them where there is no room.
void DemandBar::arrange() {
    for (Sentence* each : {note_, answer_})
        each->keepLines(window()->height() < units(lowWindow) ? 1 : 2);
    const bool wide = width() >= units(wideBar);
    if (wide == wide_) return;
    wide_ = wide;
    grid_->addWidget(texts_, wide ? 0 : 1, wide ? 2 : 0, 1, wide ? 1 : 3);
}

void DemandBar::resizeEvent(QResizeEvent* /*event*/) { arrange(); }

void DemandBar::forget(std::size_t axes) { edits_.assign(axes, {}); }

void DemandBar::enter(std::size_t axis, std::optional<double> demand) {
    if (axis < edits_.size()) edits_[axis] = {Stage::Entered, demand};
}

void DemandBar::discard() {
    for (Edit& each : edits_) {
        if (isMarked(each)) each = {};
    }
}

int DemandBar::send(std::optional<std::size_t> axis) {
    ++motion_;
    for (std::size_t i = 0; i < edits_.size(); ++i) {
        Edit& each = edits_[i];
        const bool moves = !axis || axis == i;  // of others, what was refused still is
        if (each.stage == Stage::Entered || (moves && each.stage != Stage::None))
            each = {Stage::Sent, each.demand, motion_};
    }
    return motion_;
}

void DemandBar::taken(int motion, std::optional<std::size_t> axis) {
    for (std::size_t i = 0; axis && i < edits_.size(); ++i) {
        if (i != axis && isSent(edits_[i], motion)) edits_[i] = {};
    }
}

void DemandBar::answer(int motion, bool done) {
    for (Edit& each : edits_) {
        if (isSent(each, motion)) each.stage = done ? Stage::None : Stage::Refused;
    }
}

int DemandBar::count(Stage stage) const {
    return static_cast<int>(std::ranges::count(edits_, stage, &Edit::stage));
}

QString DemandBar::counts() const {
    const int refused = count(Stage::Refused);
    return tr("%1 not sent").arg(count(Stage::Entered)) +
           (refused > 0 ? tr(", %1 not reached").arg(refused) : QString{});
}

bool DemandBar::isWrong() const {
    return std::ranges::any_of(
        edits_, [](const Edit& each) { return each.stage == Stage::Entered && !each.demand; });
}

void DemandBar::show(const QString& action, const QString& whyNot, const QString& wrong,
                     const QString& note) {
    if (move_->text() != action) move_->setText(action);
    move_->setEnabled(whyNot.isEmpty());
    move_->setToolTip(whyNot);
    discard_->setEnabled(count(Stage::Entered) + count(Stage::Refused) > 0);
    const bool warns = whyNot.isEmpty() && !wrong.isEmpty();
    note_->say(warns              ? wrong + ' ' + note
               : whyNot.isEmpty() ? note
                                  : whyNot,
               warns ? Tone::Limit : Tone::Quiet);
}

void DemandBar::say(const QString& answer) { answer_->say(answer); }

}  // namespace cortex::explorer
