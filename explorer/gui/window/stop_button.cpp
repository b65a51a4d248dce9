// SPDX-License-Identifier: Apache-2.0
#include "window/stop_button.hpp"

#include "cortex/core/path.hpp"

#include "model/plain_text.hpp"
#include "style/look.hpp"

#include <QApplication>
#include <QKeyEvent>
#include <QPainter>
#include <algorithm>
#include <array>
#include <utility>

namespace cortex::gui {

namespace {

constexpr int secondPress = 3000;  // ms
const std::string everything{"/"};

// In two lines, broken at a blank or before a "/", or anywhere; none: they have no room.
QStringList broken(const QString& text, bool anywhere, const QFontMetrics& metrics, int room) {
    if (metrics.horizontalAdvance(text) > 2 * room) return {};
    for (int at = 1; at < text.size(); ++at) {
        if (!anywhere && text[at] != ' ' && text[at] != '/') continue;
        const QString first = text.left(at), last = text.mid(at).trimmed();
        if (metrics.horizontalAdvance(first) > room) break;
        if (metrics.horizontalAdvance(last) <= room) return {first, last};
    }
    return {};
}

}  // namespace

StopButton::StopButton(Session& session, QWidget* parent)
    : QAbstractButton{parent}, order_{session, Order::Stop} {
    armed_.setSingleShot(true);
    armed_.setInterval(secondPress);
    showScope();
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    connect(&armed_, &QTimer::timeout, this, &StopButton::showScope);
    connect(this, &QAbstractButton::clicked, this, &StopButton::press);
    QApplication::instance()->installEventFilter(this);
}

QSize StopButton::sizeHint() const { return {Look::units(49), Look::units(8)}; }

bool StopButton::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::KeyPress) return QAbstractButton::eventFilter(watched, event);
    const auto* key = static_cast<QKeyEvent*>(event);
    if (key->key() != Qt::Key_F12) return QAbstractButton::eventFilter(watched, event);
    // A press goes to the window and then to the widget that has the focus: only the widget counts.
    if (watched->isWidgetType() && !key->isAutoRepeat()) press();
    return watched->isWidgetType();
}

void StopButton::press() {
    if (!isHeld_ && !isArmed()) {
        armed_.start();
        showScope();
        return;
    }
    disarm();
    order_.begin(wanted_, isHeld_ ? Order::Whom::Held : Order::Whom::All);
    Q_EMIT begun();
}

void StopButton::disarm() {
    armed_.stop();
    showScope();
}

void StopButton::showScope() {
    const QString whole = this->whole();
    setText(saying(scopeWord(scope_) + but()));
    setAccessibleName((isArmed() ? tr("Again: stop %1, F12") : tr("Stop %1, F12")).arg(whole));
    const QString presses = isHeld_ ? tr("One press does it, as all of it is controlled here.")
                                    : tr("It takes a second press, as it is more than is "
                                         "controlled here.");
    setToolTip(
        tipText(tr("Stop %1 (F12): shuts down every simplex there, of every agent that is "
                   "known. It needs no control. %2 It is no emergency stop: the network, and "
                   "the agents, must work.")
                    .arg(whole, presses)));
    update();
}

QString StopButton::saying(const QString& scope) const {
    if (isArmed()) return tr("Again: stop %1").arg(scope);
    return (chosen_ ? tr("Stop always %1") : tr("Stop %1")).arg(scope);
}

// " but robot": what is not stopped.
QString StopButton::but() const {
    if (others_.isEmpty()) return {};
    const int count = others_.size();
    return tr(" but %1").arg(count == 1 ? others_.front() : tr("%n agents", nullptr, count));
}

// All paths, and that the signed rights end there.
QString StopButton::whole() const {
    const QString words = scopeWords(scope_) + but();
    return scope_ != wanted_ ? tr("%1, all that you may stop").arg(words) : words;
}

void StopButton::stop(const std::string& prefix, const std::string& agent) {
    disarm();
    order_.begin({prefix}, Order::Whom::All, agent);
    Q_EMIT begun();
}

void StopButton::setScope(std::optional<std::string> prefix) {
    chosen_ = std::move(prefix);
    if (chosen_) scope_ = wanted_ = {*chosen_};
    others_.clear();
    isHeld_ = false;  // as long as the next frame does not say so
    disarm();
}

