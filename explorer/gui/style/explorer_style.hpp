// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QProxyStyle>

namespace cortex::gui {

// Fusion with the edges, sizes and colours of the tokens: flat, one radius, a focus ring that can
// be seen, and a dashed edge around what cannot be pressed now.
class ExplorerStyle : public QProxyStyle {
public:
    ExplorerStyle();
    using QProxyStyle::polish;

    // Labels show texts as they are: no markup that an agent sends is rendered, tool tips and
    // questions too.
    void polish(QWidget* widget) override;
    void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                       const QWidget* widget) const override;
    void drawControl(ControlElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget) const override;
    void drawComplexControl(ComplexControl control, const QStyleOptionComplex* option,
                            QPainter* painter, const QWidget* widget) const override;
    int pixelMetric(PixelMetric metric, const QStyleOption* option,
                    const QWidget* widget) const override;
    int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                  QStyleHintReturn* data) const override;
    QSize sizeFromContents(ContentsType type, const QStyleOption* option, const QSize& size,
                           const QWidget* widget) const override;
    QRect subControlRect(ComplexControl control, const QStyleOptionComplex* option, SubControl part,
                         const QWidget* widget) const override;
};

// The kinds of buttons that differ from others; a property of the button, "kind".
inline constexpr const char* buttonKind = "kind";
inline constexpr const char* stopKind = "stop";          // filled: the Stop button alone
inline constexpr const char* wrongInput = "wrongInput";  // of a field: true makes its edge amber
inline constexpr const char* plainKind = "plain";        // no edge before the pointer is on it

}  // namespace cortex::gui
