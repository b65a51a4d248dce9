// SPDX-License-Identifier: Apache-2.0
#include "window/control_panel.hpp"

#include "cortex/core/path.hpp"

#include "model/holders.hpp"
#include "model/permission.hpp"
#include "model/plain_text.hpp"
#include "model/value_text.hpp"
#include "session/lease.hpp"
#include "style/look.hpp"

#include <QButtonGroup>
#include <QCoreApplication>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QVBoxLayout>
#include <algorithm>
#include <map>

namespace cortex::gui {

namespace {

// What each simplex below the prefix that runs does when control of it is lost.
QString onLossText(const AgentFrame& agent, const std::string& prefix) {
    std::map<OnLeaseLost, int> counts;
    int all = 0, faults = 0;
    for (std::uint32_t each = 0; each < agent.structure->simplexes.size(); ++each) {
        const SimplexInfo& info = agent.structure->simplexes[each];
        const Type& type = *info.layout->type;
        if (info.remote || !type.active() || type.isA("Agent") || !isAtOrBelow(info.path, prefix))
            continue;
        const auto state = agent.state(each);
        if (state == State::Fault) ++faults;
        if (state != State::Active && state != State::StartingUp) continue;
        ++counts[type.onLeaseLost];
        ++all;
    }
    const QString running =
        ControlPanel::tr("%1 active; when control is lost %2 go on, %3 hold, %4 shut down")
            .arg(all)
            .arg(counts[OnLeaseLost::Continue])
            .arg(counts[OnLeaseLost::Hold])
            .arg(counts[OnLeaseLost::Shutdown]);
    return faults == 0 ? running : running + ControlPanel::tr("; %1 in Fault").arg(faults);
}

constexpr double askWidth = 36;  // units, of "Ask 20 letters of a name"

}  // namespace

// Who holds what, in a place that never changes: as large as the longest text, up to some lines.
// What needs more scrolls, and is whole in the tip.
class HolderLines : public QScrollArea {
public:
    HolderLines() : label_{new QLabel} {
        label_->setTextFormat(Qt::PlainText);
        label_->setWordWrap(true);
        label_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
        setFrameShape(QFrame::NoFrame);
        setFocusPolicy(Qt::NoFocus);
        setWidgetResizable(true);
        setWidget(label_);
        label_->setAutoFillBackground(false);
        viewport()->setAutoFillBackground(false);
        QSizePolicy policy{QSizePolicy::Preferred, QSizePolicy::Fixed};
        policy.setHeightForWidth(true);
        setSizePolicy(policy);
    }
    void keepRoomFor(const QString& longest) {
        longest_ = longest;
        updateGeometry();
    }
    void show(const QString& text) {
        label_->setText(text);
        setToolTip(verticalScrollBar()->maximum() > 0 ? tipText(text) : QString{});
    }
    QSize sizeHint() const override {
        const int width = fontMetrics().size(0, longest_).width() + besideText();
        return {width, heightForWidth(width)};
    }
    QSize minimumSizeHint() const override { return {0, leastLines * fontMetrics().lineSpacing()}; }
    int heightForWidth(int width) const override {
        const QRect room{0, 0, width - besideText(), QWIDGETSIZE_MAX};
        const int height = fontMetrics().boundingRect(room, Qt::TextWordWrap, longest_).height();
        const int line = fontMetrics().lineSpacing();
        return std::clamp(height, leastLines * line, mostLines * line);
    }

private:
    int besideText() const { return verticalScrollBar()->sizeHint().width() + 2; }

