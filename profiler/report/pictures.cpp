// SPDX-License-Identifier: Apache-2.0
#include "report/pictures.hpp"

#include "report/number_text.hpp"
#include "text/plain_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace cortex::profiler {
namespace {

constexpr std::size_t fewPoints = 60;  // a marker for each
constexpr double wantedTicks = 6;

// What belongs together has one hue in several shades; told apart by the colour-blind.
using Colour = std::array<int, 3>;
constexpr std::array hues{Colour{0, 114, 178},  Colour{213, 94, 0},  Colour{0, 158, 115},
                          Colour{168, 85, 154}, Colour{201, 138, 0}, Colour{86, 180, 233},
                          Colour{120, 72, 30},  Colour{40, 40, 40},  Colour{150, 150, 20},
                          Colour{230, 110, 140}};
constexpr std::array paleness{0.0, 0.4, 0.65, 0.8};  // of shades

std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : printable(text)) result += c == '\'' ? "''" : std::string{c};
    return result + "'";
}

bool drawable(double value, bool logarithmic) {
    return std::isfinite(value) && (!logarithmic || value > 0);
}

std::vector<double> valuesOf(const Figure& figure, bool x) {
    const Axis& axis = x ? figure.x : figure.y;
    std::vector<double> values;
    for (const Series& series : figure.series) {
        for (const Point& point : series.points) {
            const bool shown =
                drawable(point.x, figure.x.logarithmic) && drawable(point.y, figure.y.logarithmic);
            if (shown) values.push_back(x ? point.x : point.y);
        }
    }
    if (values.empty()) return values;
    for (const Mark& mark : figure.marks) {
        const bool here = (mark.along == Mark::Along::X) == x;
        if (here && drawable(mark.at, axis.logarithmic)) values.push_back(mark.at);
    }
    return values;
}

double niceStep(double span) {
    const double rough = span / wantedTicks;
    const double power = std::pow(10, std::floor(std::log10(rough)));
    for (const double each : {1.0, 2.0, 5.0}) {
        if (each * power >= rough) return each * power;
    }
    return 10 * power;
}

void addLinear(Ticks& ticks, bool whole) {
    double step = niceStep(ticks.high - ticks.low);
    if (whole) step = std::max(step, 1.0);
    for (double n = std::ceil(ticks.low / step); n * step <= ticks.high; ++n) {
        ticks.at.push_back(n * step);
    }
}

void addLogarithmic(Ticks& ticks, bool whole) {
    const double decades = std::log10(ticks.high / ticks.low);
    const double every = std::ceil(decades / 8);
    for (double n = std::floor(std::log10(ticks.low)); std::pow(10, n) <= ticks.high; ++n) {
        for (int part = 1; part < 10; ++part) {
            const double at = part * std::pow(10, n);
            if (at < ticks.low || at > ticks.high || (whole && at < 1)) continue;
            const bool number =
                part == 1 ? std::fmod(n, every) == 0 : decades < 2.5 && (part == 2 || part == 5);
            (number ? ticks.at : ticks.between).push_back(at);
        }
    }
    if (ticks.at.size() > 1) return;
    ticks.at.clear();
    ticks.between.clear();
    addLinear(ticks, whole);
}

std::string axisCommands(const char* name, const Axis& axis, const Ticks& ticks) {
    const std::string letter = name;
    std::string text;
    if (axis.logarithmic) text += "set logscale " + letter + "\n";
    text += "set " + letter + "range [" + exact(ticks.low) + ":" + exact(ticks.high) + "]\n";
    std::string list;
    for (const double at : ticks.at) list += ", " + quoted(readable(at)) + " " + exact(at);
    for (const double at : ticks.between) list += ", '' " + exact(at) + " 1";
    const std::string unit = axis.unit.empty() ? "" : " (" + axis.unit + ")";
    return text + "set " + letter + "tics nomirror (" + list.substr(2) + ")\nset " + letter +
           "label " + quoted(axis.label + unit) + "\n";
}

std::string markCommands(const Figure& figure, const Ticks& x, const Ticks& y) {
    std::string text;
    for (const Mark& mark : figure.marks) {
        const bool upright = mark.along == Mark::Along::X;
        const Ticks& ticks = upright ? x : y;
        if (!(mark.at >= ticks.low && mark.at <= ticks.high)) continue;
        const std::string at = exact(mark.at);
        const std::string from = upright ? at + ", graph 0" : "graph 0, first " + at;
        const std::string to = upright ? at + ", graph 1" : "graph 1, first " + at;
        text += "set arrow from " + from + " to " + to + " nohead dt (4,4) lc rgb '#707070'\n";
        text += "set label " + quoted(mark.text) + " at " +
                (upright ? at + ", graph 0.03 rotate by 90 left offset -0.7,0"
                         : "graph 0.01, first " + at + " left offset 0,0.5") +
                " boxed font ',11' textcolor rgb '#505050' front\n";
    }
    return text;
}

// The number of the hue of each series, and of its shade.
std::vector<std::pair<std::size_t, std::size_t>> shadesOf(const Figure& figure) {
    std::vector<std::string> families;
    std::vector<std::size_t> members;
    std::vector<std::pair<std::size_t, std::size_t>> shades;
    for (const Series& series : figure.series) {
        const std::string family = series.name.substr(0, series.name.find(", "));
        const auto found = std::ranges::find(families, family);
        const auto number = static_cast<std::size_t>(found - families.begin());
        if (found == families.end()) {
            families.push_back(family);
            members.push_back(0);
        }
        shades.emplace_back(number, members[number]++);
    }
    return shades;
}

