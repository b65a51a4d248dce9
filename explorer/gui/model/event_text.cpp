// SPDX-License-Identifier: Apache-2.0
#include "model/event_text.hpp"

#include "cortex/core/command_sentence.hpp"
#include "cortex/core/event.hpp"

#include "model/plain_text.hpp"

#include <string_view>

namespace cortex::gui {

namespace {

constexpr int digitsOfRange = 6;

QString sixDigits(const std::string& number) {
    QString text = QString::number(valueOfNumber(number), 'g', digitsOfRange);
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
    std::string shown{parts.person};
    if (withTool) shown.append(" (").append(parts.tool).append(")");
    return std::string{text}.replace(static_cast<std::size_t>(said.data() - text.data()),
                                     said.size(), shown);
}

}  // namespace

bool tellsOfCommand(const std::string& kind) {
    return kind == name(EventKind::Command) || kind == name(EventKind::Control) ||
           kind == name(EventKind::Refusal);
}

SenderParts senderParts(std::string_view sender) {
    constexpr std::string_view behalf = " for ";
    SenderParts parts;
    const auto at = sender.find(behalf);
    parts.tool = sender.substr(0, at);
    if (at != std::string_view::npos) parts.person = sender.substr(at + behalf.size());
    return parts;
}

std::string personFirst(const std::string& text) { return withPerson(text, true); }

std::string personAlone(const std::string& text) { return withPerson(text, false); }

QString rangeText(const NumberRange& range) {
    if (range.isOne()) return QString::fromStdString(range.first);
    return QStringLiteral("%1 … %2").arg(sixDigits(range.least), sixDigits(range.greatest));
}

QString foldedText(const std::string& words, const std::vector<NumberRange>& ranges) {
    QString text;
    std::size_t next = 0, begin = 0;
    for (std::size_t at; (at = words.find(numberSign, begin)) != std::string::npos;) {
        text += plainText(words.substr(begin, at - begin));
        if (next < ranges.size()) text += rangeText(ranges[next++]);
        begin = at + 1;
    }
    return text + plainText(words.substr(begin));
}

}  // namespace cortex::gui
