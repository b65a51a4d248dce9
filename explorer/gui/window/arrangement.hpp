// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QJsonObject>
#include <QPointer>
#include <QSize>
#include <QWidget>
#include <functional>

class QPushButton;
class QSplitter;

namespace cortex::gui {

class SystemTree;
class Workspace;

// How the tree, the views and the events share the window. Where it is narrow, the views have all
// of it: the tree is a button before the tabs, and takes their place; the events have their tab.
class Arrangement {
public:
    // `across` holds the tree and `down`; `down` holds the views and the events. The user has
    // changed something that is saved: `changed` is called.
    Arrangement(QSplitter& across, QSplitter& down, std::function<void()> changed = [] {});

    // Its buttons stand in both. What is opened in the views leads back to them.
    void join(SystemTree& tree, Workspace& views);
    QPushButton& treeButton() { return *treeButton_; }  // shown while narrow
    QPushButton& backButton() { return *backButton_; }  // while the tree has the place of the views
    bool fit(QSize window);  // after it was resized or scaled; true: it is narrow now, or was
    bool isNarrow() const { return narrow_; }
    void toggleTree();
    void showTree();
    void leaveTree();  // the views have their place again
    void toggleEvents(Workspace& views);
    // The events do, while a tab shows them, and where a view needs the room unless the user wants
    // to see them all the same.
    void giveWay(const Workspace& views);
    // For a layout. What was restored before the window has its size is there when it has.
    QJsonObject saved() const;
    bool wantsEvents() const { return events_.shown; }
    void restore(const QJsonObject& saved, bool wantsEvents = true);

private:
    // What the views share the window with, as it is wanted where the window is wide.
    struct Part {
        QSplitter& splitter;
        int index;
        int usual;     // units
        int size = 0;  // pixels; 0: the usual
        bool shown = true;

        QWidget& widget() const;
        int sizeOr(int pixels) const;
    };
    void show(Part& part, bool shown);
    void cover(bool covers);  // the views, by the tree
    void place(const Part& part, int whole);
    void noteSizes();
    bool seesEvents() const;
    void showEvents();

    QSplitter &across_, &down_;
    Part tree_, events_;
    std::function<void()> changed_;
    QPushButton *treeButton_, *backButton_;
    QPointer<QWidget> focused_;  // in the views, before the tree took their place
    bool narrow_ = false, fitted_ = false, eventsElsewhere_ = false;
    bool roomWanted_ = false, roomMade_ = false;
};

}  // namespace cortex::gui
