// SPDX-License-Identifier: Apache-2.0
#include "style/explorer_style.hpp"

#include "style/look.hpp"

#include <QLabel>
#include <QPainter>
#include <QStyleOption>
#include <QWidget>
#include <algorithm>
#include <map>

namespace cortex::gui {

namespace {

bool is(const QWidget* widget, const char* kind) {
    return widget != nullptr && widget->property(buttonKind).toString() == QLatin1String{kind};
}

// A box with an edge that lies whole on pixels.
void box(QPainter& painter, const QRect& rect, const QColor& fill, const QColor& edge,
         Qt::PenStyle style = Qt::SolidLine) {
    const int width = Look::lineWidth();
    QPen pen{edge, static_cast<double>(width), style};
    if (style == Qt::DashLine) pen.setDashPattern({3, 3});
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(edge.isValid() ? pen : QPen{Qt::NoPen});
    painter.setBrush(fill.isValid() ? QBrush{fill} : QBrush{Qt::NoBrush});
    const double half = width / 2.0;
    painter.drawRoundedRect(QRectF{rect}.adjusted(half, half, -half, -half), Look::units(1),
                            Look::units(1));
    painter.restore();
}

void drawFocus(QPainter& painter, const QRect& rect, const QColor& colour) {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen{colour, 2});
    painter.drawRoundedRect(QRectF{rect}.adjusted(1, 1, -1, -1), Look::units(1), Look::units(1));
    painter.restore();
}

void drawButton(QPainter& painter, const QStyleOption& option, const QWidget* widget) {
    const Tokens& c = Look::colours();
    const bool enabled = option.state.testFlag(QStyle::State_Enabled);
    const bool pressed =
        option.state.testFlag(QStyle::State_Sunken) || option.state.testFlag(QStyle::State_On);
    const bool hovered = option.state.testFlag(QStyle::State_MouseOver);
    if (is(widget, stopKind)) {
        box(painter, option.rect, c.stop, pressed ? c.accent : c.stop);
    } else if (!enabled) {
        box(painter, option.rect, {}, c.border, Qt::DashLine);
    } else if (pressed) {
        box(painter, option.rect, c.accent, c.accent);
    } else if (is(widget, plainKind)) {
        box(painter, option.rect, hovered ? c.hover : QColor{}, {});
    } else {
        box(painter, option.rect, hovered ? c.hover : c.raised, c.border);
    }
    if (!option.state.testFlag(QStyle::State_HasFocus)) return;
    drawFocus(painter, option.rect, pressed ? c.onAccent : c.accent);
}

// A track that is filled up to the handle.
void drawSlider(QPainter& painter, const QStyleOptionSlider& slider, const QStyle& style,
                const QWidget* widget) {
    const Tokens& c = Look::colours();
    const bool enabled = slider.state.testFlag(QStyle::State_Enabled);
    const QRect handle =
        style.subControlRect(QStyle::CC_Slider, &slider, QStyle::SC_SliderHandle, widget);
    QRect track = slider.rect, filled = slider.rect;
    const int half = Look::units(0.75);
    if (slider.orientation == Qt::Horizontal) {
        track = filled = {slider.rect.left(), handle.center().y() - half, slider.rect.width(),
                          2 * half};
        filled.setRight(handle.center().x());
    } else {
        track = filled = {handle.center().x() - half, slider.rect.top(), 2 * half,
                          slider.rect.height()};
        filled.setTop(handle.center().y());
    }
    box(painter, track, c.band, c.border);
    box(painter, filled, enabled ? c.accent : c.border, c.border);
    const bool held = slider.activeSubControls.testFlag(QStyle::SC_SliderHandle);
    box(painter, handle, held ? c.hover : c.raised, enabled ? c.ink : c.border);
    if (slider.state.testFlag(QStyle::State_HasFocus)) drawFocus(painter, handle, c.accent);
}

void drawTab(QPainter& painter, const QStyleOptionTab& tab) {
    const Tokens& c = Look::colours();
    const bool selected = tab.state.testFlag(QStyle::State_Selected);
    if (selected)
        painter.fillRect(tab.rect, c.surface);
    else if (tab.state.testFlag(QStyle::State_MouseOver))
        painter.fillRect(tab.rect, c.hover);
    if (!selected) return;
    QRect bar = tab.rect;
    bar.setHeight(3);
    painter.fillRect(bar, c.accent);
}

void drawHeader(QPainter& painter, const QStyleOption& option) {
    const Tokens& c = Look::colours();
    painter.fillRect(option.rect, c.surface);
    painter.fillRect(QRect{option.rect.left(), option.rect.bottom(), option.rect.width(), 1},
                     c.line);
}

// Only where a row can be opened: a triangle to the right, or down when it is open.
void drawBranch(QPainter& painter, const QStyleOption& option) {
    if (!option.state.testFlag(QStyle::State_Children)) return;
    const QPointF m = QRectF{option.rect}.center();
    const double s = Look::units(1);
    const bool open = option.state.testFlag(QStyle::State_Open);
    const QPolygonF shape = open ? QPolygonF{{{m.x() - s, m.y() - s / 2},
                                              {m.x() + s, m.y() - s / 2},
                                              {m.x(), m.y() + s * 0.7}}}
                                 : QPolygonF{{{m.x() - s / 2, m.y() - s},
                                              {m.x() - s / 2, m.y() + s},
                                              {m.x() + s * 0.7, m.y()}}};
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(Look::colours().ink);
    painter.drawPolygon(shape);
    painter.restore();
}

// In units.
const std::map<QStyle::PixelMetric, double>& metrics() {
    static const std::map<QStyle::PixelMetric, double> all{{QStyle::PM_ScrollBarExtent, 3.5},
                                                           {QStyle::PM_ScrollBarSliderMin, 8},
                                                           {QStyle::PM_DefaultFrameWidth, 0},
                                                           {QStyle::PM_TreeViewIndentation, 4},
                                                           {QStyle::PM_ButtonMargin, 4},
                                                           {QStyle::PM_TabBarTabHSpace, 8},
                                                           {QStyle::PM_TabBarTabVSpace, 3},
                                                           {QStyle::PM_TabBarBaseHeight, 0},
                                                           {QStyle::PM_HeaderMargin, 2},
                                                           {QStyle::PM_FocusFrameVMargin, 0.5},
                                                           {QStyle::PM_SmallIconSize, 4},
                                                           {QStyle::PM_ButtonIconSize, 4},
                                                           {QStyle::PM_TabCloseIndicatorWidth, 4},
                                                           {QStyle::PM_TabCloseIndicatorHeight, 4},
                                                           {QStyle::PM_LayoutLeftMargin, 4},
                                                           {QStyle::PM_LayoutRightMargin, 4},
                                                           {QStyle::PM_LayoutTopMargin, 4},
                                                           {QStyle::PM_LayoutBottomMargin, 4},
                                                           {QStyle::PM_LayoutHorizontalSpacing, 2},
                                                           {QStyle::PM_LayoutVerticalSpacing, 2}};
    return all;
}

// Nothing slides or fades, and no text is etched.
const std::map<QStyle::StyleHint, int>& hints() {
    static const std::map<QStyle::StyleHint, int> all{
        {QStyle::SH_UnderlineShortcut, 0},
        {QStyle::SH_ScrollBar_LeftClickAbsolutePosition, 1},
        {QStyle::SH_Widget_Animate, 0},
        {QStyle::SH_Widget_Animation_Duration, 0},
        {QStyle::SH_EtchDisabledText, 0},
        {QStyle::SH_DitherDisabledText, 0},
        {QStyle::SH_TabBar_Alignment, Qt::AlignLeft},
        {QStyle::SH_TabBar_ElideMode, Qt::ElideMiddle}};
    return all;
}

// In units.
const std::map<QStyle::ContentsType, double>& leastHeights() {
    static const std::map<QStyle::ContentsType, double> all{
        {QStyle::CT_PushButton, 7},    {QStyle::CT_LineEdit, 7},    {QStyle::CT_ComboBox, 7},
        {QStyle::CT_SpinBox, 7},       {QStyle::CT_ToolButton, 7},  {QStyle::CT_TabBarTab, 8},
        {QStyle::CT_HeaderSection, 7}, {QStyle::CT_ItemViewItem, 6}};
    return all;
}

}  // namespace

