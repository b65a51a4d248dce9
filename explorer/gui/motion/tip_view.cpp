// SPDX-License-Identifier: Apache-2.0
#include "motion/tip_view.hpp"

#include "cortex/explorer/small_plot.hpp"

#include "motion/axis_plots.hpp"
#include "motion/choices.hpp"
#include "motion/motion_bar.hpp"
#include "motion/motion_page.hpp"
#include "motion/tip_numbers.hpp"
#include "motion/tip_pad.hpp"

#include <QVBoxLayout>
#include <algorithm>

namespace cortex::explorer {

namespace {

constexpr std::int64_t baseFrame = 0, tipFrame = 1;

}  // namespace

TipView::TipView(std::string path)
    : path_{std::move(path)},
      bar_{new MotionBar{
          tr("Frame"), {{QStringLiteral("Base"), tr("Base")}, {QStringLiteral("Tip"), tr("Tip")}}}},
      pad_{new TipPad},
      numbers_{new TipNumbers},
      rows_{new AxisRows},
      page_{new MotionPage{{bar_, pad_, numbers_, rows_}, true}},
      jog_{new Jog{
          [this](int motion, double velocity) { return tipOrder(path_, motion, velocity); },
          [this](QWidget& held, const HeldOrder& order) { return hold(held, order); }, this}} {
    auto* all = new QVBoxLayout{this};
    all->setContentsMargins(0, 0, 0, 0);
    all->addWidget(page_);
    connectParts();
}

void TipView::connectParts() {
    connect(pad_, &TipPad::pressed, this, &TipView::press);
    connect(rows_, &AxisRows::chosen, this, &TipView::choose);
    connect(bar_, &MotionBar::shareChanged, this, [this] {
        if (jog_->runs()) jog_->change(jog_->direction() * speedOf(jog_->axis()));
    });
    connect(&bar_->modes(), &Choices::wanted, this, &TipView::setFrame);
    for (Choices* each : {&bar_->angles(), &bar_->lengths()}) {
        connect(each, &Choices::wanted, this,
                [this](const QString& unit) { chooseUnit(unit.toStdString()); });
    }
}

void TipView::bind(const SystemNow& now) {
    auto axes = axesOf(now, path_);
    const Tip tip = tipOf(now, path_);
    // What is held down must outlast what comes and goes elsewhere.
    const bool same = std::ranges::equal(
        axes, axes_, [](const auto& one, const auto& other) { return one.isSame(other); });
    tip_.pose = tip.pose;
    tip_.kinematics = tip.kinematics;
    tip_.another = tip.another;
    if (same && bound_ && tip.moves == tip_.moves) return;
    bound_ = true;
    axes_ = std::move(axes);
    tip_ = tip;
    pad_->make(tip_.moves);
    rows_->make(axes_, RowPart::None, false);
    page_->plots().forget(axes_.size());
}

std::vector<Watch> TipView::watches() const {
    Watch watch{{path_}};
    if (!tip_.pose.empty()) watch.prefixes.push_back(tip_.pose);
    for (const MotionAxis& each : axes_) {
        for (const std::string& path : {each.axis, each.demand, each.device}) {
            if (!path.empty()) watch.prefixes.push_back(path);
        }
    }
    return {watch};
}

bool TipView::settled() const { return axes_.empty() || page_->settled(); }

void TipView::refresh(const SystemNow& now) {
    const QString frame = tip_.frame;
    for (MotionAxis& each : axes_) explorer::refresh(each, now);
    explorer::refresh(tip_, now, path_);
    if (jog_->runs() && tip_.frame != frame) jog_->end(tr("the frame was changed"));
    if (now.at(path_).live()) jog_->see(now.at(path_).text("jogging") == QLatin1String{"true"});
    whyNot_ = whyNot(path_, "jog");
    bar_->setAllowed(whyNot_.isEmpty());
    showBar();
    pad_->show(tip_.frame.toLower(), whyNoJog(), jog_->runs() ? jog_->axis() : -1,
               jog_->runs() ? jog_->direction() : 0);
    numbers_->show(tip_, path_, shown("m"), shown("rad"));
    showRows();
    showLines();
    page_->plots().add(axes_, SmallPlot::clock());
    if (rows_->count() == 0) return;
    const MotionAxis& chosen = axes_[static_cast<std::size_t>(rows_->selected())];
    page_->plots().show(chosen, static_cast<std::size_t>(rows_->selected()),
                        shown(chosen.positionUnit), shown(chosen.velocityUnit));
}

// --- orders -----------------------------------------------------------------------------------

double TipView::speedOf(int motion) const {
    return tip_.most[static_cast<std::size_t>(motion)].value_or(0) * bar_->share();
}

// Why it cannot be jogged at all, in whatever direction.
QString TipView::whyNoJog() const {
    if (!whyNot_.isEmpty()) return whyNot_;
    for (const MotionAxis& each : axes_) {
        if (!each.drive || *each.drive == State::Active) continue;
        return tr("the drive of %1 is in %2").arg(each.name, QLatin1String{name(*each.drive)});
    }
    return {};
}

void TipView::press(int motion, int direction, QWidget* held) {
    const QString why = whyNoJog();
    if (!why.isEmpty()) {
        jog_->say(tr("Not jogged: %1").arg(why));
    } else {
        jog_->start(*held, motion, direction * speedOf(motion), tip_.holdTime);
    }
    showLines();
}

void TipView::setFrame(const QString& frame) {
    jog_->end(tr("the frame was changed"));
    const bool tip = frame == QLatin1String{"Tip"};
    send({path_, "set", {{"frame", tip ? tipFrame : baseFrame}}}, [this](const Answer& answer) {
        if (!answer.done) jog_->say(tr("The frame was not changed: %1").arg(answer.text));
    });
}

void TipView::choose(int axis) {
    rows_->select(axis);
    page_->reveal(rows_->row(axis));
    showRows();
}

// --- what is shown ----------------------------------------------------------------------------

ShownNumber TipView::shown(const std::string& unit) const { return shownNumber(shownUnit(unit)); }

ShownNumber TipView::shownOf(int motion) const { return shown(turns(motion) ? "rad/s" : "m/s"); }

void TipView::showBar() {
    bar_->modes().show(tip_.frame);
    bar_->modes().setWhyNot(whyNot(path_, "set"));
    bar_->angles().show(shownUnit("rad").factor == 1 ? QStringLiteral("rad")
                                                     : QStringLiteral("deg"));
    bar_->lengths().show(shownUnit("m").factor == 1 ? QStringLiteral("m") : QStringLiteral("mm"));
    QStringList speeds;
    for (const int motion : {0, 3}) {
        const auto at = static_cast<std::size_t>(motion);
        const bool any = tip_.moves[at] || tip_.moves[at + 1] || tip_.moves[at + 2];
        if (!any || !tip_.most[at]) continue;
        speeds << tr("%1 of %2")
                      .arg(shownOf(motion).text(speedOf(motion)),
                           shownOf(motion).withUnit(*tip_.most[at]));
    }
    bar_->saySpeed(speeds.join(QStringLiteral("; ")));
}

void TipView::showRows() {
    QString unit;
    bool one = true;
    for (const MotionAxis& each : axes_) {
        const QString its = shown(each.positionUnit).unit.text;
        one = one && (unit.isEmpty() || unit == its);
        unit = its;
    }
    const bool inTitles = one && !unit.isEmpty();
    const QString behind = inTitles ? QStringLiteral(" (%1)").arg(unit) : QString{};
    rows_->setTitles(tr("Value") + behind, tr("Target") + behind, {});
    for (int i = 0; i < rows_->count(); ++i) {
        const MotionAxis& each = axes_[static_cast<std::size_t>(i)];
        RowLook look{shown(each.positionUnit), shown(each.velocityUnit)};
        look.nameWidth = rows_->nameWidth();
        look.unitInRow = !inTitles;
        look.selected = i == rows_->selected();
        look.focused = rows_->hasFocus();
        rows_->row(i).show(each, look);
    }
}

QString TipView::limitSentence() const {
    QStringList all;
    for (const MotionAxis& each : axes_) {
        const QString limit = each.limitText();  // "at its upper limit"
        if (!limit.isEmpty()) all << tr("%1 is %2.").arg(each.name, limit);
    }
    return all.join(' ');
}

// What keeps the tip from the velocity that was asked for; empty: nothing does.
QString TipView::heldBackBy() const {
    if (tip_.heldBack == QLatin1String{"Limit"}) return tr("Held at a limit");
    if (tip_.heldBack == QLatin1String{"Speed"}) return tr("Slowed to the speed of an axis");
    if (tip_.heldBack == QLatin1String{"Singularity"}) return tr("Slowed near a singular posture");
    return {};
}

// An elbow turns about no axis of a frame, and moves no tip.
QString TipView::jogSentence() const {
    if (!jog_->runs()) return {};
    const int motion = jog_->axis();
    const bool elbow = motion == tipElbow;
    const QString heldBack = heldBackBy();
    QString text = heldBack.isEmpty() ? tr("Jogging %1 at %2") : tr("%1: %2 asked for %3");
    if (!heldBack.isEmpty()) text = text.arg(heldBack);
    text = text.arg(tipMotionName(motion), shownOf(motion).withSign(jog_->velocity()));
    if (!elbow) text += tr(" in the frame %1").arg(tip_.frame);
    const auto speed = tip_.speed[turns(motion) ? 1 : 0];
    if (!elbow && !heldBack.isEmpty() && speed)
        text += tr("; the tip moves at %1").arg(shownOf(motion).withUnit(*speed));
    return text +
           tr(". It brakes when you let go, after %1 s at the latest.").arg(jog_->holdTime());
}

QString TipView::help() const {
    const bool turning = tip_.moves[3] || tip_.moves[4] || tip_.moves[5];
    const QString text = tr("Hold a button; or ← → ↑ ↓, Page Up and Page Down for X, Y and Z");
    return text + (turning ? tr(", with Shift to turn.") : QStringLiteral("."));
}

void TipView::showLines() {
    const QString limits = limitSentence();
    const bool refused = !whyNot_.isEmpty() && !jog_->runs();
    page_->say(jogSentence(), jog_->said(),
               refused            ? whyNot_
               : limits.isEmpty() ? help()
                                  : limits,
               refused || limits.isEmpty() ? Tone::Quiet : Tone::Limit);
}

}  // namespace cortex::explorer
