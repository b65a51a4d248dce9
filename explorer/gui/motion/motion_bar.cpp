// SPDX-License-Identifier: Apache-2.0
#include "motion/motion_bar.hpp"

#include "motion/choices.hpp"
#include "motion/labels.hpp"

#include <QHBoxLayout>
#include <QSlider>
#include <QVBoxLayout>

namespace cortex::explorer {

namespace {

constexpr int firstPercent = 10;
constexpr double narrowBar = 125;  // units; below it a sentence about the speed takes two lines

std::vector<std::pair<QString, QString>> unitsOf(const QString& one, const QString& other) {
    return {{one, one}, {other, other}};
}

}  // namespace

MotionBar::MotionBar(const QString& mode, const std::vector<std::pair<QString, QString>>& modes,
                     QWidget* parent)
    : QWidget{parent},
      slider_{new QSlider{Qt::Horizontal}},
      percent_{new QLabel},
      speed_{new Sentence{Tone::Quiet}},
      angles_{new Choices{unitsOf(QStringLiteral("rad"), QStringLiteral("deg"))}},
      lengths_{new Choices{unitsOf(QStringLiteral("m"), QStringLiteral("mm"))}},
      modes_{new Choices{modes}},
      modeName_{new QLabel{mode}},
      mode_{new Sentence} {
    slider_->setRange(1, 100);
    slider_->setValue(firstPercent);
    slider_->setFixedWidth(units(30));
    slider_->setAccessibleName(tr("Share of the greatest speed"));
    slider_->setToolTip(tr("It starts at 10 % each time."));
    const auto tell = [this] { percent_->setText(tr("%1 %").arg(slider_->value())); };
    connect(slider_, &QSlider::valueChanged, this, [this, tell] {
        tell();
        Q_EMIT shareChanged();
    });
    tell();
    const bool hasModes = !modes.empty();
    for (QWidget* each : std::initializer_list<QWidget*>{modeName_, modes_, mode_})
        each->setVisible(hasModes);
    layOut(hasModes);
}

void MotionBar::layOut(bool hasModes) {
    auto *first = new QHBoxLayout, *second = new QHBoxLayout;
    for (QHBoxLayout* each : {first, second}) each->setSpacing(units(2));
    for (QWidget* each :
         std::initializer_list<QWidget*>{new QLabel{tr("Speed")}, slider_, percent_})
        first->addWidget(each);
    percent_->setMinimumWidth(percent_->fontMetrics().horizontalAdvance(tr("%1 %").arg(100)));
    first->addWidget(speed_, 1);
    second->addWidget(modeName_);
    second->addWidget(modes_);
    second->addWidget(mode_, 1);
    if (hasModes) {
        mode_->keepLines(2);
        mode_->setMinimumWidth(units(15));
    }
    for (Choices* each : {angles_, lengths_}) (hasModes ? second : first)->addWidget(each);
    auto* rows = new QVBoxLayout{this};
    rows->setContentsMargins(units(4), 0, units(2), 0);
    rows->setSpacing(units(1));
    rows->addLayout(first);
    rows->addLayout(second);
}

void MotionBar::resizeEvent(QResizeEvent* /*event*/) {
    speed_->keepLines(width() < units(narrowBar) ? 2 : 1);
}

double MotionBar::share() const { return slider_->value() / 100.0; }

void MotionBar::setAllowed(bool allowed) {
    if (allowed && !allowed_) slider_->setValue(firstPercent);
    allowed_ = allowed;
}

void MotionBar::saySpeed(const QString& text) { speed_->say(text); }

void MotionBar::sayMode(const QString& text) { mode_->say(text); }

}  // namespace cortex::explorer