ExplorerStyle::ExplorerStyle() : QProxyStyle{QStringLiteral("Fusion")} {}

void ExplorerStyle::polish(QWidget* widget) {
    QProxyStyle::polish(widget);
    auto* label = qobject_cast<QLabel*>(widget);
    if (label != nullptr && label->textFormat() == Qt::AutoText) {
        label->setTextFormat(Qt::PlainText);
    }
}

void ExplorerStyle::drawPrimitive(PrimitiveElement element, const QStyleOption* option,
                                  QPainter* painter, const QWidget* widget) const {
    const Tokens& c = Look::colours();
    switch (element) {
        case PE_PanelButtonCommand:
        case PE_PanelButtonTool:
            drawButton(*painter, *option, widget);
            return;
        case PE_FrameFocusRect:
            drawFocus(*painter, option->rect, c.accent);
            return;
        case PE_IndicatorBranch:
            drawBranch(*painter, *option);
            return;
        case PE_PanelLineEdit:
        case PE_FrameLineEdit: {
            const bool focus = option->state.testFlag(State_HasFocus);
            const bool wrong = widget != nullptr && widget->property(wrongInput).toBool();
            box(*painter, option->rect, element == PE_PanelLineEdit ? c.raised : QColor{},
                wrong   ? c.warnEdge
                : focus ? c.accent
                        : c.border);
            return;
        }
        case PE_PanelTipLabel:
        case PE_PanelMenu:
            box(*painter, option->rect, c.raised, c.border);
            return;
        case PE_PanelItemViewRow:  // tables paint their rows
        case PE_Frame:             // panes meet at a line; they have no frames
        case PE_FrameTabBarBase:
            return;
        default:
            QProxyStyle::drawPrimitive(element, option, painter, widget);
    }
}

