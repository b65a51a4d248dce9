// SPDX-License-Identifier: Apache-2.0
#include "model/compare_row.hpp"

#include "cortex/core/labelled_value.hpp"

#include "model/item_text.hpp"
#include "model/value_text.hpp"

#include <QCoreApplication>
#include <cmath>

namespace cortex::gui {

namespace {

constexpr QChar minusSign{0x2212};

QString rowText(const char* text) { return QCoreApplication::translate("CompareRow", text); }

QString unknownText() { return QStringLiteral("—"); }

// Whole numbers to their last digit.
QString shownDistance(const CompareRow& row) {
    const ExactNumber& left = *row.left;
    if (left.isWhole()) return QString::fromStdString(left.text()).replace('-', minusSign);
    return row.shown ? numberText(row.shown->item, left.near() * row.shown->factor)
                     : numberText(*row.item->item, left.near());
}

// "12 %  0.21 upper"; negative: outside.
QString distanceText(const CompareRow& row) {
    if (!row.left) return unknownText();
    QString text = shownDistance(row);
    if (row.share && std::isfinite(*row.share)) {
        text = QString::number(*row.share * 100, 'f', 1).replace('-', minusSign) +
               QStringLiteral(" %  ") + text;
    }
    if (!row.live && !row.constant) text = bracketed(text);
    return text + ' ' + (row.upper ? rowText("upper") : rowText("lower"));
}

// Is its value one that cannot be? Its number is that of an element of `value`.
bool hasNoLabel(const CompareRow& row, const Value& value) {
    const DataItem& item = *row.item->item;
    const auto* ints = std::get_if<std::vector<std::int64_t>>(&value);
    return ints != nullptr && isClosed(item) && !item.labels.contains((*ints)[row.element]);
}

// By the nearer limit, which one of two is that the number is beyond.
void readLimits(CompareRow& row) {
    const DataItem& item = *row.item->item;
    row.min = numberOf(item.min);
    row.max = numberOf(item.max);
    row.left.reset();
    row.share.reset();
    row.upper = false;
    if (!row.number) return;
    if (item.min) row.left = *row.number - ExactNumber{*item.min};
    if (item.max) {
        const ExactNumber above = ExactNumber{*item.max} - *row.number;
        row.upper = !row.left || above < *row.left;
        if (row.upper) row.left = above;
    }
    if (!item.min || !item.max) return;
    const double width = (ExactNumber{*item.max} - ExactNumber{*item.min}).near();
    const double share = row.left->near() / width;
    if (width > 0 && std::isfinite(width)) row.share = share;
}

QString remarkOf(const Frame& frame, const CompareRow& row, bool labelled) {
    const AgentFrame& agent = frame.agents[row.place.agent];
    const Excuse excuse = frame.excuse(row.place);
    if (excuse == Excuse::Ended) return rowText("ended");
    if (agent.lost()) return rowText("lost");
    if (row.outside && !labelled) return rowText("no label");
    if (row.outside) return row.upper ? rowText("above limit") : rowText("below limit");
    if (excuse == Excuse::Rests) return rowText("rests");
    const Quality quality = agent.quality(row.place.simplex);
    return quality == Quality::Good ? QString{} : QLatin1String{name(quality)};
}

}  // namespace

void readRow(CompareRow& row, const Frame& frame) {
    const AgentFrame& agent = frame.agents[row.place.agent];
    const DataItem& item = *row.item->item;
    const bool good = agent.quality(row.place.simplex) == Quality::Good;
    row.constant = item.constant;
    row.live = good && agent.beats();
    row.unit = unitText(row.shown ? row.shown->item.unit : item.unit);
    const auto value = agent.value(row.place.simplex, *row.item);
    row.came = value.has_value();
    row.number = value ? exactOf(*value, row.element) : std::nullopt;
    readLimits(row);
    const bool labelled = !value || !hasNoLabel(row, *value);
    const bool beyond = row.left && *row.left < ExactNumber{0.0};
    row.outside = good && !agent.lost() && (beyond || !labelled);
    const QString text = value ? shownText(row.shown.get(), item, *value, row.element) : QString{};
    row.value = text.isEmpty() ? unknownText() : row.live || row.constant ? text : bracketed(text);
    row.distance = distanceText(row);
    row.seconds = agent.age(row.place.simplex);
    row.age = row.seconds ? ageText(static_cast<double>(*row.seconds)) : unknownText();
    row.remark = remarkOf(frame, row, labelled);
}

QString limitText(const CompareRow& row) {
    const QString limits = limitsText(row.shown ? row.shown->item : *row.item->item);
    if (limits.isEmpty()) return rowText("It has no limits.");
    QString text = rowText("Limits: %1.").arg(limits);
    if (!row.left) return text;
    QString number = shownDistance(row) + ' ' + row.unit;
    const bool beyond = *row.left < ExactNumber{0.0};
    if (number.startsWith(minusSign)) number.remove(0, 1);
    const QString place =
        row.upper == beyond
            ? (row.upper ? rowText("%1 above the upper one.") : rowText("%1 above the lower one."))
            : (row.upper ? rowText("%1 below the upper one.") : rowText("%1 below the lower one."));
    return text + ' ' + place.arg(number.trimmed());
}

}  // namespace cortex::gui
