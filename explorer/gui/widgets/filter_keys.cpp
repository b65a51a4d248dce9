// SPDX-License-Identifier: Apache-2.0
#include "widgets/filter_keys.hpp"

#include <QAbstractItemView>
#include <QApplication>
#include <QKeyEvent>
#include <QLineEdit>
#include <utility>

namespace cortex::gui {

namespace {

class FilterKeys : public QObject {
public:
    FilterKeys(QLineEdit& field, QAbstractItemView& rows, std::function<void(FilterKey)> leave)
        : QObject{&field}, field_{field}, rows_{rows}, leave_{std::move(leave)} {
        field.installEventFilter(this);
        rows.installEventFilter(this);
    }

    bool eventFilter(QObject* object, QEvent* event) override {
        if (event->type() != QEvent::KeyPress) return false;
        const auto& key = *static_cast<QKeyEvent*>(event);
        if (object == &field_) return leavesField(key);
        if (key.key() != Qt::Key_Up || key.modifiers() != Qt::NoModifier || !isFirst())
            return false;
        field_.setFocus(Qt::BacktabFocusReason);
        return true;
    }

private:
    bool leavesField(const QKeyEvent& key) {
        const bool enter = key.key() == Qt::Key_Return || key.key() == Qt::Key_Enter;
        if (!enter && key.key() != Qt::Key_Down) return false;
        if (rows_.model()->rowCount() == 0) return true;
        const bool control = key.modifiers().testFlag(Qt::ControlModifier);
        const FilterKey which = !enter    ? FilterKey::Down
                                : control ? FilterKey::CtrlEnter
                                          : FilterKey::Enter;
        leave_ ? leave_(which) : goToRows();
        return true;
    }
    void goToRows() {
        rows_.setFocus(Qt::TabFocusReason);
        if (rows_.currentIndex().isValid()) return rows_.scrollTo(rows_.currentIndex());
        QKeyEvent down{QEvent::KeyPress, Qt::Key_Down, Qt::NoModifier};
        QApplication::sendEvent(&rows_, &down);
    }
    bool isFirst() const {
        const QModelIndex row = rows_.currentIndex();
        return row.isValid() && row.row() == 0 && !row.parent().isValid();
    }

    QLineEdit& field_;
    QAbstractItemView& rows_;
    std::function<void(FilterKey)> leave_;
};

}  // namespace

void joinFilter(QLineEdit& field, QAbstractItemView& rows, std::function<void(FilterKey)> leave) {
    new FilterKeys{field, rows, std::move(leave)};
}

}  // namespace cortex::gui
