// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/event_model.hpp"
#include "model/overview.hpp"

#include <QObject>

namespace cortex::gui {

// The last commands, refusals, changes of control, losses and faults, whatever any filter hides.
// The newest is the last, by the clocks of the agents. A link that breaks tells of a dozen losses
// at once, so they have a share of their own.
class LastEvents : public QObject {
    Q_OBJECT
public:
    static constexpr std::size_t usual = 20, usualLosses = 8, most = 1'000;

    explicit LastEvents(const EventModel& events, QObject* parent = nullptr);

    // Looks at what came since. While its rows are looked at, none goes and none comes between.
    const OverviewRows& update(bool held);
    void forget() { rows_.clear(), other_ = true; }  // times are in another zone

private:
    void add(int first, int last);
    void change(int first, int last);
    void fill();
    void keepUsual();

    const EventModel& events_;
    OverviewRows rows_;
    bool other_ = true;  // they are to be found anew
};

}  // namespace cortex::gui