void ExplorerStyle::drawControl(ControlElement element, const QStyleOption* option,
                                QPainter* painter, const QWidget* widget) const {
    const Tokens& c = Look::colours();
    switch (element) {
        case CE_PushButtonLabel: {
            QStyleOptionButton label{*qstyleoption_cast<const QStyleOptionButton*>(option)};
            const bool pressed =
                label.state.testFlag(State_Sunken) || label.state.testFlag(State_On);
            const QColor ink = is(widget, stopKind)                   ? c.onStop
                               : !label.state.testFlag(State_Enabled) ? c.ink2
                               : pressed                              ? c.onAccent
                                                                      : c.ink;
            for (const auto role : {QPalette::ButtonText, QPalette::WindowText}) {
                label.palette.setColor(QPalette::All, role, ink);
            }
            QProxyStyle::drawControl(element, &label, painter, widget);
            return;
        }
        case CE_TabBarTabShape:
            drawTab(*painter, *qstyleoption_cast<const QStyleOptionTab*>(option));
            return;
        case CE_HeaderSection:
        case CE_HeaderEmptyArea:
            drawHeader(*painter, *option);
            return;
        case CE_Splitter:
            painter->fillRect(option->rect, c.line);
            return;
        case CE_ProgressBarGroove:
            box(*painter, option->rect, c.band, {});
            return;
        case CE_ProgressBarContents: {
            const auto& bar = *qstyleoption_cast<const QStyleOptionProgressBar*>(option);
            QRect filled = bar.rect;
            const int range = std::max(bar.maximum - bar.minimum, 1);
            filled.setWidth(filled.width() * (bar.progress - bar.minimum) / range);
            box(*painter, filled, c.accent, {});
            return;
        }
        default:
            QProxyStyle::drawControl(element, option, painter, widget);
    }
}

