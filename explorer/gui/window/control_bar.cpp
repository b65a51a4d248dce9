// SPDX-License-Identifier: Apache-2.0
#include "window/control_bar.hpp"

#include "model/permission.hpp"
#include "model/plain_text.hpp"
#include "session/lease.hpp"
#include "widgets/low_buttons.hpp"
#include "widgets/text_label.hpp"
#include "window/control_notice.hpp"

#include <QHBoxLayout>
#include <QLineEdit>
#include <QPainter>
#include <QPushButton>
#include <QStyle>
#include <QStyleOptionButton>
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

// Who has something there, has not ended, and is not controlled by us. All of an agent is below
// "/", also while it is not known yet what that is.
QStringList uncontrolled(const Frame& frame, const std::string& prefix) {
    QStringList names;
    for (const AgentFrame& agent : frame.agents) {
        const bool has = prefix == "/" || hasBelow(agent, prefix);
        if (!has || agent.status.ended || frame.control.covers(agent.status.name, prefix)) continue;
        names << QString::fromStdString(agent.status.name);
    }
    return names;
}

bool canBeTaken(const Frame& frame, const std::string& prefix) {
    bool any = false;
    for (const AgentFrame& agent : frame.agents) {
        if (agent.lost() || !hasBelow(agent, prefix)) continue;
        if (frame.control.covers(agent.status.name, prefix)) continue;
        if (leaseOfOthers(agent, prefix, frame.control.self)) return false;
        any = true;
    }
    return any;
}

// All that have something there are heard, and show that nobody at all holds a part of it.
bool isFree(const Frame& frame, const std::string& prefix) {
    bool any = false;
    for (const AgentFrame& agent : frame.agents) {
        if (agent.status.ended || !hasBelow(agent, prefix)) continue;
        if (agent.lost() || !agent.came(agent.own())) return false;
        if (leaseOfOthers(agent, prefix, {})) return false;
        any = true;
    }
    return any;
}

// That the button needs for another text.
int widthOf(const QPushButton& button, const QString& text) {
    QStyleOptionButton option;
    option.initFrom(&button);
    option.text = text;
    const QSize size = button.fontMetrics().size(Qt::TextShowMnemonic, text);
    return button.style()->sizeFromContents(QStyle::CT_PushButton, &option, size, &button).width();
}

constexpr int longestNames = 14, longestNarrow = 8;  // letters; otherwise they are counted
constexpr double leastForAgain = 320;  // units of the window; below it stands in the menu

}  // namespace

ControlBar::ControlBar(Session& session, QWidget* parent)
    : QWidget{parent},
      session_{session},
      frame_{session.frame()},
      label_{new TextLabel{TextSize::Text}},
      again_{new QPushButton{tr("Take again")}},
      handOver_{new QPushButton{tr("Hand over…")}},
      button_{new QPushButton},
      notice_{new ControlNotice} {
    auto* row = new QHBoxLayout{this};
    row->setContentsMargins(Look::units(2), 0, 0, 0);
    row->setSpacing(Look::units(4));
    row->addWidget(label_);
    // The mouse leaves the keyboard where it was: these come and go.
    for (QPushButton* each : {again_, handOver_, button_}) {
        row->addWidget(each);
        each->setFocusPolicy(Qt::TabFocus);
    }
    again_->hide();
    handOver_->hide();
    label_->keepWhole();
    label_->show(text());
    button_->setText(tr("Take control…"));
    button_->setToolTip(tr("Ctrl+T; releasing is Ctrl+Shift+T"));
    connect(button_, &QPushButton::clicked, this, [this] { holds() ? release() : choose(); });
    connect(again_, &QPushButton::clicked, this, &ControlBar::takeAgain);
    connect(handOver_, &QPushButton::clicked, this, &ControlBar::chooseHandOver);
    connect(&notice_->remedy(), &QPushButton::clicked, this, [this] { take(remedy_); });
    connect(notice_, &ControlNotice::closed, this, &ControlBar::closeNotice);
}

// "everything but robot".
QString ControlBar::partText(const std::string& prefix) const {
    const QStringList others = uncontrolled(*frame_, prefix);
    const QString scope = narrow_ && prefix == "/" ? tr("all") : scopeText(prefix);
    if (others.isEmpty()) return scope;
    const QString names = others.join(QStringLiteral(", "));
    const QString who = names.size() <= (narrow_ ? longestNarrow : longestNames)
                            ? names
                            : tr("%n agents", nullptr, static_cast<int>(others.size()));
    return (prefix == "/" ? tr("%1 but %2") : tr("%1 but not of %2")).arg(scope, who);
}

