// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/quality.hpp"
#include "cortex/core/report.hpp"
#include "cortex/core/state.hpp"

#include "style/tokens.hpp"

#include <QPainter>
#include <QRectF>
#include <QString>
#include <array>
#include <optional>

// Marks that say what something is or how it is, each with its word: never by colour alone.
namespace cortex::gui {

enum class Shape {
    Standby,
    StartingUp,
    Active,
    ShuttingDown,
    Fault,
    Unknown,  // a simplex whose state was not heard
    Data,     // a simplex without a state
    Path,     // a part of paths that is no simplex
    Agent,
    Stale,
    Bad,
    Lost,
    AboveLimit,
    BelowLimit,
    NoLabel,  // of a closed enumeration, whose labels are its limits
    Contradiction,
    Incomplete,
    Info,
    Warning,
    Error,
    Ended,  // an agent that has said so
};

inline constexpr std::array allShapes{
    Shape::Standby,       Shape::StartingUp, Shape::Active,     Shape::ShuttingDown, Shape::Fault,
    Shape::Unknown,       Shape::Data,       Shape::Path,       Shape::Agent,        Shape::Stale,
    Shape::Bad,           Shape::Lost,       Shape::AboveLimit, Shape::BelowLimit,   Shape::NoLabel,
    Shape::Contradiction, Shape::Incomplete, Shape::Info,       Shape::Warning,      Shape::Error,
    Shape::Ended};

QString word(Shape shape);  // "StartingUp", "above limit"

// Whether it marks a value that is beyond its limits.
constexpr bool isBeyondLimits(std::optional<Shape> shape) {
    return shape == Shape::AboveLimit || shape == Shape::BelowLimit || shape == Shape::NoLabel;
}

Shape shapeOf(State state);
std::optional<Shape> shapeOf(Quality quality);  // none: good has no mark
Shape shapeOf(Severity severity);

// Fills the square `box`, 12 px or more.
void paint(QPainter& painter, const QRectF& box, Shape shape, const Tokens& colours);

// The colour in which the word beside a shape is written.
QColor textColour(Shape shape, const Tokens& colours);

}  // namespace cortex::gui