void StopButton::refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes) {
    // It never follows what is selected: the same key must not mean something else after a click.
    const std::vector<std::string> held = widest(frame.control.prefixes());
    std::vector<std::string> wanted = held.empty() ? std::vector{everything} : held;
    if (chosen_) wanted = {*chosen_};
    std::vector<std::string> scope = permitted(wanted, frame.control.rights);
    QStringList others = leftOut(frame, scope);
    const bool isCovered = std::ranges::all_of(scope, [&](const std::string& each) {
        return std::ranges::any_of(held,
                                   [&](const std::string& own) { return isAtOrBelow(each, own); });
    });
    // What a person chose is stopped as a whole.
    const bool isHeld = isCovered && (!chosen_ || others.isEmpty());
    if (!isHeld) others.clear();
    if (scope != scope_ || isHeld != isHeld_ || others != others_ || wanted != wanted_) {
        scope_ = std::move(scope);
        wanted_ = std::move(wanted);
        others_ = std::move(others);
        isHeld_ = isHeld;
        disarm();
    }
    order_.refresh(frame, outcomes);
}

// All words, or one path for all of them. What has no room even so is cut at its left, as paths
// differ at their ends.
QStringList StopButton::twoLines(QFont& font, int room) const {
    constexpr std::array ways{std::pair{true, false}, std::pair{false, false},
                              std::pair{false, true}};  // strong, broken anywhere
    QString scope = scopeWord(scope_) + but();
    QStringList sayings{saying(scope)};
    if (scope_.size() > 1) {
        scope = tr("%1 and %2 more")
                    .arg(QString::fromStdString(scope_.front()))
                    .arg(scope_.size() - 1) +
                but();
        sayings << saying(scope);
    }
    for (int rest = scope.size() - 1; rest > 0; --rest)
        sayings << saying(QStringLiteral("…") + scope.right(rest));
    for (const QString& each : qAsConst(sayings)) {
        for (const auto& [strong, anywhere] : ways) {
            font = Look::font(TextSize::Note, strong);
            const QStringList lines = broken(each, anywhere, QFontMetrics{font}, room);
            if (!lines.isEmpty()) return lines;
        }
    }
    return {};
}

// In one line, where F12 gives way first, otherwise in two small ones.
void StopButton::paintWords(QPainter& painter) const {
    const int side = isArmed() ? int{Qt::AlignHCenter} : int{Qt::AlignLeft};
    QFont font = Look::font(TextSize::Text, true);
    const QRect inner = rect().adjusted(Look::units(3), 0, -Look::units(3), 0);
    const int width = QFontMetrics{font}.horizontalAdvance(text());
    if (width <= inner.width()) {
        painter.setFont(font);
        painter.drawText(inner, int{Qt::AlignVCenter} | side, text());
        if (width <= inner.width() - Look::units(10) && !isArmed())
            painter.drawText(inner, int{Qt::AlignVCenter} | int{Qt::AlignRight},
                             QStringLiteral("F12"));
        return;
    }
    const QRect room = rect().adjusted(Look::units(1), 0, -Look::units(1), 0);
    const QStringList lines = twoLines(font, room.width());
    painter.setFont(font);
    const QFontMetrics metrics{font};
    const int pitch = std::min(metrics.height(), Look::units(3.5));
    int top = (height() - metrics.capHeight() - pitch - metrics.descent() / 2) / 2 +
              metrics.capHeight() - metrics.ascent();
    for (const QString& each : lines) {
        painter.drawText(QRect{room.left(), top, room.width(), metrics.height()},
                         side | int{Qt::TextDontClip}, each);
        top += pitch;
    }
}

void StopButton::paintEvent(QPaintEvent* /*event*/) {
    const Tokens& colours = Look::colours();
    QPainter painter{this};
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(colours.stop);
    const double inset = hasFocus() ? Look::length(0.75) : 0;
    const QRectF box = QRectF{rect()}.adjusted(inset, inset, -inset, -inset);
    painter.drawRoundedRect(box, Look::length(1), Look::length(1));
    if (hasFocus()) {
        painter.setPen(QPen{colours.accent, 2.0});
        painter.setBrush(Qt::NoBrush);
        painter.drawRoundedRect(QRectF{rect()}.adjusted(1, 1, -1, -1), Look::length(1),
                                Look::length(1));
    }
    painter.setPen(colours.onStop);
    paintWords(painter);
}

}  // namespace cortex::gui
