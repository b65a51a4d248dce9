// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QSize>

class QPushButton;
class QSplitter;
class QWidget;

namespace cortex::explorer {

// How the tree, the views and the events share the window. Where it is narrow, the views have all
// of it: the tree is a button before the tabs, and takes their place.
class Arrangement {
public:
    // `across` holds the tree and `down`; `down` holds the views and the events.
    Arrangement(QSplitter& across, QSplitter& down);

    QPushButton& treeButton() { return *treeButton_; }  // shown while narrow
    bool fit(QSize window);  // after it was resized or scaled; true: it is narrow now, or was
    bool isNarrow() const { return narrow_; }
    void toggleTree();
    void showTree();
    void leaveTree();  // something was chosen in it: the views have the place again

private:
    QWidget& tree() const;
    void share(QSize window);

    QSplitter& across_;
    QSplitter& down_;
    QPushButton* treeButton_;
    bool narrow_ = false, fitted_ = false;
};

}  // namespace cortex::explorer
