// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/abnormal.hpp"

#include <QStringList>
#include <QWidget>

namespace cortex::gui {

class Link;
class TextLabel;

// The line at the bottom of every window: how much is in Fault, beyond its limits and lost of
// everything that is heard, domain, the agents that are worst off, security.
class StatusBar : public QWidget {
    Q_OBJECT
public:
    explicit StatusBar(QWidget* parent = nullptr);
    void refresh(const Frame& frame, const Abnormal& abnormal);

Q_SIGNALS:
    void nextWanted(Abnormal::Kind kind);  // a counter was pressed
    void agentsWanted();                   // those that have no room were pressed

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    class Counter;
    void fit(const QStringList& agents);
    int showMore(int left, bool brief);

    std::array<Counter*, Abnormal::KindCount> counters_;
    TextLabel *domain_, *agents_, *security_;
    Link* more_;
};

}  // namespace cortex::gui
