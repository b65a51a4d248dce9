// SPDX-License-Identifier: Apache-2.0
#include "style/look.hpp"

#include "style/explorer_style.hpp"

#include <QApplication>
#include <QFontDatabase>
#include <QFontMetricsF>
#include <QWidget>
#include <array>
#include <cmath>

namespace cortex::gui {

namespace {

struct Current {
    Theme theme = Theme::Light;
    double scale = 1;
    QString family;
};

Current& current() {
    static Current look;
    return look;
}

constexpr std::array pointSizes{9.0, 10.0, 12.0, 15.0, 20.0};

QPalette paletteOf(const Tokens& c) {
    QPalette p;
    const auto set = [&p](QPalette::ColorRole role, const QColor& colour) {
        p.setColor(QPalette::All, role, colour);
    };
    set(QPalette::Window, c.surface);
    set(QPalette::WindowText, c.ink);
    set(QPalette::Base, c.raised);
    set(QPalette::AlternateBase, c.hover);
    set(QPalette::Text, c.ink);
    set(QPalette::Button, c.raised);
    set(QPalette::ButtonText, c.ink);
    set(QPalette::BrightText, c.onFault);
    set(QPalette::Highlight, c.accent);
    set(QPalette::HighlightedText, c.onAccent);
    set(QPalette::Link, c.accent);
    set(QPalette::LinkVisited, c.accent);
    set(QPalette::ToolTipBase, c.raised);
    set(QPalette::ToolTipText, c.ink);
    set(QPalette::PlaceholderText, c.ink2);
    set(QPalette::Light, c.line);
    set(QPalette::Midlight, c.line);
    set(QPalette::Mid, c.line);
    set(QPalette::Dark, c.border);
    set(QPalette::Shadow, c.border);
    // What cannot be pressed keeps the contrast of its text; its edge is dashed instead.
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
        p.setColor(QPalette::Disabled, role, c.ink2);
    }
    return p;
}

bool hasEqualDigits(const QFontMetricsF& metrics) {
    for (int digit = 1; digit < 10; ++digit) {
        const double width = metrics.horizontalAdvance(QChar{'0' + digit});
        if (std::abs(width - metrics.horizontalAdvance(QChar{'0'})) > 0.01) return false;
    }
    return true;
}

}  // namespace

QString readableFamily(const QString& wanted) {
    const QStringList installed = QFontDatabase{}.families();
    for (const QString& family :
         {wanted, QStringLiteral("Open Sans"), QStringLiteral("DejaVu Sans")}) {
        if (!family.isEmpty() && installed.contains(family) &&
            hasEqualDigits(QFontMetricsF{QFont{family, 40}})) {
            return family;
        }
    }
    return wanted;
}

void Look::apply(Theme theme, double scale, const QString& family) {
    static const QString desktop = QApplication::font().family();
    current() = {theme, scale, readableFamily(family.isEmpty() ? desktop : family)};
    QApplication::setStyle(new ExplorerStyle);  // anew, so that every size is asked for again
    QApplication::setPalette(paletteOf(colours()));
    QApplication::setFont(font());
}

Theme Look::theme() { return current().theme; }
double Look::scale() { return current().scale; }
const Tokens& Look::colours() { return tokens(current().theme); }

QFont Look::font(TextSize size, bool strong) {
    QFont font{current().family};
    font.setPointSizeF(pointSizes[static_cast<std::size_t>(size)] * current().scale);
    font.setWeight(strong ? QFont::DemiBold : QFont::Normal);
    return font;
}

double Look::length(double units) { return 4 * units * scale(); }

int Look::units(double count) { return static_cast<int>(std::lround(length(count))); }

bool Look::isLow(const QWidget& widget) {
    const QWidget* window = widget.window();
    while (window->parentWidget() != nullptr) window = window->parentWidget()->window();
    return window->height() < units(175);
}

int Look::lineWidth() { return theme() == Theme::HighContrast ? 2 : 1; }

}  // namespace cortex::gui
