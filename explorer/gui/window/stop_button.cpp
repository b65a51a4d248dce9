// SPDX-License-Identifier: Apache-2.0
#include "window/stop_button.hpp"

#include "model/plain_text.hpp"
#include "style/look.hpp"

#include <QApplication>
#include <QKeyEvent>
#include <QPainter>
#include <QTimer>
#include <utility>

namespace cortex::gui {

namespace {

constexpr int secondPress = 1000;  // ms
const std::string everything{"/"};

}  // namespace

StopButton::StopButton(Session& session, QWidget* parent)
    : QAbstractButton{parent}, order_{session, Order::Stop} {
    showScope();
    setToolTip(
        tipText(tr("Shuts down every simplex below the path that stands on it, of every agent that "
                   "is known. It is no emergency stop: the network, and the agents, must work.")));
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    connect(this, &QAbstractButton::clicked, this, [this] { stop(prefix_); });
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
        stop(prefix_);
        return;
    }
    armed_.start();
    setText(tr("F12 again: stop %1").arg(scopeWord(prefix_)));
    QTimer::singleShot(secondPress, this, [this] {
        if (armed_.isValid() && !armed_.hasExpired(secondPress - 1)) return;  // pressed again
        armed_.invalidate();
        showScope();
    });
}

void StopButton::showScope() {
    setText((chosen_ ? tr("Stop always %1") : tr("Stop %1")).arg(scopeWord(prefix_)));
    setAccessibleName(tr("Stop %1, F12").arg(scopeWord(prefix_)));
    update();
}

void StopButton::stop(const std::string& prefix) {
    armed_.invalidate();
    showScope();
    Q_EMIT begun();
    order_.begin(prefix);
}

void StopButton::setScope(std::optional<std::string> prefix) {
    chosen_ = std::move(prefix);
    if (chosen_) prefix_ = *chosen_;
    armed_.invalidate();
    showScope();
}

void StopButton::refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes) {
    // It never follows what is selected: the same key must not mean something else after a click.
    inControl_ = !frame.control.prefix.empty();
    const std::string own = inControl_ ? frame.control.common() : everything;
    const std::string scope = chosen_.value_or(own);
    if (scope != prefix_) {
        prefix_ = scope;
        armed_.invalidate();
        showScope();
    }
    order_.refresh(frame, outcomes);
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
        const bool fits = painter.fontMetrics().horizontalAdvance(text()) <= inner.width();
        painter.drawText(inner, Qt::AlignCenter, fits ? text() : tr("F12 again"));
        return;
    }
    const int room = inner.width() - Look::units(10);
    painter.drawText(inner, int{Qt::AlignVCenter} | int{Qt::AlignLeft},
                     painter.fontMetrics().elidedText(text(), Qt::ElideMiddle, room));
    painter.drawText(inner, int{Qt::AlignVCenter} | int{Qt::AlignRight}, QStringLiteral("F12"));
}

}  // namespace cortex::gui