std::string styleOf(const Series& series, std::size_t hue, std::size_t shade) {
    Colour colour = series.baseline ? Colour{90, 90, 90} : hues[hue % hues.size()];
    for (int& part : colour) {
        part += static_cast<int>((255 - part) * paleness[shade % paleness.size()]);
    }
    std::array<char, 8> hex{};
    std::snprintf(hex.data(), hex.size(), "#%02x%02x%02x", colour[0], colour[1], colour[2]);
    constexpr std::array signs{7, 5, 9, 13, 11};  // filled
    const bool marked = series.points.size() <= fewPoints;
    return std::string{marked ? "with linespoints" : "with lines"} + " lw 2 lc rgb '" + hex.data() +
           "'" + (series.baseline ? " dt " + std::to_string(2 + hue % 4) : "") +
           (marked ? " ps 0.5 pt " + std::to_string(signs[(hue + shade) % signs.size()]) : "");
}

std::string plotCommand(const Figure& figure, const std::string& name) {
    const auto shades = shadesOf(figure);
    std::string text = "plot ";
    std::size_t row = 0, index = 0;
    for (const Series& series : figure.series) {
        const std::size_t begin = row;
        const auto [hue, shade] = shades[index++];
        row += series.points.size();
        if (row == begin) continue;
        text += (begin == 0 ? "" : ", \\\n  ") + quoted(name + ".csv") +
                " skip 1 every ::" + std::to_string(begin) + "::" + std::to_string(row - 1) +
                " using 2:3 " + styleOf(series, hue, shade) + " title " + quoted(series.name);
    }
    return text + "\n";
}

}  // namespace

Ticks ticksOf(const std::vector<double>& values, bool logarithmic) {
    const auto [least, greatest] = std::ranges::minmax(values);
    const bool whole =
        std::ranges::all_of(values, [](double each) { return each == std::round(each); });
    Ticks ticks{least, greatest, {}};
    if (logarithmic) {
        const double room = std::max(1.15, std::pow(greatest / least, 0.03));
        ticks.low /= room;
        ticks.high *= room;
        if (whole && std::floor(ticks.high) <= std::ceil(ticks.low)) {
            ticks.low = std::max(0.5, least - 1);
            ticks.high = greatest + 1;
        }
        addLogarithmic(ticks, whole);
        return ticks;
    }
    if (least >= 0 && least < greatest / 2) ticks.low = 0;
    const double span = ticks.high - ticks.low;
    const double room = span > 0 ? span / 20 : std::max(1.0, std::abs(greatest) / 20);
    ticks.high += room;
    if (ticks.low != 0) ticks.low -= room;
    addLinear(ticks, whole);
    return ticks;
}

std::string gnuplotScript(const Figure& figure, const std::string& name) {
    const std::vector<double> x = valuesOf(figure, true), y = valuesOf(figure, false);
    if (x.empty()) return {};
    const Ticks xTicks = ticksOf(x, figure.x.logarithmic);
    const Ticks yTicks = ticksOf(y, figure.y.logarithmic);
    const std::size_t keyRows = (figure.series.size() + 2) / 3;
    return "reset\nset encoding utf8\nset datafile separator comma\n"
           "set terminal svg dynamic noenhanced background rgb 'white' font 'sans-serif,13' "
           "size 900," +
           std::to_string(400 + 20 * keyRows) + "\nset output " + quoted(name + ".svg") +
           "\nset border 3 lc rgb '#606060'\nset grid lc rgb '#e4e4e4' lt 1\n"
           "set style textbox opaque noborder fillcolor rgb 'white' margins 0.3,0.3\nset key "
           "outside bottom center horizontal Left reverse samplen 3 maxcols 3\n" +
           axisCommands("x", figure.x, xTicks) + axisCommands("y", figure.y, yTicks) +
           markCommands(figure, xTicks, yTicks) + plotCommand(figure, name) + "unset output\n";
}

std::string drawPictures(const std::vector<Figure>& figures, const std::vector<std::string>& names,
                         const std::filesystem::path& folder) {
    std::string script = "cd " + quoted(folder.string()) + "\n";
    for (std::size_t i = 0; i < figures.size(); ++i) {
        std::error_code ignored;
        std::filesystem::remove(folder / (names[i] + ".svg"), ignored);
        script += gnuplotScript(figures[i], names[i]);
    }
    if (figures.empty()) return {};
    if (std::system("command -v gnuplot >/dev/null") != 0) {
        return "There are no pictures, as gnuplot is not installed: install it (apt-get install "
               "gnuplot-nox), then `cortex-profiler report` draws them from what was measured.";
    }
    std::FILE* gnuplot = popen("gnuplot -d - 2>/dev/null", "w");
    if (gnuplot == nullptr) return "There are no pictures: gnuplot could not be started.";
    std::fwrite(script.data(), 1, script.size(), gnuplot);
    const int status = pclose(gnuplot);
    return status == 0 ? "" : "Some pictures are missing, as gnuplot failed: is it 5.4 or newer?";
}

}  // namespace cortex::profiler
