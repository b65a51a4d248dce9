// SPDX-License-Identifier: Apache-2.0
#include "window/control_bar.hpp"

#include "model/permission.hpp"
#include "session/lease.hpp"
#include "widgets/text_label.hpp"
#include "window/control_notice.hpp"

#include <QHBoxLayout>
#include <QLineEdit>
#include <QPainter>
#include <QPushButton>
#include <algorithm>
#include <utility>

namespace cortex::gui {

namespace {

// Who else holds a part of what lies there, as the session says it.
QString othersIn(const Frame& frame, const std::string& prefix) {
    QStringList others;
    for (const AgentFrame& agent : frame.agents) {
        if (agent.lost() || !hasBelow(agent, prefix)) continue;
        const auto lease = leaseOfOthers(agent, prefix, frame.control.self);
        if (!lease) continue;
        others << ControlBar::tr("%1: %2 holds %3, and must release it or hand it over.")
                      .arg(QString::fromStdString(agent.status.name),
                           QString::fromStdString(lease->holder),
                           QString::fromStdString(lease->prefix));
    }
    return others.join(' ');
}

}  // namespace

ControlBar::ControlBar(Session& session, QWidget* parent)
    : QWidget{parent},
      session_{session},
      frame_{session.frame()},
      label_{new TextLabel{TextSize::Text}},
      handOver_{new QPushButton{tr("Hand over…")}},
      button_{new QPushButton},
      notice_{new ControlNotice} {
    auto* row = new QHBoxLayout{this};
    row->setContentsMargins(Look::units(2), 0, 0, 0);
    row->setSpacing(Look::units(4));
    row->addWidget(label_);
    row->addWidget(handOver_);
    row->addWidget(button_);
    handOver_->hide();
    // The mouse leaves the keyboard where it was: these come and go.
    for (QPushButton* each : {handOver_, button_}) each->setFocusPolicy(Qt::TabFocus);
    label_->keepWhole();
    label_->show(text());
    button_->setText(tr("Take control…"));
    button_->setToolTip(tr("Ctrl+T; releasing is Ctrl+Shift+T"));
    connect(button_, &QPushButton::clicked, this, [this] { holds() ? release() : choose(); });
    connect(handOver_, &QPushButton::clicked, this, &ControlBar::chooseHandOver);
    connect(&notice_->remedy(), &QPushButton::clicked, this, [this] { take(remedy_); });
    connect(notice_, &ControlNotice::closed, this, &ControlBar::closeNotice);
}

// Where not all that have something there are held: " of robot".
QString ControlBar::ofSome(const std::string& prefix) const {
    QStringList held;
    bool all = true;
    for (const AgentFrame& agent : frame_->agents) {
        if (agent.lost() || !hasBelow(agent, prefix)) continue;
        if (frame_->control.covers(agent.status.name, prefix))
            held << QString::fromStdString(agent.status.name);
        else
            all = false;
    }
    return all || held.isEmpty() ? QString{} : tr(" of %1").arg(held.join(tr(" and ")));
}

QString ControlBar::text() const {
    const Control& control = frame_->control;
    if (!control.asks.empty()) return tr("Asking for %1").arg(scopeText(control.asks));
    if (control.prefix.empty()) return tr("Read-only");
    QStringList parts;
    for (const std::string& each : control.prefixes()) parts << scopeText(each) + ofSome(each);
    if (narrow_) return tr("You control %1").arg(parts.join(tr(" and ")));
    return tr("You control %1 since %2").arg(parts.join(tr(" and ")), clockText(control.since));
}

void ControlBar::refresh(const std::shared_ptr<const Frame>& frame, const std::string& path) {
    frame_ = frame;
    path_ = path;
    const Control& control = frame->control;
    label_->show(text(), control.prefix.empty() ? &Tokens::ink2 : &Tokens::onAccent);
    if (control.prefix != prefix_) {
        prefix_ = control.prefix;
        if (holds()) closed_.clear();
        button_->setText(holds() ? tr("Release") : tr("Take control…"));
        handOver_->setVisible(holds() && !narrow_);
        update();
        Q_EMIT changed();
    }
    refreshNotice();
    if (panel_) panel_->refresh(frame);
    if (handOverPanel_) handOverPanel_->refresh(frame);
}

// A refusal follows the leases: it says who holds a part by now, or that nobody else does.
QString ControlBar::refusal() {
    const QString others = othersIn(*frame_, refused_);
    if (others_.isEmpty()) others_ = others;
    if (others == others_) return QString::fromStdString(said_);
    if (others.isEmpty()) remedy_ = refused_;
    return tr("Control of %1 was not taken. %2")
        .arg(QString::fromStdString(refused_),
             others.isEmpty() ? tr("Nobody else holds a part of it any longer.") : others);
}

void ControlBar::refreshNotice() {
    const Control& control = frame_->control;
    const auto held = control.prefixes();
    if (!control.asks.empty()) asked_ = control.asks;
    if (std::ranges::find(held, asked_) != held.end()) asked_.clear();
    if (control.notice != said_) {
        said_ = control.notice;
        refused_ = std::exchange(asked_, {});
        others_.clear();
        closed_.clear();
    }
    const bool missing = !holds() || !ofSome(control.last).isEmpty();
    remedy_ = missing ? control.last : std::string{};
    const QString text = refused_.empty() ? QString::fromStdString(said_) : refusal();
    const bool offers = !remedy_.empty() && control.asks.empty();
    const QString remedy = remedy_ == control.last ? tr("Take %1 again") : tr("Take %1");
    notice_->show(said_ == closed_ ? QString{} : text,
                  offers ? remedy.arg(scopeText(remedy_)) : QString{});
}

// The time and *Hand over…* give way; that stands in the menu, too.
void ControlBar::setNarrow(bool narrow) {
    narrow_ = narrow;
    handOver_->setVisible(holds() && !narrow);
    label_->show(text());
}

void ControlBar::choose(const std::string& prefix) {
    if (panel_) {
        panel_->disconnect(this);
        delete panel_.data();
    }
    path_ = prefix;
    choose();
    panel_->choose(prefix);
    panel_->focusChosen();
}

void ControlBar::choose() {
    if (panel_) return;
    panel_ = new ControlPanel{frame_, path_, this};
    connect(panel_, &ControlPanel::taken, this, [this](const std::string& prefix) {
        took_ = true;
        take(prefix);
    });
    took_ = false;
    connect(panel_, &Popover::closed, this, [this] {
        if (!took_) Q_EMIT declined();
    });
    showBelow(*panel_);
    panel_->focusChosen();
}

void ControlBar::showBelow(QWidget& popover) {
    popover.adjustSize();
    const QPoint corner = mapToGlobal(rect().bottomRight());
    popover.move(corner - QPoint{popover.width(), -Look::units(1)});
    popover.show();
}

void ControlBar::chooseHandOver() {
    if (handOverPanel_ || !holds()) return;
    handOverPanel_ = new HandOverPanel{frame_, this};
    connect(handOverPanel_, &HandOverPanel::chosen, this, [this](const std::string& name) {
        closed_.clear();
        asked_.clear();
        session_.handOver(name);
    });
    showBelow(*handOverPanel_);
    handOverPanel_->nameField().setFocus();
}

void ControlBar::take(const std::string& prefix) {
    closed_.clear();
    asked_ = prefix;
    session_.takeControl(prefix);
}

// What was said about what is released is over.
void ControlBar::release() {
    closeNotice();
    session_.releaseControl();
}

void ControlBar::closeNotice() {
    closed_ = said_;
    refreshNotice();
}

// What the operator holds is blue.
void ControlBar::paintEvent(QPaintEvent* /*event*/) {
    if (!holds()) return;
    QPainter painter{this};
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(Look::colours().accent);
    const int height = Look::units(6);
    const QRect chip{label_->x() - Look::units(2), (this->height() - height) / 2,
                     label_->width() + Look::units(4), height};
    painter.drawRoundedRect(chip, Look::units(1), Look::units(1));
}

}  // namespace cortex::gui
