// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/event_filter.hpp"

#include <QWidget>
#include <functional>
#include <map>
#include <string>
#include <vector>

class QToolButton;

namespace cortex::gui {

class Chip;

// A chip for each severity, for each kind that there was, and for jog commands: how many match what
// is typed, and whether they are shown. They stand in the order in which they came, in as many rows
// as there are from the start; what has no room is behind a button: "3 more".
class EventChips : public QWidget {
    Q_OBJECT
public:
    explicit EventChips(EventFilter& events, QWidget* parent = nullptr);

    void refresh();
    void setRows(int rows);
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    Chip* add(Chip* chip, bool shown, const std::function<void(bool)>& show);
    void show(Chip& chip, bool shown, std::uint64_t count);
    void place();
    int moreWidth() const;
    void openMenu();

    EventFilter& events_;
    std::map<Severity, Chip*> severities_;
    std::map<std::string, Chip*> kinds_;
    Chip* routine_ = nullptr;
    std::vector<Chip*> chips_;  // all
    QToolButton* more_;
    int rows_ = 2;
};

}  // namespace cortex::gui