    static constexpr int leastLines = 5, mostLines = 8;
    QLabel* label_;
    QString longest_;
};

ControlPanel::ControlPanel(std::shared_ptr<const Frame> frame, const std::string& path,
                           QWidget* parent)
    : Popover{tr("Take control of"), parent},
      frame_{std::move(frame)},
      buttons_{new QButtonGroup{this}},
      holders_{new HolderLines},
      ask_{new QPushButton},
      cancel_{new QPushButton{tr("Cancel")}},
      take_{new QPushButton} {
    for (std::string each = path; each.size() > 1; each.resize(each.rfind('/'))) {
        scopes_.push_back(each);
    }
    scopes_.emplace_back("/");

    for (std::size_t i = 0; i < scopes_.size(); ++i) {
        auto* button = new QRadioButton{scopeText(scopes_[i])};
        buttons_->addButton(button, static_cast<int>(i));
        rows().addWidget(button);
    }
    holders_->keepRoomFor(longest());
    rows().addWidget(holders_);
    for (QPushButton* each : {ask_, cancel_, take_}) buttons().addWidget(each);
    QSizePolicy kept = ask_->sizePolicy();
    kept.setRetainSizeWhenHidden(true);
    ask_->setSizePolicy(kept);
    ask_->setFixedWidth(Look::units(askWidth));
    connect(ask_, &QPushButton::clicked, this, [this] {
        asks() ? Q_EMIT withdrawn() : Q_EMIT asked(chosen());
        close();
    });
    connect(cancel_, &QPushButton::clicked, this, &QWidget::close);
    connect(take_, &QPushButton::clicked, this, [this] {
        Q_EMIT taken(chosen());
        close();
    });
    connect(buttons_, qOverload<QAbstractButton*>(&QButtonGroup::buttonClicked), this,
            [this] { refresh(frame_); });
    // The part of the plant that the simplex belongs to, where one is chosen.
    buttons_->button(static_cast<int>(std::max<std::size_t>(scopes_.size(), 2) - 2))
        ->setChecked(true);
    refresh(frame_);
}

const std::string& ControlPanel::chosen() const {
    return scopes_[static_cast<std::size_t>(std::max(buttons_->checkedId(), 0))];
}

void ControlPanel::choose(const std::string& prefix) {
    const auto found = std::ranges::find(scopes_, prefix);
    if (found == scopes_.end()) return;
    buttons_->button(static_cast<int>(found - scopes_.begin()))->setChecked(true);
    refresh(frame_);
}

void ControlPanel::focusChosen() {
    if (QAbstractButton* chosen = buttons_->checkedButton()) chosen->setFocus(Qt::TabFocusReason);
}

void ControlPanel::keyPressEvent(QKeyEvent* event) {
    switch (event->key()) {
        case Qt::Key_Return:
        case Qt::Key_Enter:
            (cancel_->hasFocus() ? cancel_ : ask_->hasFocus() ? ask_ : take_)->click();
            break;
        case Qt::Key_Escape:
            close();
            break;
        case Qt::Key_PageUp:
        case Qt::Key_PageDown:
            QCoreApplication::sendEvent(holders_->verticalScrollBar(), event);
            break;
        default:
            Popover::keyPressEvent(event);
    }
}

void ControlPanel::refresh(std::shared_ptr<const Frame> frame) {
    frame_ = std::move(frame);
    holders_->show(describe(chosen()));
    take_->setText(tr("Take %1").arg(scopeText(chosen())));
    showAsk();
}

bool ControlPanel::asks() const { return frame_->control.asking.prefix == chosen(); }

// Its place is kept free for it. A long name ends with "…" and is whole above.
void ControlPanel::showAsk() {
    const QString text = asks() ? tr("Withdraw") : askText(*frame_, chosen());
    const int room = ask_->width() - Look::units(6);
    ask_->setText(ask_->fontMetrics().elidedText(text, Qt::ElideRight, room, Qt::TextShowMnemonic));
    ask_->setVisible(!text.isEmpty());
}

QString ControlPanel::leaseText(const QString& agent, const comms::ShownLease& lease) const {
    const QString prefix = scopeText(lease.prefix);
    const QString since = clockText(lease.since), age = ageText(lease.seconds);
    if (lease.holder == frame_->control.self)
        return tr("%1: you hold %2 since %3 (%4)").arg(agent, prefix, since, age);
    return tr("%1: %2 holds %3 since %4 (%5)")
        .arg(agent, wholeNameOf(frame_->control, lease.holder), prefix, since, age);
}

// Who holds a part of it and does not say who uses it.
QString ControlPanel::whyNotAsked(const std::string& prefix) const {
    const auto asked = canBeAsked(*frame_, prefix);
    QStringList silent;
    for (const std::string& each : holdersAt(*frame_, prefix)) {
        if (std::ranges::find(asked, each) == asked.end())
            silent << wholeNameOf(frame_->control, each);
    }
    return silent.isEmpty() ? QString{}
                            : tr("Who does not say who uses it cannot be asked: %1.")
                                  .arg(silent.join(QStringLiteral(", ")));
}

// What it may have to say once others have taken something.
QString ControlPanel::longest() const {
    comms::ShownLease held;
    const std::string& self = frame_->control.self;
    std::string person = frame_->control.person;
    for (const comms::ToolStatus& each : frame_->control.tools) {
        if (each.person.size() > person.size()) person = each.person;
    }
    held.holder = person + " (" + (self.empty() ? "cortex@host.123456-5e1f0a" : self + "00") + ")";
    held.prefix = scopes_.front();
    held.seconds = 6000;
    for (const std::string& each : frame_->control.prefixes()) {
        if (each.size() > held.prefix.size()) held.prefix = each;
    }
    return describe("/", &held);
}

QString ControlPanel::describe(const std::string& prefix, const comms::ShownLease* held) const {
    QStringList lines;
    for (const AgentFrame& agent : frame_->agents) {
        if (agent.lost() || !hasBelow(agent, prefix)) continue;
        const QString name = QString::fromStdString(agent.status.name);
        const bool others =
            held != nullptr || leaseOfOthers(agent, prefix, frame_->control.self).has_value();
        const auto leases = held != nullptr ? std::vector{*held} : leasesOf(agent);
        for (const comms::ShownLease& each : leases) lines << leaseText(name, each);
        if (!others) lines << tr("%1: nobody else holds a part of it").arg(name);
        if (others) lines << tr("    They must release it or hand it over; nobody can take it.");
        lines << QStringLiteral("    ") + onLossText(agent, prefix);
    }
    if (lines.isEmpty()) lines << tr("Nobody who is heard has anything there.");
    if (const QString why = whyNotAsked(prefix); !why.isEmpty()) lines << why;
    QStringList released;
    for (const std::string& each : frame_->control.prefixes()) {
        if (each != prefix) released << scopeText(each);
    }
    if (held != nullptr && released.isEmpty()) released << scopeText(held->prefix);
    if (!released.isEmpty()) {
        lines << tr("To take %1 releases %2, which you control now.")
                     .arg(scopeText(prefix), released.join(tr(", ")));
    }
    if (!frame_->control.self.empty())
        lines << tr("To others you are %1.").arg(ownName(frame_->control));
    return lines.join('\n');
}

}  // namespace cortex::gui
