// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "views/overview_table.hpp"

#include <QWidget>

class QHBoxLayout;
class QStackedWidget;

namespace cortex::gui {

class TextLabel;

// A part of the first page: its title, how much there is, and rows, or a line that says why there
// are none.
class OverviewPart : public QWidget {
    Q_OBJECT
public:
    OverviewPart(const QString& title, std::vector<OverviewTable::Column> columns,
                 const QString& gone, const QString& none, QWidget* parent = nullptr);

    OverviewTable& table() { return *table_; }
    void show(const OverviewRows& rows, const QString& count);
    using QWidget::show;
    void addToTitle(QWidget& widget);  // at its end
    void setLeastRows(int rows);

private:
    TextLabel* count_;
    QHBoxLayout* head_;
    QStackedWidget* content_;
    OverviewTable* table_;
};

}  // namespace cortex::gui
