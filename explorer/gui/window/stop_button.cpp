// SPDX-License-Identifier: Apache-2.0
#include "window/stop_button.hpp"

#include "cortex/core/path.hpp"

#include "model/plain_text.hpp"
#include "session/lease.hpp"
#include "style/look.hpp"

#include <QApplication>
#include <QKeyEvent>
#include <QPainter>
#include <QTimer>
#include <algorithm>

namespace cortex::explorer {

namespace {

constexpr int secondPress = 1000;  // ms
constexpr int lastValues = 1000;   // ms after the last answer, until states are told too
constexpr int mostNamed = 3;
const std::string everything{"/"};

bool isStoppable(const SimplexInfo& info, const std::string& prefix) {
    const Type& type = *info.layout->type;
    return !info.remote && type.active() && !type.isA("Agent") && isAtOrBelow(info.path, prefix);
}

}  // namespace

StopButton::StopButton(Session& session, QWidget* parent)
    : QAbstractButton{parent}, session_{session} {
    showScope();
    setToolTip(tipText(
        tr("Shuts down every simplex below the path that stands on it, of every agent that is "
           "heard. It is no emergency stop: the network, and the agents, must work.")));
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    connect(this, &QAbstractButton::clicked, this, &StopButton::stop);
    QApplication::instance()->installEventFilter(this);
}

QSize StopButton::sizeHint() const { return {Look::units(49), Look::units(8)}; }

bool StopButton::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::KeyPress) return QAbstractButton::eventFilter(watched, event);
    const auto* key = static_cast<QKeyEvent*>(event);
    if (key->key() != Qt::Key_F12) return QAbstractButton::eventFilter(watched, event);
    // A press goes to the window and then to the widget that has the focus: only the widget counts.
    if (watched->isWidgetType() && !key->isAutoRepeat()) pressedByKey();
    return watched->isWidgetType();
}

void StopButton::pressedByKey() {
    if (inControl_ || (armed_.isValid() && !armed_.hasExpired(secondPress))) {
        stop();
        return;
    }
    armed_.start();
    setText(tr("F12 again: stop %1").arg(scopeWord()));
    QTimer::singleShot(secondPress, this, [this] {
        if (armed_.isValid() && !armed_.hasExpired(secondPress - 1)) return;  // pressed again
        armed_.invalidate();
        showScope();
    });
}

QString StopButton::scopeWord() const {
    return prefix_ == "/" ? tr("all") : QString::fromStdString(prefix_);
}

void StopButton::showScope() {
    setText(tr("Stop %1").arg(scopeWord()));
    setAccessibleName(tr("Stop %1, F12").arg(scopeWord()));
    update();
}

void StopButton::stop() {
    armed_.invalidate();
    showScope();
    const auto frame = session_.frame();
    stopped_ = scopeWord();
    stopping_.clear();
    unanswered_.clear();
    refusals_.clear();
    since_.start();
    answered_.start();
    for (const AgentFrame& agent : frame->agents) {
        if (agent.structure && !hasBelow(agent, prefix_)) continue;
        if (agent.lost()) {
            refusals_ << tr("%1 is not heard").arg(QString::fromStdString(agent.status.name));
            continue;
        }
        unanswered_.push_back(
            session_.send("/" + agent.status.name, "shutdown", {{"prefix", prefix_}}));
        if (!agent.structure) continue;
        for (const SimplexInfo& info : agent.structure->simplexes) {
            if (isStoppable(info, prefix_)) stopping_.push_back(info.path);
        }
    }
    active_ = true;
    if (unanswered_.empty()) {
        active_ = false;
        say(refusals_.isEmpty() ? tr("Nobody is heard: nothing was stopped.")
                                : tr("Nothing was stopped: %1.").arg(refusals_.join(", ")));
        return;
    }
    countStates(*frame);
}

void StopButton::refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes) {
    // It never follows what is selected: the same key must not mean something else after a click.
    inControl_ = !frame.control.prefix.empty();
    const std::string& scope = inControl_ ? frame.control.prefix : everything;
    if (scope != prefix_) {
        prefix_ = scope;
        armed_.invalidate();
        showScope();
    }
    for (const CommandOutcome& each : outcomes) {
        if (std::erase(unanswered_, each.number) == 0 || each.answer.done()) continue;
        const std::string why = each.problem.empty() ? each.answer.text() : each.problem;
        refusals_ << tr("%1: %2").arg(QString::fromStdString(each.path.substr(1)),
                                      QString::fromStdString(why));
    }
    if (!unanswered_.empty()) answered_.restart();
    if (active_) countStates(frame);
}

// What is in Standby, and in the end what is not and why.
void StopButton::countStates(const Frame& frame) {
    QStringList others;
    int left = 0;
    for (const std::string& path : stopping_) {
        const auto place = frame.find(path);
        const auto state = place ? frame.agents[place->agent].state(place->simplex) : std::nullopt;
        if (state == State::Standby) continue;
        ++left;
        if (others.size() < mostNamed) {
            others << tr("%1 (%2)").arg(
                QString::fromStdString(path),
                state ? QString{QLatin1String{name(*state)}} : tr("not heard"));
        }
    }
    const auto all = static_cast<int>(stopping_.size());
    const QString seconds = QString::number(static_cast<double>(since_.elapsed()) / 1000, 'f', 1);
    if (!unanswered_.empty() || (left > 0 && !answered_.hasExpired(lastValues))) {
        say(tr("Stopping %1: %2 of %3 in Standby").arg(stopped_).arg(all - left).arg(all));
        return;
    }
    active_ = false;
    if (left > 0) {
        if (left > mostNamed) others << QStringLiteral("…");
        refusals_.prepend(tr("%1 did not follow: %2").arg(left).arg(others.join(", ")));
    }
    say(refusals_.isEmpty() ? tr("All %1 in Standby, %2 s").arg(all).arg(seconds)
                            : refusals_.join(QStringLiteral("; ")));
}

void StopButton::say(const QString& progress) {
    if (progress == progress_) return;
    progress_ = progress;
    Q_EMIT told(progress);
}

void StopButton::paintEvent(QPaintEvent* /*event*/) {
    const Tokens& colours = Look::colours();
    QPainter painter{this};
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(colours.stop);
    const double inset = hasFocus() ? Look::length(1) : 0;
    const QRectF box = QRectF{rect()}.adjusted(inset, inset, -inset, -inset);
    painter.drawRoundedRect(box, Look::length(1), Look::length(1));
    if (hasFocus()) {
        painter.setPen(QPen{colours.accent, 2.0});
        painter.setBrush(Qt::NoBrush);
        painter.drawRoundedRect(QRectF{rect()}.adjusted(1, 1, -1, -1), Look::length(1),
                                Look::length(1));
    }
    painter.setPen(colours.onStop);
    painter.setFont(Look::font(TextSize::Text, true));
    const QRect inner = rect().adjusted(Look::units(3), 0, -Look::units(3), 0);
    if (armed_.isValid()) {
        painter.drawText(inner, Qt::AlignCenter, text());
        return;
    }
    const int room = inner.width() - Look::units(10);
    painter.drawText(inner, int{Qt::AlignVCenter} | int{Qt::AlignLeft},
                     painter.fontMetrics().elidedText(text(), Qt::ElideMiddle, room));
    painter.drawText(inner, int{Qt::AlignVCenter} | int{Qt::AlignRight}, QStringLiteral("F12"));
}

}  // namespace cortex::explorer
