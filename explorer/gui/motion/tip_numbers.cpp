// SPDX-License-Identifier: Apache-2.0
#include "motion/tip_numbers.hpp"

#include "motion/labels.hpp"

#include <QGridLayout>
#include <QLabel>

namespace cortex::explorer {

namespace {

constexpr double nearSingular = 0.05;  // of an arm about a metre long: from here on it slows down

constexpr std::array names{"x", "y", "z", "roll", "pitch", "yaw"};

// What the labels of the type mean.
QString heldBackText(const QString& label) {
    if (label == QLatin1String{"Speed"})
        return TipNumbers::tr("Slowed: an axis is at its greatest speed.");
    if (label == QLatin1String{"Limit"})
        return TipNumbers::tr("Held back: an axis is near its limit.");
    if (label == QLatin1String{"Singularity"})
        return TipNumbers::tr("Slowed: near a posture in which the tip cannot move this way.");
    return {};
}

}  // namespace

TipNumbers::TipNumbers(QWidget* parent)
    : QWidget{parent},
      title_{new QLabel},
      distance_{new Sentence{Tone::Quiet}},
      note_{new Sentence{Tone::Limit}} {
    auto* grid = new QGridLayout{this};
    grid->setContentsMargins(units(4), 0, units(4), units(1));
    grid->setSpacing(units(1));
    title_->setTextFormat(Qt::PlainText);
    grid->addWidget(title_, 0, 0, 1, 9);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const int row = 1 + static_cast<int>(i / 3), column = 3 * static_cast<int>(i % 3);
        grid->addWidget(new QLabel{QLatin1String{names[i]}}, row, column);
        numbers_[i] = new QLabel;
        numbers_[i]->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
        numbers_[i]->setAccessibleName(QLatin1String{names[i]});
        grid->addWidget(numbers_[i], row, column + 1);
    }
    for (const int gap : {2, 5}) grid->setColumnMinimumWidth(gap, units(5));
    grid->setColumnStretch(8, 1);
    distance_->keepLines(1);
    note_->keepLines(2);
    note_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    grid->addWidget(distance_, 3, 0, 1, 9);
    grid->addWidget(note_, 4, 0, 1, 9);
}

QString TipNumbers::noteOf(const Tip& tip, const std::string& controller) {
    QStringList all;
    if (!tip.pose.empty() && !tip.another.isEmpty()) {
        all << tr("The tip of %1, with another %2 than %3.")
                   .arg(QString::fromStdString(tip.kinematics), tip.another,
                        QString::fromStdString(controller));
    }
    if (!tip.pose.empty() && !tip.live) all << tr("Not live: these are the last numbers.");
    const QString heldBack = heldBackText(tip.heldBack);
    if (!heldBack.isEmpty()) all << heldBack;
    return all.join(' ');
}

void TipNumbers::show(const Tip& tip, const std::string& controller, const ShownNumber& lengths,
                      const ShownNumber& angles) {
    title_->setText(
        tip.pose.empty()
            ? tr("No simplex computes where the tip is: relate a ForwardKinematics "
                 "with these axes")
            : tr("Tip in the base (%1, %2): %3")
                  .arg(lengths.unit.text, angles.unit.text, QString::fromStdString(tip.pose)));
    note_->say(noteOf(tip, controller));
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        const QString text = (i < 3 ? lengths : angles).text(tip.at[i]);
        numbers_[i]->setText(tip.at[i] && !tip.live ? '[' + text + ']' : text);
        numbers_[i]->setMinimumWidth(
            numbers_[i]->fontMetrics().horizontalAdvance(QStringLiteral("[−8888.88]")));
    }
    const bool isNear = tip.singularDistance && *tip.singularDistance < nearSingular;
    const QString distance =
        tip.singularDistance ? QString::number(*tip.singularDistance, 'f', 2) : QStringLiteral("—");
    distance_->say(tr("Distance from a singular posture: %1").arg(distance),
                   isNear ? Tone::Limit : Tone::Quiet);
}

}  // namespace cortex::explorer
