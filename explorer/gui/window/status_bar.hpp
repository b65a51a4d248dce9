// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/system_model.hpp"

#include <QWidget>

namespace cortex::explorer {

class TextLabel;

// The line at the bottom of every window: faults and losses of everything that is heard, domain,
// the agents that are worst off, security.
class StatusBar : public QWidget {
    Q_OBJECT
public:
    explicit StatusBar(QWidget* parent = nullptr);
    void refresh(const Frame& frame, const Marks& total);

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    class Counter;
    Counter *faults_, *lost_;
    TextLabel *domain_, *agents_, *security_;
};

}  // namespace cortex::explorer
