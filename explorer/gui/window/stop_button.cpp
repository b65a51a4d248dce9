// SPDX-License-Identifier: Apache-2.0
#include "window/stop_button.hpp"

#include "model/plain_text.hpp"
#include "style/look.hpp"

#include <QApplication>
#include <QKeyEvent>
#include <QPainter>
#include <QTimer>

namespace cortex::explorer {

namespace {

constexpr int secondPress = 1000;  // ms
const std::string everything{"/"};

}  // namespace

StopButton::StopButton(Session& session, QWidget* parent)
    : QAbstractButton{parent}, order_{session} {
    showScope();
    setToolTip(
        tipText(tr("Shuts down every simplex below the path that stands on it, of every agent that "
                   "is known. It is no emergency stop: the network, and the agents, must work.")));
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
    order_.begin(prefix_, scopeWord());
    tell();
}

void StopButton::refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes) {
    // It never follows what is selected: the same key must not mean something else after a click.
    inControl_ = !frame.control.prefix.empty();
    const std::string scope = inControl_ ? frame.control.common() : everything;
    if (scope != prefix_) {
        prefix_ = scope;
        armed_.invalidate();
        showScope();
    }
    order_.refresh(frame, outcomes);
    tell();
}

void StopButton::tell() {
    if (told_ == order_.text()) return;
    told_ = order_.text();
    Q_EMIT told(told_);
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
