// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/event_filter.hpp"

#include <QWidget>
#include <functional>
#include <map>
#include <string>

namespace cortex::gui {

class Chip;

// A chip for each severity, for each kind that there is, and for jog commands: how many match what
// is typed, and whether they are shown.
class EventChips : public QWidget {
    Q_OBJECT
public:
    explicit EventChips(EventFilter& events, QWidget* parent = nullptr);

    void refresh();

private:
    Chip* add(Chip* chip, bool shown, const std::function<void(bool)>& show);

    EventFilter& events_;
    std::map<Severity, Chip*> severities_;
    std::map<std::string, Chip*> kinds_;
    Chip* routine_;
};

}  // namespace cortex::gui
