// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/event_filter.hpp"

#include <QTableView>
#include <optional>
#include <string>

namespace cortex::gui {

// The events that are shown, as rows: a table, as a tree lays all rows out for each new one. It
// follows the newest unless somebody has scrolled up; F and End follow again. Under the pointer it
// stands still, also when what agents kept is put above it. Right opens a row of many events, Left
// closes it; Enter opens what was before a fault, of other rows the simplex. Which row is selected
// changes only by an act of the person.
class EventTable : public QTableView {
    Q_OBJECT
public:
    explicit EventTable(EventFilter& events, QWidget* parent = nullptr);

    bool follows() const { return follows_ && newBelow_ == 0; }
    void follow();
    void choose(int row);                                 // as a press does; it stays in sight
    std::uint64_t newBelow() const { return newBelow_; }  // events since it stands still
    // The row that is selected, by its serial number.
    std::optional<std::uint64_t> selected() const;
    const comms::AgentEvent* selectedFault() const;  // null: another row is, or none

Q_SIGNALS:
    void opened(const std::string& path);
    void beforeWanted(const comms::AgentEvent& fault);
    void moved();             // it follows, or does not, or there is more below
    void selectionSet();      // by the person
    void selectionDropped();  // it is no longer kept, or hidden

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void rowsAboutToBeRemoved(const QModelIndex& parent, int first, int last) override;
    void currentChanged(const QModelIndex& current, const QModelIndex& previous) override;

private:
    bool isAtEnd() const;
    bool isUnderPointer() const;
    void look();  // whether it is at its end after it was scrolled
    void forgetNew();
    void countNew();
    void inserted(int first, int last);
    void removed(int count);
    void noteRows();
    void keepRows();
    void fitColumns();

    EventFilter& events_;
    bool follows_ = true, keeps_ = false;
    std::uint64_t newBelow_ = 0;
    std::optional<std::uint64_t> newFrom_;  // the first row that came since
    // While the model is reset: what was selected, and what stood how far below the top.
    std::optional<std::uint64_t> before_, stands_;
    int standsAt_ = 0;
};

}  // namespace cortex::gui
