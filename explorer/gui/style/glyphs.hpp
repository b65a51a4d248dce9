// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QColor>
#include <QIcon>
#include <QPainter>
#include <QRectF>
#include <array>

// The pictures on buttons: drawn by code, so that they take the colours of the theme.
namespace cortex::gui {

enum class Glyph {
    Menu,
    Find,
    Filter,
    Close,
    Plus,
    Minus,
    Left,
    Right,
    Up,
    Down,
    Hold,
    Follow,
    Cursor,
    Ruler,
    Export,
    Copy,
    LinkIn,
    LinkOut,
    Split,
    Window,
    Pin,
    Lock,
    Unlock,
    Help,
};

inline constexpr int glyphCount = static_cast<int>(Glyph::Help) + 1;

void paint(QPainter& painter, const QRectF& box, Glyph glyph, const QColor& colour);
QIcon icon(Glyph glyph, const QColor& colour, int pixels);

}  // namespace cortex::gui
