// SPDX-License-Identifier: Apache-2.0
#include "window/control_bar.hpp"

#include "model/holders.hpp"
#include "model/permission.hpp"
#include "model/plain_text.hpp"
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
#include <functional>
#include <utility>

namespace cortex::gui {

namespace {

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
    connect(&notice_->remedy(), &QPushButton::clicked, this, &ControlBar::act);
    connect(&notice_->refuse(), &QPushButton::clicked, this, &ControlBar::refuse);
    connect(notice_, &ControlNotice::closed, this, &ControlBar::closeNotice);
}

// "everything but robot".
QString ControlBar::partText(const std::string& prefix) const {
    const QStringList others = uncontrolled(*frame_, prefix);
    QString scope = narrow_ && prefix == "/" ? tr("all") : scopeText(prefix);
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
    if (control.prefix.empty())
        return control.asking.prefix.empty() ? readOnlyText() : askingText();
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
    QString what = tr("You control %1").arg(parts.join(tr(" and ")));
    const QString since = sinceText();
    if (narrow_ || since.isEmpty() || !isWhole(held.front())) return what;
    return tr("%1 since %2").arg(what, since);
}

// Stop needs no control, but somebody who hears it, and the right to command.
QString ControlBar::readOnlyText() const {
    const bool stops = !frame_->control.rights.empty() &&
                       std::ranges::any_of(frame_->agents, std::not_fn(&AgentFrame::lost));
    QString least = tr("Read-only");
    if (!stops) return least;
    const QMargins margins = layout()->contentsMargins();
    const int room = room_ - margins.left() - layout()->spacing() - button_->minimumWidth() - 2;
    for (const QString& each : {tr("Read-only; Stop works"), tr("Only Stop works")}) {
        if (QFontMetrics{label_->font()}.horizontalAdvance(each) <= room) return each;
    }
    return least;
}

void ControlBar::setRoom(int room) {
    if (std::exchange(room_, room) == room) return;
    label_->show(text());
    layout()->activate();  // nothing is cut until the next request to lay it out
}

// Where it is narrow, the name gives way.
QString ControlBar::askingText() const {
    const Control& control = frame_->control;
    QStringList asked;
    for (const auto& each : control.asking.holders) {
        if (!each.person.empty() && !each.refused) asked << shortNameOf(control, each.name);
    }
    const QString scope = scopeText(control.asking.prefix);
    if (narrow_ || asked.isEmpty()) return tr("Asking for %1").arg(scope);
    const QString who = asked.size() == 1 ? cutName(asked.front(), longestNames)
                                          : tr("%1 people").arg(asked.size());
    return tr("Asking %1 for %2").arg(who, scope);
}

// Empty, where not all that is held is so since the same time.
QString ControlBar::sinceText() const {
    const auto& held = frame_->control.held;
    const QString first = clockText(frame_->control.since);
    const bool same = frame_->control.prefixes().size() == 1 &&
                      std::ranges::all_of(held, [&](const comms::LeaseClient::Lease& each) {
                          return clockText(each.since) == first;
                      });
    return same ? first : QString{};
}

QString ControlBar::heldText() const {
    QStringList parts;
    for (const std::string& each : frame_->control.prefixes()) parts << scopeText(each);
    return parts.join(tr(" and "));
}

// All of them with their times, for the tooltip, and who asks for some of it.
QString ControlBar::wholeText() const {
    const Control& control = frame_->control;
    QStringList parts;
    for (const std::string& each : control.prefixes()) {
        const QStringList others = uncontrolled(*frame_, each);
        QString part = scopeText(each);
        if (!others.isEmpty()) part = tr("%1, but not of %2").arg(part, others.join(tr(" and ")));
        const auto lease =
            std::ranges::find(control.held, each, &comms::LeaseClient::Lease::prefix);
        parts << tr("%1 since %2").arg(part, clockText(lease->since));
    }
    QStringList lines;
    if (!parts.isEmpty()) lines << tr("You control %1").arg(parts.join(QStringLiteral("; ")));
    for (const auto& each : control.asked)
        lines << tr("%1 asks for %2").arg(wholeNameOf(control, each.tool), scopeText(each.prefix));
    if (!control.asking.prefix.empty())
        lines << tr("Asking for %1").arg(scopeText(control.asking.prefix));
    if (lines.isEmpty())
        lines << tr(
            "Read-only: this window changes nothing until it takes control. Only Stop "
            "needs no control.");
    return lines.join('\n');
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
    button_->setMinimumWidth(widthOf(*button_, tr("Take control…")));
}

// Nobody answers one person with a press that was meant for another one, or for something else.
void ControlBar::refreshNotice() {
    news_.refresh(*frame_);
    const ControlNews::Row& row = news_.row();
    const bool same = row.act == shown_.act && row.prefix == shown_.prefix &&
                      row.asked.tool == shown_.asked.tool &&
                      row.asked.number == shown_.asked.number;
    if (!same) notice_->show({}, {});
    shown_ = row;
    notice_->show(row.text, row.remedy, row.refusal);
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
    connect(panel_, &ControlPanel::asked, this, &ControlBar::ask);
    connect(panel_, &ControlPanel::withdrawn, this, [this] { session_.withdrawAsk(); });
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
    connect(handOverPanel_, &HandOverPanel::chosen, this,
            [this](const std::string& name) { session_.handOver(name); });
    handOverPanel_->openBelow(*button_);
    handOverPanel_->focusFirst();
}

void ControlBar::take(const std::string& prefix) { session_.takeControl(prefix); }

void ControlBar::ask(const std::string& prefix) { session_.askForControl(prefix); }

void ControlBar::act() {
    switch (shown_.act) {
        case ControlNews::Act::None:
            break;
        case ControlNews::Act::Take:
            take(shown_.prefix);
            break;
        case ControlNews::Act::Ask:
            ask(shown_.prefix);
            break;
        case ControlNews::Act::Withdraw:
            session_.withdrawAsk();
            break;
        case ControlNews::Act::Grant:
            session_.grant(shown_.asked);
            break;
    }
}

void ControlBar::refuse() {
    if (shown_.act == ControlNews::Act::Grant) session_.refuse(shown_.asked);
}

// What was said about what is released is over; whom it asks is not.
void ControlBar::release() {
    if (shown_.act != ControlNews::Act::Withdraw) closeNotice();
    session_.releaseControl();
}

void ControlBar::closeNotice() {
    news_.close();
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
