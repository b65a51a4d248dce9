// SPDX-License-Identifier: Apache-2.0
#include "style/shapes.hpp"

#include <QCoreApplication>
#include <QPainterPath>
#include <QPolygonF>
#include <cmath>
#include <numbers>

namespace cortex::gui {

namespace {

// A painter whose unit square from -1 to 1 is the box, with a pen of a seventh of it.
class Unit {
public:
    Unit(QPainter& painter, const QRectF& box) : painter_{painter} {
        painter.save();
        painter.setRenderHint(QPainter::Antialiasing);
        painter.translate(box.center());
        painter.scale(box.width() / 2, box.height() / 2);
    }
    ~Unit() { painter_.restore(); }
    Unit(const Unit&) = delete;
    Unit& operator=(const Unit&) = delete;

    void line(const QColor& colour, Qt::PenStyle style = Qt::SolidLine) {
        QPen pen{colour, thick, style, Qt::FlatCap, Qt::MiterJoin};
        if (style == Qt::DashLine) pen.setDashPattern({1.6, 1.2});
        painter_.setPen(pen);
        painter_.setBrush(Qt::NoBrush);
    }
    void fill(const QColor& colour) {
        painter_.setPen(Qt::NoPen);
        painter_.setBrush(colour);
    }
    QPainter* operator->() { return &painter_; }

