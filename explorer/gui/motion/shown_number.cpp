// SPDX-License-Identifier: Apache-2.0
#include "motion/shown_number.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::explorer {

namespace {

constexpr double told = 1e-3;  // of the unit of the model
const QString minus{QChar{0x2212}};

}  // namespace

ShownNumber shownNumber(const ShownUnit& unit) {
    const double step = told * unit.factor;
    const int decimals = step > 0 ? static_cast<int>(std::ceil(-std::log10(step) - 1e-9)) : 3;
    return {unit, std::clamp(decimals, 1, 6)};
}

QString ShownNumber::text(double number) const {
    if (!std::isfinite(number))
        return std::isnan(number) ? QStringLiteral("—") : QStringLiteral("∞");
    QString text = QString::number(of(number), 'f', decimals);
    if (!text.startsWith('-')) return text;
    const bool zero = std::ranges::none_of(text, [](QChar c) { return c >= '1' && c <= '9'; });
    return zero ? text.mid(1) : minus + text.mid(1);
}

QString ShownNumber::text(std::optional<double> number) const {
    return number ? text(*number) : QStringLiteral("—");
}

QString ShownNumber::brief(double number) const {
    return QString::number(of(number), 'g', 4).replace('-', minus);
}

QString ShownNumber::withUnit(double number) const {
    const bool apart = unit.text != QStringLiteral("°");
    return (text(number) + (apart ? QStringLiteral(" ") : QString{}) + unit.text).trimmed();
}

QString ShownNumber::withSign(double number) const {
    return (number > 0 ? QStringLiteral("+") : QString{}) + withUnit(number);
}

std::optional<double> ShownNumber::entered(const QString& text) const {
    QString plain = text.trimmed();
    plain.replace(',', '.').replace(minus, QStringLiteral("-"));
    bool good = false;
    const double number = plain.toDouble(&good);
    if (!good || !std::isfinite(number)) return std::nullopt;
    return number / unit.factor;
}

}  // namespace cortex::explorer
