// SPDX-License-Identifier: Apache-2.0
#include "drive/state_diagram.hpp"

#include "cortex/explorer/theme.hpp"

#include "drive/transitions.hpp"

#include <QEvent>
#include <QPainter>
#include <QPushButton>
#include <cmath>

namespace cortex::explorer {

namespace {

using drives::Ds402State;

QFont diagramFont(const QFont& font) {
    QFont small = font;
    small.setPointSizeF(font.pointSizeF() * 0.9);
    return small;
}

bool isFaulty(Ds402State state) {
    return state == Ds402State::Fault || state == Ds402State::FaultReactionActive;
}

void paintArrowHead(QPainter& painter, QPointF before, QPointF tip, const QColor& colour) {
    const double size = units(1.5), length = std::hypot(tip.x() - before.x(), tip.y() - before.y());
    if (length <= 0) return;
    const QPointF along = (tip - before) / length, aside{-along.y(), along.x()};
    const QPointF base = tip - along * size;
    painter.setPen(Qt::NoPen);
    painter.setBrush(colour);
    painter.drawPolygon(QPolygonF{{tip, base + aside * size * 0.6, base - aside * size * 0.6}});
}

}  // namespace

StateDiagram::StateDiagram(QWidget* parent) : QWidget{parent} {
    for (const int number : askableTransitions) {
        auto* button = new QPushButton{QString::number(number), this};
        button->setAccessibleName(nameOfTransition(number));
        connect(button, &QPushButton::clicked, this, [this, number] { Q_EMIT wanted(number); });
        buttons_[static_cast<std::size_t>(number)] = button;
    }
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
    fit();
    show({});
}

QPushButton& StateDiagram::button(int transition) const {
    return *buttons_.at(static_cast<std::size_t>(transition));
}

QSize StateDiagram::sizeHint() const { return plan_.size; }

QSize StateDiagram::minimumSizeHint() const { return plan_.size; }

void StateDiagram::fit() {
    const QFont small = diagramFont(font());
    plan_ = diagramPlan(QFontMetrics{small});
    for (const int number : askableTransitions) {
        QPushButton& each = button(number);
        if (each.font() != small) each.setFont(small);
        each.setGeometry(plan_.numbers[static_cast<std::size_t>(number)].translated(leftEdge(), 0));
    }
    updateGeometry();
    update();
}

int StateDiagram::leftEdge() const { return std::max(0, (width() - plan_.size.width()) / 2); }

void StateDiagram::resizeEvent(QResizeEvent* /*event*/) { fit(); }

void StateDiagram::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange) fit();
}

QString StateDiagram::whyNoButton(int transition) const {
    if (!now_.whyNot.isEmpty()) return now_.whyNot;
    const QString ofState = whyNoTransition(transition, now_.state, now_.quickStopOption);
    return ofState.isEmpty() && leadsToEnabled(transition) ? now_.whyNotEnabled : ofState;
}

void StateDiagram::show(const DiagramNow& now) {
    if (shown_ && now == now_) return;
    shown_ = true;
    now_ = now;
    for (const int number : askableTransitions) {
        const QString why = whyNoButton(number);
        QPushButton& each = button(number);
        each.setEnabled(why.isEmpty());
        each.setToolTip(why.isEmpty() ? nameOfTransition(number)
                                      : tr("%1: %2").arg(nameOfTransition(number), why));
        each.setAccessibleDescription(why);
    }
    describe();
    update();
}

void StateDiagram::describe() {
    const QString name = nameOfState(now_.state);
    const QString next = transitionsFrom(now_.state, now_.quickStopOption);
    setAccessibleDescription(
        (now_.live ? tr("The state is %1.") : tr("The last known state is %1.")).arg(name) +
        (next.isEmpty() ? QString{} : ' ' + tr("From it lead %1.").arg(next)));
}

void StateDiagram::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.setRenderHint(QPainter::Antialiasing);
    painter.translate(leftEdge(), 0);
    painter.setFont(diagramFont(font()));
    for (const bool leads : {false, true}) {  // what leads on from here lies above
        for (const DiagramPlan::Route& each : plan_.routes) {
            const bool possible =
                stepWord(each.number, now_.state, now_.quickStopOption).has_value();
            if ((now_.live && possible) == leads) paintRoute(painter, each);
        }
    }
    for (const QRect& each : plan_.numbers)  // no line goes through a number
        painter.fillRect(each, palette().color(QPalette::Window));
    painter.setPen(textColour(Tone::Quiet));
    for (std::size_t number = 0; number < buttons_.size(); ++number) {
        if (buttons_[number] == nullptr && !plan_.numbers[number].isEmpty())
            painter.drawText(plan_.numbers[number], Qt::AlignCenter, QString::number(number));
    }
    for (const drives::Ds402StateRow& row : drives::ds402States) paintState(painter, row.state);
}

void StateDiagram::paintRoute(QPainter& painter, const DiagramPlan::Route& route) const {
    const bool leads = now_.live && stepWord(route.number, now_.state, now_.quickStopOption);
    const QColor colour = leads ? palette().color(QPalette::Highlight) : textColour(Tone::Quiet);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen{colour, leads ? 2.0 : 1.0});
    painter.drawPolyline(route.line);
    paintArrowHead(painter, route.line[route.line.size() - 2], route.line.last(), colour);
}

void StateDiagram::paintState(QPainter& painter, Ds402State state) const {
    const bool present = state == now_.state, filled = present && now_.live;
    const QRectF box = QRectF{plan_.box(state)}.adjusted(0.5, 0.5, -0.5, -0.5);
    const QColor ink = palette().color(QPalette::WindowText);
    const QColor fill = isFaulty(state) ? markColour(Tone::Fault) : ink;
    QPen edge{filled ? fill : markColour(Tone::Quiet), 1.0};
    if (present && !filled) edge = QPen{markColour(Tone::NotLive), 2.0, Qt::DashLine};
    painter.setPen(edge);
    painter.setBrush(filled ? fill : palette().color(QPalette::Base));
    painter.drawRoundedRect(box, units(0.75), units(0.75));
    painter.setPen(!filled && present ? textColour(Tone::NotLive)
                   : !filled          ? textColour(Tone::Quiet)
                   : isFaulty(state)  ? palette().color(QPalette::BrightText)
                                      : palette().color(QPalette::Window));
    painter.drawText(box, Qt::AlignCenter | Qt::TextSingleLine, nameOfState(state));
}

}  // namespace cortex::explorer
