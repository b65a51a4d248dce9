// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QColor>
#include <QString>
#include <array>
#include <optional>
#include <span>

// The colours of the program, by what they mean. Every colour on the screen is one of these.
namespace cortex::gui {

enum class Theme { Light, Dark, HighContrast };

inline constexpr std::array allThemes{Theme::Light, Theme::Dark, Theme::HighContrast};

QString themeName(Theme theme);  // "light", "dark", "high-contrast"
std::optional<Theme> themeNamed(const QString& name);

// A token `x` with `onX`: the text that lies on it. `…Text` and `…Bg` are the same meaning as text
// and as background.
struct Tokens {
    QColor window, surface, raised, canvas;  // backgrounds, from the frame to what is edited
    QColor hover, select;                    // rows under the pointer, and chosen
    QColor line, grid, band, border;         // separators, tracks of bars, edges of controls
    QColor ink, ink2;                        // text, and what is less important
    QColor accent, onAccent;                 // links, focus, what the operator holds
    QColor stop, onStop;                     // the Stop button alone
    QColor fault, onFault, faultText, faultBg;
    QColor warnEdge, warnText, warnBg;  // outside of a limit
    QColor data, dataText, dataBg;      // stale, bad, lost
    QColor target, targetText;          // demands
    QColor arm, armEdge;                // the current pose
    std::array<QColor, 8> series;       // lines of plots, in this order
};

const Tokens& tokens(Theme theme);

// What must be told apart as text or as a shape: checked for every theme by the tests.
struct ContrastRule {
    QColor Tokens::* fore;
    std::span<QColor Tokens::* const> backs;
    double least;  // contrast as WCAG 2.1 defines it
};
std::span<const ContrastRule> contrastRules();

// The relative luminance and the contrast of WCAG 2.1, 1 to 21.
double luminance(const QColor& colour);
double contrast(const QColor& one, const QColor& other);

}  // namespace cortex::gui
