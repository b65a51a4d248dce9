// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/system_model.hpp"
#include "views/tree_openness.hpp"
#include "widgets/filter_keys.hpp"

#include <QWidget>
#include <memory>
#include <string>

class QBoxLayout;
class QLineEdit;

namespace cortex::gui {

class RowNote;
class TextLabel;
class TreeRows;

// All simplexes of all agents as one tree, with a filter above it. The row under the pointer stays
// where it is while others come and go.
class SystemTree : public QWidget {
    Q_OBJECT
public:
    explicit SystemTree(QWidget* parent = nullptr);

    void addLeft(QWidget& back);  // in its head, shown while the tree covers the views
    void refresh(std::shared_ptr<const Frame> frame);
    void choose(const std::string& path);  // opens what is above it, as soon as it is there
    const SystemModel& model() const { return model_; }
    // What is meant while `shown` is in front: the current row where that is a part of the plant,
    // or where nothing is shown.
    std::string meant(const std::string& shown) const;
    void filter(const QString& text);
    void focusFilter();
    TreeOpenness& openness() { return openness_; }

Q_SIGNALS:
    void chosen(const std::string& path);   // shown in the current tab
    void pinned(const std::string& path);   // in a tab of its own
    void entered(const std::string& path);  // as chosen, with the keyboard
    void changed();                         // a person has opened or closed a row
    void menuWanted(const std::string& path, const QPoint& at);  // on the screen
    void left();  // something was chosen, or Esc with nothing to clear

protected:
    void keyPressEvent(QKeyEvent* event) override;  // that neither rows nor filter want

private:
    TreeRows* makeRows();
    bool coversViews() const;
    void leaveFilter(FilterKey key);
    void openAbove(const QModelIndex& index);
    void useFilter();
    void keepCurrent();
    void askMenu(const QPoint& at);
    void tellTrouble();
    void tellCount();

    SystemModel model_;
    TreeRows* tree_;
    TreeOpenness openness_;
    QLineEdit* filter_;
    QBoxLayout* head_;
    const QWidget* back_ = nullptr;
    TextLabel* count_;
    RowNote* trouble_;     // over the last rows
    std::string wanted_;   // to be chosen as soon as it is there
    std::string current_;  // row that a person went to, or that was chosen, also while it is gone
    bool filtered_ = false;
};

}  // namespace cortex::gui
