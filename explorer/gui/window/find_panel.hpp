// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/find_index.hpp"
#include "widgets/popover.hpp"
#include "window/find_actions.hpp"
#include "window/pages.hpp"

class QLineEdit;
class QTreeWidget;

namespace cortex::gui {

class TextLabel;

// What Ctrl+K opens: one field that finds simplexes, items, commands, views and what the
// window does.
class FindPanel : public Popover {
    Q_OBJECT
public:
    explicit FindPanel(FindIndex index, QWidget* parent = nullptr);

    QLineEdit& field() { return *field_; }
    QTreeWidget& list() { return *list_; }

Q_SIGNALS:
    void chosen(const cortex::gui::Found& found, bool beside);

protected:
    bool eventFilter(QObject* object, QEvent* event) override;

private:
    void search();
    void choose(bool beside);

    FindIndex index_;
    std::vector<const Found*> found_;
    QLineEdit* field_;
    QTreeWidget* list_;
    TextLabel* note_;
};

// Below the button, within its window, with all that is known now.
FindPanel* openFindPanel(const Frame& frame, const std::vector<PageKind>& kinds,
                         const std::vector<FindAction>& actions, QWidget& button);

}  // namespace cortex::gui
