// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/held_order.hpp"
#include "model/overview.hpp"

#include <QTreeWidget>
#include <functional>
#include <string>
#include <vector>

namespace cortex::gui {

// The rows of one part of the first page. While it is used they keep their places: what comes
// stands at the end, what goes leaves its row, which says so. A press or Enter opens.
class OverviewTable : public QTreeWidget {
    Q_OBJECT
public:
    // How wide a column is: as its texts, which are never cut; at most a share; what is left.
    enum class Fit { Whole, Share, Rest };
    struct Column {
        QString title;
        Fit fit;
        QString widest{};  // that may come: it has room from the start
    };

    // Of a row that is kept: what is said in its place.
    using Gone = std::function<QString(const std::string& key)>;

    OverviewTable(const QString& name, std::vector<Column> columns, QWidget* parent = nullptr);

    void show(const OverviewRows& rows, const Gone& gone = {});
    using QWidget::show;
    void setTitle(int column, const QString& title);
    // Pointer or keyboard is in it, and not only as the window begins there.
    bool isUsed() const;
    void keepNewest() { keepsNewest_ = true; }  // in sight: it is the last row

Q_SIGNALS:
    void opened(const OverviewRow& row);  // without its cells

protected:
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    class Delegate;
    void fill(QTreeWidgetItem& item, const OverviewRow& row);
    void leave(QTreeWidgetItem& item, const QString& text);
    void chooseAgain(const QString& key);
    void fitColumns();
    int neededWidth(int column) const;
    int restColumn() const;

    std::vector<Column> columns_;
    HeldOrder order_;
    bool keepsNewest_ = false;
    bool begins_ = false;  // nobody has used the keyboard in it yet
};

}  // namespace cortex::gui
