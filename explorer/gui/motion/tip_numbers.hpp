// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "motion/shown_number.hpp"
#include "motion/tip.hpp"

#include <QWidget>
#include <array>

class QLabel;

namespace cortex::explorer {

class Sentence;

// Where a tip is, in the base, and what holds it back.
class TipNumbers : public QWidget {
    Q_OBJECT
public:
    explicit TipNumbers(QWidget* parent = nullptr);

    void show(const Tip& tip, const ShownNumber& lengths, const ShownNumber& angles);

private:
    QLabel* title_;
    std::array<QLabel*, 6> numbers_{};
    Sentence *heldBack_, *distance_;
};

}  // namespace cortex::explorer