    static constexpr double thick = 0.24;

private:
    QPainter& painter_;
};

QPolygonF octagon(double radius) {
    QPolygonF points;
    for (int i = 0; i < 8; ++i) {
        const double angle = (2 * i + 1) * std::numbers::pi / 8;
        points << QPointF{radius * std::cos(angle), radius * std::sin(angle)};
    }
    return points;
}

QPolygonF triangle(double direction) {
    return {{{-0.95, 0.8 * direction}, {0.95, 0.8 * direction}, {0, -0.85 * direction}}};
}

const QPolygonF rhombus{{{0, -0.8}, {0.8, 0}, {0, 0.8}, {-0.8, 0}}};

void ring(Unit& unit, double radius = 0.78) { unit->drawEllipse(QPointF{}, radius, radius); }

void arrow(Unit& unit, double direction) {
    unit->drawLine(QLineF{0, 0.42 * direction, 0, -0.4 * direction});
    unit->drawPolyline(
        QPolygonF{{{-0.36, -0.02 * direction}, {0, -0.4 * direction}, {0.36, -0.02 * direction}}});
}

// An exclamation mark; `i` stands on its head.
void bang(Unit& unit, const QColor& colour, double direction = 1) {
    unit.fill(colour);
    unit->drawRect(
        QRectF{QPointF{-0.14, -0.52 * direction}, QPointF{0.14, 0.14 * direction}}.normalized());
    unit->drawRect(
        QRectF{QPointF{-0.14, 0.3 * direction}, QPointF{0.14, 0.58 * direction}}.normalized());
}

void paintState(Unit& unit, Shape shape, const Tokens& c) {
    if (shape == Shape::Active) {
        unit.fill(c.ink);
        ring(unit, 0.9);
        return;
    }
    unit.line(c.ink, shape == Shape::Unknown ? Qt::DashLine : Qt::SolidLine);
    ring(unit);
    if (shape == Shape::StartingUp) arrow(unit, 1);
    if (shape == Shape::ShuttingDown) arrow(unit, -1);
}

void paintKind(Unit& unit, Shape shape, const Tokens& c) {
    unit.line(c.ink2);
    if (shape == Shape::Ended) {
        ring(unit);
        unit.fill(c.ink2);
        unit->drawRect(QRectF{-0.34, -0.34, 0.68, 0.68});
    }
    if (shape == Shape::Data) unit->drawPolygon(rhombus);
    if (shape == Shape::Path) unit->drawRoundedRect(QRectF{-0.62, -0.62, 1.24, 1.24}, 0.25, 0.25);
    if (shape == Shape::Agent) {
        unit->drawRect(QRectF{-0.85, -0.75, 1.7, 1.05});
        unit->drawLine(QLineF{-0.55, 0.78, 0.55, 0.78});
        unit->drawLine(QLineF{0, 0.3, 0, 0.78});
    }
}

void paintQuality(Unit& unit, Shape shape, const Tokens& c) {
    unit.line(c.data);
    if (shape == Shape::Bad) {
        unit->drawPolygon(rhombus);
        unit->drawLine(QLineF{-0.3, -0.3, 0.3, 0.3});
        unit->drawLine(QLineF{-0.3, 0.3, 0.3, -0.3});
        return;
    }
    ring(unit);
    if (shape == Shape::Lost) {
        unit->drawLine(QLineF{-0.52, 0.52, 0.52, -0.52});
    } else {
        unit->drawPolyline(QPolygonF{{{0, -0.5}, {0, 0.05}, {0.42, 0.05}}});
    }
}

void paintTrouble(Unit& unit, Shape shape, const Tokens& c) {
    switch (shape) {
        case Shape::AboveLimit:
        case Shape::BelowLimit:
            unit.fill(c.warnEdge);
            unit->drawPolygon(triangle(shape == Shape::AboveLimit ? 1 : -1));
            break;
        case Shape::NoLabel:  // "is not equal to any"
            unit.line(c.warnEdge);
            unit->drawLine(QLineF{-0.8, -0.3, 0.8, -0.3});
            unit->drawLine(QLineF{-0.8, 0.3, 0.8, 0.3});
            unit->drawLine(QLineF{-0.4, 0.85, 0.4, -0.85});
            break;
        case Shape::Contradiction:
            unit.line(c.warnEdge);
            unit->drawRect(QRectF{-0.8, -0.8, 1.05, 1.05});
            unit->drawRect(QRectF{-0.25, -0.25, 1.05, 1.05});
            break;
        case Shape::Incomplete:
            unit.line(c.ink);
            ring(unit);
            unit.fill(c.ink);
            unit->drawPie(QRectF{-0.78, -0.78, 1.56, 1.56}, 0, 90 * 16);
            break;
        case Shape::Info:
            unit.line(c.ink2);
            ring(unit);
            bang(unit, c.ink2, -1);
            break;
        case Shape::Warning: {
            QPainterPath path;
            path.addPolygon(triangle(1));
            path.closeSubpath();
            unit.fill(c.warnEdge);
            unit->drawPath(path);
            break;
        }
        default:  // Fault, Error
            unit.fill(c.fault);
            unit->drawPolygon(octagon(1));
            bang(unit, c.onFault);
    }
}

}  // namespace

QString word(Shape shape) {
    static constexpr std::array words{
        "Standby",     "StartingUp",  "Active",   "ShuttingDown",  "Fault",      "unknown",
        "data",        "path",        "agent",    "stale",         "bad",        "lost",
        "above limit", "below limit", "no label", "contradiction", "incomplete", "info",
        "warning",     "error",       "ended"};
    static_assert(words.size() == allShapes.size());
    return QCoreApplication::translate("Shape", words[static_cast<std::size_t>(shape)]);
}

Shape shapeOf(State state) {
    switch (state) {
        case State::Standby:
            return Shape::Standby;
        case State::StartingUp:
            return Shape::StartingUp;
        case State::Active:
            return Shape::Active;
        case State::ShuttingDown:
            return Shape::ShuttingDown;
        case State::Fault:
            return Shape::Fault;
    }
    return Shape::Unknown;
}

std::optional<Shape> shapeOf(Quality quality) {
    switch (quality) {
        case Quality::Good:
            return std::nullopt;
        case Quality::Stale:
            return Shape::Stale;
        case Quality::Bad:
            return Shape::Bad;
        case Quality::Lost:
            return Shape::Lost;
    }
    return Shape::Bad;
}

Shape shapeOf(Severity severity) {
    switch (severity) {
        case Severity::Info:
            return Shape::Info;
        case Severity::Warning:
            return Shape::Warning;
        case Severity::Error:
            return Shape::Error;
    }
    return Shape::Error;
}

void paint(QPainter& painter, const QRectF& box, Shape shape, const Tokens& colours) {
    Unit unit{painter, box};
    if (shape < Shape::Fault || shape == Shape::Unknown) {
        paintState(unit, shape, colours);
    } else if (shape == Shape::Data || shape == Shape::Path || shape == Shape::Agent ||
               shape == Shape::Ended) {
        paintKind(unit, shape, colours);
    } else if (shape == Shape::Stale || shape == Shape::Bad || shape == Shape::Lost) {
        paintQuality(unit, shape, colours);
    } else {
        paintTrouble(unit, shape, colours);
    }
}

QColor textColour(Shape shape, const Tokens& colours) {
    switch (shape) {
        case Shape::Fault:
        case Shape::Error:
            return colours.faultText;
        case Shape::Stale:
        case Shape::Bad:
        case Shape::Lost:
            return colours.dataText;
        case Shape::AboveLimit:
        case Shape::BelowLimit:
        case Shape::NoLabel:
        case Shape::Contradiction:
        case Shape::Warning:
            return colours.warnText;
        default:
            return colours.ink;
    }
}

}  // namespace cortex::gui
