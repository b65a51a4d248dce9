// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "motion/shown_number.hpp"
#include "motion/tip.hpp"

#include <QWidget>
#include <array>
#include <string>

class QLabel;

namespace cortex::explorer {

class Sentence;

// Where a tip is, in the base, and what holds it back.
class TipNumbers : public QWidget {
    Q_OBJECT
public:
    explicit TipNumbers(QWidget* parent = nullptr);

    void show(const Tip& tip, const std::string& controller, const ShownNumber& lengths,
              const ShownNumber& angles);

private:
    static QString noteOf(const Tip& tip, const std::string& controller);

    QLabel* title_;
    std::array<QLabel*, 6> numbers_{};
    Sentence* distance_;
    Sentence* note_;  // why these are not the numbers of this tip, or of now; what holds it back
};

}  // namespace cortex::explorer
