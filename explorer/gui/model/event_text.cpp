// SPDX-License-Identifier: Apache-2.0
#include "model/event_text.hpp"

#include "cortex/core/command_sentence.hpp"
#include "cortex/core/event.hpp"
#include "cortex/core/value.hpp"

#include "model/plain_text.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <string_view>

namespace cortex::gui {

namespace {

constexpr char numberSign = '\x01';  // stands for a number; control characters are never shown
constexpr int digitsOfRange = 6;

bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

bool belongsToName(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '/' || c == ':';
}

// Where the digits with point and exponent end that begin here.
std::size_t endOfNumber(std::string_view text, std::size_t begin) {
    std::size_t end = begin;
    const auto digits = [&] {
        while (end < text.size() && isDigit(text[end])) ++end;
    };
    digits();
    if (end + 1 < text.size() && text[end] == '.' && isDigit(text[end + 1])) {
        ++end;
        digits();
    }
    if (end < text.size() && text[end] == 'e') {
        std::size_t next = end + 1;
        if (next < text.size() && (text[next] == '-' || text[next] == '+')) ++next;
        if (next < text.size() && isDigit(text[next])) {
            end = next;
            digits();
        }
    }
    return end;
}

// The end of the number that begins here; `begin`: none does.
std::size_t numberAt(std::string_view text, std::size_t begin) {
    const std::size_t first = text[begin] == '-' ? begin + 1 : begin;
    if (first >= text.size() || !isDigit(text[first])) return begin;
    const char before = begin > 0 ? text[begin - 1] : ' ';
    if (belongsToName(before) || before == '.' || before == '-') return begin;
    const std::size_t end = endOfNumber(text, first);
    return end < text.size() && belongsToName(text[end]) ? begin : end;
}

// Whatever the locale; one that no double holds is shown as infinite.
double valueOf(const std::string& number) {
    return toFloat(number).value_or(std::numeric_limits<double>::infinity());
}

QString shown(double number) {
    QString text = QString::number(number, 'g', digitsOfRange);
    return text.startsWith('-') ? QChar{0x2212} + text.mid(1) : text;
}

// Who sent a command, or lost control; empty: the text tells neither.
std::string_view senderIn(std::string_view text) {
    if (const auto sentence = commandSentence(text)) return sentence->sender;
    const std::size_t at = text.find(" no longer has control of ");
    return at != std::string_view::npos ? text.substr(0, at) : std::string_view{};
}

// A name with brackets could stand for another tool: the tool is first then.
std::string withPerson(const std::string& text, bool withTool) {
    const std::string_view said = senderIn(text);
    const SenderParts parts = senderParts(said);
    if (parts.person.empty() || parts.person.find_first_of("()") != std::string_view::npos)
        return text;
    std::string shown{parts.before};
    shown.append(parts.person);
    if (withTool) shown.append(" (").append(parts.tool).append(")");
    return shown + text.substr(said.size());
}

}  // namespace

bool tellsOfCommand(const std::string& kind) {
    return kind == name(EventKind::Command) || kind == name(EventKind::Control) ||
           kind == name(EventKind::Refusal);
}

SenderParts senderParts(std::string_view sender) {
    constexpr std::string_view times = " times within a second: ", behalf = " for ";
    SenderParts parts;
    if (const auto at = sender.find(times); at != std::string_view::npos) {
        parts.before = sender.substr(0, at + times.size());
        sender.remove_prefix(parts.before.size());
    }
    const auto at = sender.find(behalf);
    parts.tool = sender.substr(0, at);
    if (at != std::string_view::npos) parts.person = sender.substr(at + behalf.size());
    return parts;
}

std::string personFirst(const std::string& text) { return withPerson(text, true); }

std::string personAlone(const std::string& text) { return withPerson(text, false); }

NumberedText numberedText(const std::string& text) {
    NumberedText result;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t end = numberAt(text, i);
        if (end > i) {
            result.numbers.push_back(text.substr(i, end - i));
            result.words += numberSign;
            i = end;
            continue;
        }
        // A whole name or number that belongs to one, so that no part of it is taken for a number.
        do {
            if (text[i] != numberSign) result.words += text[i];
            ++i;
        } while (i < text.size() && belongsToName(text[i - 1]) && belongsToName(text[i]));
    }
    return result;
}

NumberRange::NumberRange(const std::string& number)
    : first{number}, last{number}, least{valueOf(number)}, greatest{least} {}

void NumberRange::take(const std::string& number) {
    const double value = valueOf(number);
    last = number;
    least = std::min(least, value);
    greatest = std::max(greatest, value);
}

QString NumberRange::text() const {
    if (least == greatest) return QString::fromStdString(first);
    return QStringLiteral("%1 … %2").arg(shown(least), shown(greatest));
}

QString foldedText(const std::string& words, const std::vector<NumberRange>& ranges) {
    QString text;
    std::size_t next = 0, begin = 0;
    for (std::size_t at; (at = words.find(numberSign, begin)) != std::string::npos;) {
        text += plainText(words.substr(begin, at - begin));
        if (next < ranges.size()) text += ranges[next++].text();
        begin = at + 1;
    }
    return text + plainText(words.substr(begin));
}

}  // namespace cortex::gui
