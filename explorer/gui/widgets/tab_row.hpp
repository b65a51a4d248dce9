// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QTabBar>
#include <QVariant>
#include <vector>

class QToolButton;

namespace cortex::gui {

// Tabs in one row. Those that have no room are behind a button at its right end: "2 more". The tab
// in front is always seen, and no tab takes the place of another one while it has room itself.
class TabRow : public QTabBar {
    Q_OBJECT
public:
    explicit TabRow(QWidget* parent = nullptr);

    // What is not offered is neither seen nor behind the button. It stands in for setTabVisible(),
    // which is about room here.
    void offer(int tab, bool offered);
    bool isOffered(int tab) const { return !tabData(tab).isValid() || tabData(tab).toBool(); }
    void setWidest(double units) { widest_ = units; }  // of each tab; cut in its middle
    int end() const;                                   // right edge of the last tab that is seen
    QToolButton& moreButton() { return *more_; }

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

protected:
    QSize tabSizeHint(int tab) const override;
    QSize minimumTabSizeHint(int tab) const override;
    void tabLayoutChange() override;
    void keyPressEvent(QKeyEvent* event) override;  // arrows go to what has no room, too

private:
    int moreWidth() const;
    int high() const;
    std::vector<bool> withRoom() const;
    void fit();
    void openMenu();

    QToolButton* more_;
    double widest_ = 0;  // 0: as wide as its text
    bool fitting_ = false;
};

}  // namespace cortex::gui
