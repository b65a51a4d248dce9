// SPDX-License-Identifier: Apache-2.0
#include "style/tokens.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::gui {

namespace {

constexpr std::array themeNames{"light", "dark", "high-contrast"};

QColor hex(const char* text) { return QColor{QLatin1String{text}}; }

template <class... Texts>
std::array<QColor, sizeof...(Texts)> series(Texts... texts) {
    return {hex(texts)...};
}

Tokens light() {
    return {.window = hex("#DFE2E5"),
            .surface = hex("#EEF0F2"),
            .raised = hex("#FAFBFB"),
            .canvas = hex("#FAFBFB"),
            .hover = hex("#E2E7EB"),
            .select = hex("#C3D8E8"),
            .line = hex("#C3C8CD"),
            .grid = hex("#DADEE2"),
            .band = hex("#CDD5DC"),
            .border = hex("#6F7780"),
            .ink = hex("#1B1F23"),
            .ink2 = hex("#474E55"),
            .accent = hex("#12507E"),
            .onAccent = hex("#FFFFFF"),
            .stop = hex("#1B1F23"),
            .onStop = hex("#FFFFFF"),
            .fault = hex("#B3202C"),
            .onFault = hex("#FFFFFF"),
            .faultText = hex("#9C1A25"),
            .faultBg = hex("#F4DADB"),
            .warnEdge = hex("#C26A00"),
            .warnText = hex("#7D4700"),
            .warnBg = hex("#F6E6C8"),
            .data = hex("#A06CC4"),
            .dataText = hex("#5F3590"),
            .dataBg = hex("#E6DDF0"),
            .target = hex("#3B8F78"),
            .targetText = hex("#17654F"),
            .arm = hex("#F4F5F6"),
            .armEdge = hex("#59616A"),
            .series = series("#4691CA", "#18755A", "#914285", "#514E00", "#5A3E3E", "#828C70",
                             "#81757E", "#304655")};
}

Tokens dark() {
    return {.window = hex("#1B1E21"),
            .surface = hex("#24282C"),
            .raised = hex("#2E3338"),
            .canvas = hex("#1F2327"),
            .hover = hex("#2B3036"),
            .select = hex("#233B59"),
            .line = hex("#3C4248"),
            .grid = hex("#343A40"),
            .band = hex("#3A434C"),
            .border = hex("#87909A"),
            .ink = hex("#E4E7EA"),
            .ink2 = hex("#B2B9C0"),
            .accent = hex("#6DA6F1"),
            .onAccent = hex("#10151A"),
            .stop = hex("#E4E7EA"),
            .onStop = hex("#1B1E21"),
            .fault = hex("#F0525F"),
            .onFault = hex("#16090A"),
            .faultText = hex("#FF9A9A"),
            .faultBg = hex("#4A2529"),
            .warnEdge = hex("#F3C03E"),
            .warnText = hex("#F3BD5C"),
            .warnBg = hex("#433518"),
            .data = hex("#CC86B0"),
            .dataText = hex("#E3A9CB"),
            .dataBg = hex("#40303B"),
            .target = hex("#8FD3A6"),
            .targetText = hex("#9BDCB1"),
            .arm = hex("#D9DDE1"),
            .armEdge = hex("#87909A"),
            .series = series("#81CAFC", "#4A9770", "#BA71A6", "#DFE7AE", "#ACB497", "#8C9C97",
                             "#F9D8E4", "#D799C2")};
}

Tokens highContrast() {
    const QColor black = hex("#000000"), white = hex("#FFFFFF");
    return {.window = black,
            .surface = black,
            .raised = black,
            .canvas = black,
            .hover = hex("#2B2B2B"),
            .select = hex("#FFE600"),
            .line = white,
            .grid = hex("#5A5A5A"),
            .band = hex("#4A4A4A"),
            .border = white,
            .ink = white,
            .ink2 = white,
            .accent = hex("#FFE600"),
            .onAccent = black,
            .stop = white,
            .onStop = black,
            .fault = hex("#FF5A66"),
            .onFault = black,
            .faultText = hex("#FF8C94"),
            .faultBg = black,
            .warnEdge = hex("#E09A20"),
            .warnText = hex("#FFB84D"),
            .warnBg = black,
            .data = hex("#B98CFF"),
            .dataText = hex("#D3B6FF"),
            .dataBg = black,
            .target = hex("#5EE6B0"),
            .targetText = hex("#5EE6B0"),
            .arm = white,
            .armEdge = white,
            .series = series("#559BD7", "#8BFCD8", "#FBCBFE", "#B7C96F", "#8C9B96", "#D8A8BD",
                             "#E0F8A1", "#87C399")};
}

using T = Tokens;
using Backs = QColor T::* const;
constexpr Backs everywhere[] = {&T::window, &T::surface, &T::raised, &T::hover,
                                &T::canvas, &T::faultBg, &T::warnBg, &T::dataBg};
constexpr Backs plain[] = {&T::window, &T::surface, &T::raised, &T::hover, &T::canvas};
constexpr Backs frames[] = {&T::window, &T::surface, &T::raised};
constexpr Backs drawing[] = {&T::surface, &T::raised, &T::canvas};
constexpr Backs onAccent[] = {&T::accent};
constexpr Backs onStop[] = {&T::stop};
constexpr Backs onFault[] = {&T::fault};
constexpr Backs faults[] = {&T::window, &T::surface, &T::raised, &T::faultBg, &T::canvas};
constexpr Backs warnings[] = {&T::surface, &T::raised, &T::warnBg, &T::canvas};
constexpr Backs datas[] = {&T::window, &T::surface, &T::raised, &T::dataBg, &T::canvas};
constexpr Backs onBand[] = {&T::band};
constexpr Backs onCanvas[] = {&T::canvas};

constexpr double text = 4.5, graphic = 3;
constexpr ContrastRule rules[] = {
    {&T::ink, everywhere, text},   {&T::ink2, plain, text},
    {&T::accent, frames, text},    {&T::onAccent, onAccent, text},
    {&T::onStop, onStop, text},    {&T::onFault, onFault, text},
    {&T::faultText, faults, text}, {&T::warnText, warnings, text},
    {&T::dataText, datas, text},   {&T::targetText, drawing, text},
    {&T::border, frames, graphic}, {&T::accent, onCanvas, graphic},
    {&T::fault, drawing, graphic}, {&T::warnEdge, warnings, graphic},
    {&T::data, drawing, graphic},  {&T::target, drawing, graphic},
    {&T::ink, onBand, graphic},    {&T::armEdge, onCanvas, graphic},
};

double linear(double channel) {
    return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

}  // namespace

QString themeName(Theme theme) {
    return QLatin1String{themeNames[static_cast<std::size_t>(theme)]};
}

std::optional<Theme> themeNamed(const QString& name) {
    for (const Theme theme : allThemes) {
        if (themeName(theme) == name) return theme;
    }
    return std::nullopt;
}

const Tokens& tokens(Theme theme) {
    static const std::array<Tokens, 3> all{light(), dark(), highContrast()};
    return all[static_cast<std::size_t>(theme)];
}

std::span<const ContrastRule> contrastRules() { return rules; }

double luminance(const QColor& colour) {
    return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) +
           0.0722 * linear(colour.blueF());
}

double contrast(const QColor& one, const QColor& other) {
    const double a = luminance(one), b = luminance(other);
    return (std::max(a, b) + 0.05) / (std::min(a, b) + 0.05);
}

}  // namespace cortex::gui
