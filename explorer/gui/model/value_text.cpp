// SPDX-License-Identifier: Apache-2.0
#include "model/value_text.hpp"

#include "cortex/core/labelled_value.hpp"
#include "cortex/core/nearest_names.hpp"

#include "common/number_text.hpp"
#include "model/plain_text.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <cmath>

namespace cortex::gui {

namespace {

constexpr QChar minus{0x2212};

QString tr(const char* text) { return QCoreApplication::translate("Value", text); }

QString superscript(int number) {
    static const QString digits = QStringLiteral("⁰¹²³⁴⁵⁶⁷⁸⁹");
    QString text;
    for (const QChar digit : QString::number(std::abs(number))) {
        text += digits[digit.digitValue()];
    }
    return number < 0 ? QStringLiteral("⁻") + text : text;
}

// "-1.2e-5" as it is printed.
QString typeset(const QString& plain) {
    const int e = plain.indexOf('e');
    QString text = plain.left(e);
    if (e >= 0) text += QStringLiteral("×10") + superscript(plain.mid(e + 1).toInt());
    return text.startsWith('-') ? minus + text.mid(1) : text;
}

// With so many significant digits. No digit before the point is rounded away without an exponent.
QString roundedText(double number, int digits) {
    constexpr int smallest = -4;
    const QString text = QString::number(number, 'e', digits - 1);
    const int e = text.indexOf('e'), exponent = text.mid(e + 1).toInt();
    if (exponent >= smallest && exponent < digits) {
        return typeset(QString::fromStdString(common::significantText(number, digits)));
    }
    QString mantissa = text.left(e);
    while (mantissa.contains('.') && (mantissa.endsWith('0') || mantissa.endsWith('.'))) {
        mantissa.chop(1);
    }
    return typeset(mantissa + text.mid(e));
}

QString label(const DataItem& item, std::int64_t number) {
    QString digits = QString::number(number).replace('-', minus);
    if (item.labels.empty()) return digits;
    const auto found = item.labels.find(number);
    if (found == item.labels.end()) return tr("%1 (no label)").arg(digits);
    return QStringLiteral("%1 (%2)").arg(isolatedText(found->second), digits);
}

// "Standby, Homing or Velocity": the nearest, otherwise the first.
QString labelsToTry(const DataItem& item, const std::string& text) {
    constexpr int mostTried = 3;
    std::vector<std::string> labels;
    for (const auto& [number, each] : item.labels) labels.push_back(each);
    const QString near = QString::fromStdString(nearestNames(text, labels));
    QStringList tried =
        near.mid(near.indexOf(QStringLiteral(": ")) + 2).split(QStringLiteral(", "));
    if (near.isEmpty()) {
        tried.clear();
        for (const std::string& each : labels) tried << QString::fromStdString(each);
    }
    tried = tried.mid(0, mostTried);
    const QString last = tried.takeLast();
    return tried.isEmpty() ? last : tr("%1 or %2").arg(tried.join(QStringLiteral(", ")), last);
}

// Of one element. `read`: it is of its kind, and no value of this item.
QString whyNoValue(const DataItem& item, const QString& text, bool read,
                   const std::string& reason) {
    if (!item.labels.empty() && (!read || isClosed(item))) {
        return tr("'%1' is no label; try %2").arg(text, labelsToTry(item, text.toStdString()));
    }
    if (read) return QString::fromStdString(reason);
    if (item.kind == Kind::Bool) return tr("true or false expected");
    if (item.kind == Kind::Float) return tr("number expected");
    const bool tooLarge = QString::fromStdString(reason).contains(QStringLiteral("64 bit"));
    return tooLarge || item.kind != Kind::Int ? QString::fromStdString(reason)
                                              : tr("whole number expected");
}

}  // namespace

QString numberText(const DataItem& item, double number) {
    if (std::isnan(number)) return tr("not a number");
    if (std::isinf(number)) return number > 0 ? QStringLiteral("∞") : minus + QStringLiteral("∞");
    return typeset(QString::fromStdString(common::numberText(item, number)));
}

QString fittingNumber(const DataItem& item, double number,
                      const std::function<bool(const QString&)>& fits) {
    QString text = numberText(item, number);
    if (!std::isfinite(number)) return text;
    for (int digits = 6; digits > 0 && !fits(text); --digits) text = roundedText(number, digits);
    return text;
}

QString tickText(double number, double step) {
    constexpr int usual = 6, most = 17;
    constexpr double greatestFixed = 1e15;
    const double size = std::abs(number);
    if (!(step > 0) || size < step) return numberText(DataItem{}, number);
    const int first = static_cast<int>(std::floor(std::log10(size)));
    const int last = static_cast<int>(std::floor(std::log10(step) + 1e-6));
    const int digits = first - last + 1;
    if (digits <= usual) return numberText(DataItem{}, number);
    if (size < greatestFixed) return typeset(QString::number(number, 'f', std::max(0, -last)));
    return typeset(QString::number(number, 'e', std::min(digits, most) - 1));
}

QString elementText(const DataItem& item, const Value& value, std::size_t element) {
    if (element >= lengthOf(value)) return {};
    if (const auto* ints = std::get_if<std::vector<std::int64_t>>(&value)) {
        return label(item, (*ints)[element]);
    }
    if (const auto* floats = std::get_if<std::vector<double>>(&value)) {
        return numberText(item, (*floats)[element]);
    }
    if (const auto* bools = std::get_if<std::vector<bool>>(&value)) {
        return (*bools)[element] ? QStringLiteral("true") : QStringLiteral("false");
    }
    QString text = QString::fromStdString(std::get<std::vector<std::string>>(value)[element]);
    for (QChar& c : text) {
        if (!c.isPrint()) c = QChar{0xFFFD};
    }
    return text;
}

QString valueText(const DataItem& item, const Value& value) {
    if (item.length == 1) return elementText(item, value, 0);
    QStringList first;
    for (std::size_t i = 0; i < std::min<std::size_t>(3, lengthOf(value)); ++i) {
        first << elementText(item, value, i);
    }
    if (lengthOf(value) > 3) first << QStringLiteral("…");
    return first.join(QStringLiteral("  "));
}

QString bracketed(const QString& text) { return '[' + text + ']'; }

QString entryText(const DataItem& item, const Value& value) {
    const auto* texts = std::get_if<std::vector<std::string>>(&value);
    if (texts != nullptr && texts->size() == 1) return QString::fromStdString(texts->front());
    const auto labels = labelsOf(item, value);
    const bool labelled = !labels.empty() && std::ranges::none_of(labels, &std::string::empty);
    if (!labelled) return QString::fromStdString(toText(value));
    QStringList all;
    for (const std::string& each : labels) all << QString::fromStdString(each);
    const bool plain = std::ranges::all_of(all, isPlain);
    return plain ? all.join(' ') : QString::fromStdString(toText(value));
}

QString wrongText(const std::string& item, const QString& why) {
    const bool isSaidOfIt = why.startsWith(QLatin1String{"is "});
    return QString::fromStdString(item) +
           (isSaidOfIt ? QStringLiteral(" ") : QStringLiteral(": ")) + why;
}

std::vector<std::pair<std::int64_t, QString>> choicesOf(const DataItem& item) {
    if (item.length != 1) return {};
    if (item.kind == Kind::Bool) return {{0, QStringLiteral("false")}, {1, QStringLiteral("true")}};
    std::vector<std::pair<std::int64_t, QString>> choices;
    for (const auto& [number, label] : item.labels)
        choices.emplace_back(number, QString::fromStdString(label));
    return choices;
}

std::optional<Value> enteredValue(const DataItem& item, const QString& text, QString& why) {
    std::string reason;
    const std::string plain = QString{text}.replace(minus, QLatin1Char{'-'}).toStdString();
    auto value = parseItemValue(item, plain, reason);
    if (value) reason = valueError(item, *value);
    why = reason.empty()     ? QString{}
          : item.length == 1 ? whyNoValue(item, text.trimmed(), value.has_value(), reason)
                             : QString::fromStdString(reason);
    if (!reason.empty()) value.reset();
    return value;
}

QString unitText(const std::string& ucum) {
    static constexpr std::array<std::array<const char*, 2>, 6> names{
        {{"Cel", "°C"}, {"deg", "°"}, {"Ohm", "Ω"}, {"um", "µm"}, {"us", "µs"}, {"uA", "µA"}}};
    QString text;
    QString name;
    const auto endName = [&] {
        for (const auto& [written, shown] : names) {
            if (name == QLatin1String{written}) name = QString::fromUtf8(shown);
        }
        text += name;
        name.clear();
    };
    const QString all = QString::fromStdString(ucum);
    for (int i = 0; i < all.size(); ++i) {
        const QChar c = all[i];
        const bool sign = c == '-' && i + 1 < all.size() && all[i + 1].isDigit();
        if ((c.isDigit() || sign) && !(name.isEmpty() && text.isEmpty())) {
            int end = i + 1;
            while (end < all.size() && all[end].isDigit()) ++end;
            endName();
            text += superscript(all.mid(i, end - i).toInt());
            i = end - 1;
        } else if (c == '.') {
            endName();
            text += QStringLiteral("·");
        } else if (c == '/') {
            endName();
            text += c;
        } else {
            name += c;
        }
    }
    endName();
    return text == QLatin1String{"1"} ? QString{} : text;
}

QString ageText(double seconds) {
    if (seconds < 1) return tr("%1 ms").arg(std::lround(seconds * 1000));
    if (seconds < 100) return tr("%1 s").arg(seconds, 0, 'f', 1);
    const auto minutes = static_cast<int>(seconds / 60);
    if (minutes < 100) return tr("%1 min").arg(minutes);
    return tr("%1 h %2 min").arg(minutes / 60).arg(minutes % 60, 2, 10, QLatin1Char{'0'});
}

QString wholeAgeText(double seconds) {
    return seconds < 100 ? tr("%1 s").arg(static_cast<int>(seconds)) : ageText(seconds);
}

std::optional<double> numberOf(const Value& value, std::size_t element) {
    if (element >= lengthOf(value)) return std::nullopt;
    if (const auto* ints = std::get_if<std::vector<std::int64_t>>(&value)) {
        return static_cast<double>((*ints)[element]);
    }
    if (const auto* floats = std::get_if<std::vector<double>>(&value)) return (*floats)[element];
    return std::nullopt;
}

std::optional<double> numberOf(const std::optional<Number>& bound) {
    if (!bound) return std::nullopt;
    return std::visit([](auto number) { return static_cast<double>(number); }, *bound);
}

}  // namespace cortex::gui
