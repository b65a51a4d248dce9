// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QTimer>
#include <QTreeView>
#include <functional>

namespace cortex::gui {

class SystemModel;

// The rows of the tree. It knows whether a person is acting just now: rows that come and go move
// the current row, too. A press may begin a drag: what is chosen by the mouse is told when the
// button is up again. While the pointer is over it, it scrolls further than its rows reach, to keep
// one in its place.
class TreeRows : public QTreeView {
public:
    explicit TreeRows(const SystemModel& model);

    bool acts() const { return acts_; }
    bool presses() const { return presses_; }
    void goTo(const QModelIndex& index);  // as a key does
    // Opens and closes many rows, which are laid out once.
    void openMany(const std::function<void()>& change);

    // The row under the pointer stays there. Where it goes, presses are not meant for the next one.
    void keepPlace(const std::function<void()>& change);
    void forgetPlace();

protected:
    bool viewportEvent(QEvent* event) override;
    void updateGeometries() override;
    void keyPressEvent(QKeyEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void startDrag(Qt::DropActions actions) override;
    void drawRow(QPainter* painter, const QStyleOptionViewItem& option,
                 const QModelIndex& index) const override;

private:
    QModelIndex underPointer() const;
    void scrollBeyond(int beyond, int value);
    bool isOfOther(const QEvent& event);

    const SystemModel& items_;
    bool acts_ = false, presses_ = false, ignores_ = false, fits_ = false;
    int beyond_ = 0;  // value of the scroll bar, with a margin above the rows where it is below 0
    QTimer other_{this};  // since another row is under the pointer
};

}  // namespace cortex::gui