void ExplorerStyle::drawComplexControl(ComplexControl control, const QStyleOptionComplex* option,
                                       QPainter* painter, const QWidget* widget) const {
    if (control == CC_Slider) {
        drawSlider(*painter, *qstyleoption_cast<const QStyleOptionSlider*>(option), *this, widget);
        return;
    }
    if (control != CC_ScrollBar) {
        QProxyStyle::drawComplexControl(control, option, painter, widget);
        return;
    }
    const Tokens& c = Look::colours();
    painter->fillRect(option->rect, c.surface);
    const auto& bar = *qstyleoption_cast<const QStyleOptionSlider*>(option);
    if (bar.minimum == bar.maximum) return;  // there is nothing to scroll to
    const int gap = Look::units(0.75);
    const QRect slider = subControlRect(control, option, SC_ScrollBarSlider, widget);
    const bool held = option->activeSubControls.testFlag(SC_ScrollBarSlider);
    box(*painter, slider.adjusted(gap, gap, -gap, -gap), held ? c.ink2 : c.border, {});
}

int ExplorerStyle::pixelMetric(PixelMetric metric, const QStyleOption* option,
                               const QWidget* widget) const {
    if (metric == PM_SplitterWidth) return Look::lineWidth();
    // Before the text of a cell: two units, as in headers, less the pixel that Qt adds.
    if (metric == PM_FocusFrameHMargin) return Look::units(2) - 1;
    const auto found = metrics().find(metric);
    return found != metrics().end() ? Look::units(found->second)
                                    : QProxyStyle::pixelMetric(metric, option, widget);
}

int ExplorerStyle::styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                             QStyleHintReturn* data) const {
    const auto found = hints().find(hint);
    return found != hints().end() ? found->second
                                  : QProxyStyle::styleHint(hint, option, widget, data);
}

QSize ExplorerStyle::sizeFromContents(ContentsType type, const QStyleOption* option,
                                      const QSize& size, const QWidget* widget) const {
    QSize result = QProxyStyle::sizeFromContents(type, option, size, widget);
    const auto least = leastHeights().find(type);
    if (least != leastHeights().end()) {
        result.setHeight(std::max(result.height(), Look::units(least->second)));
    }
    return result;
}

QRect ExplorerStyle::subControlRect(ComplexControl control, const QStyleOptionComplex* option,
                                    SubControl part, const QWidget* widget) const {
    if (control != CC_ScrollBar) {
        return QProxyStyle::subControlRect(control, option, part, widget);
    }
    // No arrows: the groove takes the whole length.
    const auto& bar = *qstyleoption_cast<const QStyleOptionSlider*>(option);
    const bool upright = bar.orientation == Qt::Vertical;
    const int length = upright ? bar.rect.height() : bar.rect.width();
    const int steps = bar.maximum - bar.minimum;
    const int least = std::min(pixelMetric(PM_ScrollBarSliderMin, option, widget), length);
    const int size = steps == 0
                         ? length
                         : std::max(least, static_cast<int>(static_cast<qint64>(length) *
                                                            bar.pageStep / (steps + bar.pageStep)));
    const int begin = sliderPositionFromValue(bar.minimum, bar.maximum, bar.sliderPosition,
                                              length - size, bar.upsideDown);
    const auto along = [&](int from, int extent) {
        return upright ? QRect{bar.rect.left(), bar.rect.top() + from, bar.rect.width(), extent}
                       : QRect{bar.rect.left() + from, bar.rect.top(), extent, bar.rect.height()};
    };
    switch (part) {
        case SC_ScrollBarGroove:
            return bar.rect;
        case SC_ScrollBarSlider:
            return along(begin, size);
        case SC_ScrollBarSubPage:
            return along(0, begin);
        case SC_ScrollBarAddPage:
            return along(begin + size, length - begin - size);
        default:
            return {};
    }
}

}  // namespace cortex::gui