QString ControlBar::text() const {
    const Control& control = frame_->control;
    if (!control.asks.empty()) return tr("Asking for %1").arg(scopeText(control.asks));
    if (control.prefix.empty()) return tr("Read-only");
    // Where there are many, the first one that is not whole is named.
    auto held = control.prefixes();
    const auto isWhole = [&](const std::string& each) {
        return uncontrolled(*frame_, each).isEmpty();
    };
    const auto part = std::ranges::find_if_not(held, isWhole);
    if (part != held.end()) std::iter_swap(held.begin(), part);
    QStringList parts{partText(held.front())};
    if (held.size() == 2) parts << partText(held.back());
    if (held.size() > 2) parts << tr("%1 more").arg(held.size() - 1);
    const QString what = tr("You control %1").arg(parts.join(tr(" and ")));
    if (narrow_ || !isWhole(held.front())) return what;
    return tr("%1 since %2").arg(what, clockText(control.since));
}

QString ControlBar::heldText() const {
    QStringList parts;
    for (const std::string& each : frame_->control.prefixes()) parts << scopeText(each);
    return parts.join(tr(" and "));
}

// All of them, for the tooltip.
QString ControlBar::wholeText() const {
    QStringList parts;
    for (const std::string& each : frame_->control.prefixes()) {
        const QStringList others = uncontrolled(*frame_, each);
        const QString scope = scopeText(each);
        parts << (others.isEmpty() ? scope
                                   : tr("%1, but not of %2").arg(scope, others.join(tr(" and "))));
    }
    return parts.isEmpty() ? QString{} : tr("You control %1").arg(parts.join(QStringLiteral("; ")));
}

void ControlBar::refresh(const std::shared_ptr<const Frame>& frame, const std::string& path) {
    frame_ = frame;
    path_ = path;
    const Control& control = frame->control;
    label_->show(text(), control.prefix.empty() ? &Tokens::ink2 : &Tokens::onAccent);
    label_->setAccessibleDescription(wholeText());
    setToolTip(tipText(wholeText()));
    if (control.prefix != prefix_) {
        prefix_ = control.prefix;
        if (holds()) closed_.clear();
        button_->setText(holds() ? tr("Release") : tr("Take control…"));
        update();
        Q_EMIT changed();
    }
    showButtons();
    refreshNotice();
    if (panel_) panel_->refresh(frame);
    if (handOverPanel_) handOverPanel_->refresh(frame);
}

std::string ControlBar::missing() const {
    const Control& control = frame_->control;
    if (!control.asks.empty()) return {};
    const auto found = std::ranges::find_if(
        control.claims, [&](const std::string& each) { return canBeTaken(*frame_, each); });
    return found == control.claims.end() ? std::string{} : *found;
}

void ControlBar::takeAgain() {
    if (const std::string prefix = missing(); !prefix.empty()) take(prefix);
}

// None of them ever stands where another one stood that was just lost: "Take again" is to the left
// of the others, whose room is kept.
void ControlBar::showButtons() {
    lowerWhereLow({again_, handOver_, button_});
    const std::string prefix = missing();
    const bool again =
        !prefix.empty() && !narrow_ && window()->width() >= Look::units(leastForAgain);
    again_->setVisible(again);
    again_->setToolTip(tipText(tr("Take %1 again").arg(scopeText(prefix))));
    QSizePolicy policy = handOver_->sizePolicy();
    policy.setRetainSizeWhenHidden(again);
    handOver_->setSizePolicy(policy);
    handOver_->setVisible(holds() && !narrow_);
    button_->setMinimumWidth(narrow_ ? 0 : widthOf(*button_, tr("Take control…")));
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
    const bool offersLast = refused_.empty() && canBeTaken(*frame_, control.last);
    remedy_ = offersLast ? control.last : std::string{};
    QString text = refused_.empty() ? QString::fromStdString(said_) : refusal();
    if (!control.handed.empty() && isFree(*frame_, control.handed)) {
        text = tr("%1 Nobody holds it now: %2 is free.").arg(text, scopeText(control.handed));
    }
    const bool offers = !remedy_.empty() && control.asks.empty();
    const QString remedy = remedy_ == control.last ? tr("Take %1 again") : tr("Take %1");
    notice_->show(said_ == closed_ ? QString{} : text,
                  offers ? remedy.arg(scopeText(remedy_)) : QString{});
}

// The time and all buttons but one give way; those stand in the menu, too.
void ControlBar::setNarrow(bool narrow) {
    narrow_ = narrow;
    showButtons();
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
    panel_->openBelow(*button_);
    panel_->focusChosen();
}

void ControlBar::chooseHandOver() {
    if (handOverPanel_ || !holds()) return;
    handOverPanel_ = new HandOverPanel{frame_, this};
    connect(handOverPanel_, &HandOverPanel::chosen, this, [this](const std::string& name) {
        closed_.clear();
        asked_.clear();
        session_.handOver(name);
    });
    handOverPanel_->openBelow(*button_);
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
