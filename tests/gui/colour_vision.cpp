// SPDX-License-Identifier: Apache-2.0
#include "gui/colour_vision.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cortex::test {

namespace {

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;

// Table 1 of Machado, Oliveira and Fernandes (2009), severity 1.
constexpr std::array<Matrix, 4> simulations{{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                             {{{0.152286, 1.052583, -0.204868},
                                               {0.114503, 0.786281, 0.099216},
                                               {-0.003882, -0.048116, 1.051998}}},
                                             {{{0.367322, 0.860646, -0.227968},
                                               {0.280085, 0.672501, 0.047413},
                                               {-0.011820, 0.042940, 0.968881}}},
                                             {{{1.255528, -0.076749, -0.178779},
                                               {-0.078411, 0.930809, 0.147602},
                                               {0.004733, 0.691367, 0.303900}}}}};

// Linear sRGB to XYZ by IEC 61966-2-1, over the white of D65.
constexpr Matrix toXyz{{{0.4124564, 0.3575761, 0.1804375},
                        {0.2126729, 0.7151522, 0.0721750},
                        {0.0193339, 0.1191920, 0.9503041}}};
constexpr Triple white{0.95047, 1, 1.08883};

Triple times(const Matrix& m, const Triple& v) {
    Triple result{};
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return result;
}

double linear(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }

struct Lab {
    double l, a, b;
};

Lab labOf(const QColor& colour, Vision vision) {
    Triple seen = times(simulations[static_cast<std::size_t>(vision)],
                        {linear(colour.redF()), linear(colour.greenF()), linear(colour.blueF())});
    for (double& each : seen) each = std::clamp(each, 0.0, 1.0);
    Triple xyz = times(toXyz, seen);
    for (std::size_t i = 0; i < 3; ++i) {
        const double t = xyz[i] / white[i];
        xyz[i] = t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
    }
    return {116 * xyz[1] - 16, 500 * (xyz[0] - xyz[1]), 200 * (xyz[1] - xyz[2])};
}

double degrees(double y, double x) {
    const double angle = std::atan2(y, x) * 180 / std::numbers::pi;
    return x == 0 && y == 0 ? 0 : angle < 0 ? angle + 360 : angle;
}

double cosine(double angle) { return std::cos(angle * std::numbers::pi / 180); }
double sine(double angle) { return std::sin(angle * std::numbers::pi / 180); }
double seventh(double c) { return std::sqrt(std::pow(c, 7) / (std::pow(c, 7) + std::pow(25, 7))); }

// The formula of CIE 142 as Sharma, Wu and Dalal (2005) write it; all weights are 1.
double ciede2000(Lab p, Lab q) {
    const double mean = (std::hypot(p.a, p.b) + std::hypot(q.a, q.b)) / 2;
    const double stretch = 1 + 0.5 * (1 - seventh(mean));
    const double c1 = std::hypot(p.a * stretch, p.b), c2 = std::hypot(q.a * stretch, q.b);
    const double h1 = degrees(p.b, p.a * stretch), h2 = degrees(q.b, q.a * stretch);
    const bool grey = c1 * c2 == 0;
    double turn = grey ? 0 : h2 - h1;
    if (turn > 180) turn -= 360;
    if (turn < -180) turn += 360;
    const double dl = q.l - p.l, dc = c2 - c1, dh = 2 * std::sqrt(c1 * c2) * sine(turn / 2);
    const double l = (p.l + q.l) / 2, c = (c1 + c2) / 2;
    double h = h1 + h2;
    if (!grey) h = std::abs(h1 - h2) <= 180 ? h / 2 : (h < 360 ? h + 360 : h - 360) / 2;
    const double t = 1 - 0.17 * cosine(h - 30) + 0.24 * cosine(2 * h) + 0.32 * cosine(3 * h + 6) -
                     0.20 * cosine(4 * h - 63);
    const double middle = (l - 50) * (l - 50);
    const double sl = 1 + 0.015 * middle / std::sqrt(20 + middle);
    const double sc = 1 + 0.045 * c, sh = 1 + 0.015 * c * t;
    const double rotation = -2 * seventh(c) * sine(60 * std::exp(-std::pow((h - 275) / 25, 2)));
    return std::sqrt(std::pow(dl / sl, 2) + std::pow(dc / sc, 2) + std::pow(dh / sh, 2) +
                     rotation * dc / sc * dh / sh);
}

}  // namespace

double distance(const QColor& one, const QColor& other, Vision vision) {
    return ciede2000(labOf(one, vision), labOf(other, vision));
}

}  // namespace cortex::test
